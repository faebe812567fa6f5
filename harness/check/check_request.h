// The request of a check.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/check/regimes/regimes.h"
#include "harness/kinds/kind.h"
#include "harness/record/part.h"

namespace touchstone::check {

// The lists of algorithms and regimes; rows refer to them by place.
struct CheckSubjects {
  std::span<const NarrowPhaseEntry* const> narrow;
  std::span<const Regime* const> regimes;
  std::span<const kinds::Family* const> families = {};
  std::span<const kinds::Contestant> contestants = {};

  auto narrow_name() const {
    return [narrow = narrow](std::size_t i) -> const std::string& { return narrow[i]->info.name; };
  }
  auto regime_name() const {
    return [regimes = regimes](std::size_t i) -> const std::string& { return regimes[i]->name; };
  }
  auto family_name() const {
    return [families = families](std::size_t i) -> const std::string& { return families[i]->name; };
  }
  auto contestant_name() const {
    // Algorithms of two kinds may have one name.
    return [contestants = contestants](std::size_t i) {
      return std::string(contestants[i].kind->name()) + " " + contestants[i].name();
    };
  }
};

// An algorithm in one of its scalars.
struct CheckedAlgorithm {
  std::uint32_t entry = 0;  // place in the request
  Precision scalar{};
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a pointer in the comparison with 0
  friend auto operator<=>(const CheckedAlgorithm&, const CheckedAlgorithm&) = default;
};

struct CheckRequest {
  std::vector<const NarrowPhaseEntry*> narrow;
  std::vector<const BroadPhaseEntry*> broad;
  std::vector<Precision> scalars = {Precision::float64, Precision::float32};
  std::vector<const Regime*> regimes;          // of pairs, for narrow phases
  std::vector<const kinds::Family*> families;  // of cases, for contestants of their kinds
  std::vector<kinds::Contestant> contestants;
  std::uint64_t seed = 1;
  int cases = 200;         // number of cases of each regime in a round
  int rounds = 1;          // number of rounds
  double seconds = 0;      // rounds go on for so long instead; 0: `rounds` of them
  int workers = 2;         // number of processes
  double time_limit = 10;  // seconds for one query
  std::filesystem::path out;
  bool resume = false;               // resumes the work in the folder
  std::optional<record::Part> part;  // some jobs instead of all

  CheckSubjects subjects() const { return {narrow, regimes, families, contestants}; }
  // The jobs of one round: first those of the regimes, if there are narrow phases, then those of the
  // families.
  std::size_t regime_jobs() const { return narrow.empty() ? 0 : regimes.size(); }
  std::size_t period() const { return regime_jobs() + families.size(); }
  // Returns the jobs of the part, or else all `count`.
  base::UnitRange jobs(std::int64_t count) const {
    return part ? part->units : base::UnitRange{0, count};
  }
  // Returns the narrow phases in those of the scalars that they offer.
  std::vector<CheckedAlgorithm> algorithms() const {
    std::vector<CheckedAlgorithm> all;
    for (std::uint32_t entry = 0; entry < narrow.size(); ++entry) {
      for (const Precision scalar : scalars) {
        if (offers(*narrow[entry], scalar)) all.push_back({entry, scalar});
      }
    }
    return all;
  }
  // Returns a name such as "gjk double".
  std::string name(const CheckedAlgorithm& algorithm) const {
    return narrow[algorithm.entry]->info.name + " " + std::string(to_string(algorithm.scalar));
  }
};

// Returns true for every fifth case, which is also run in other forms and whose exact answer is
// proven.
inline bool is_sampled(std::uint64_t index) { return index % 5 == 0; }

}  // namespace touchstone::check
