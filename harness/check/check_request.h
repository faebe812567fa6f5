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
#include "harness/record/folder_files.h"

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

// What is made of the cases.
enum class CheckMode : std::uint8_t {
  cases,  // a row for each answer of narrow phases; sampled cases are asked in other forms too
  axes,   // one property of a case grows to its extreme: the first values that are wrong
  count,  // counts of verdicts alone, of many cases, a thousand of a regime or family in a job
};

// An algorithm in one of its scalars.
struct CheckedAlgorithm {
  std::uint32_t entry = 0;  // place in the request
  Precision scalar{};
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a pointer in the comparison with 0
  friend auto operator<=>(const CheckedAlgorithm&, const CheckedAlgorithm&) = default;
};

inline constexpr std::int64_t cases_of_a_count_job = 1000;

struct CheckRequest {
  CheckRequest() = default;
  // With the defaults of the mode.
  explicit CheckRequest(CheckMode of) : mode(of) {
    if (of != CheckMode::axes) return;
    cases = 48;
    time_limit = 0.5;
  }

  CheckMode mode = CheckMode::cases;
  std::vector<const NarrowPhaseEntry*> narrow;
  std::vector<const BroadPhaseEntry*> broad;
  std::vector<Precision> scalars = {Precision::float64, Precision::float32};
  std::vector<const Regime*> regimes;          // of pairs, for narrow phases; of axes, their values
  std::vector<const kinds::Family*> families;  // of cases, for contestants of their kinds
  std::vector<kinds::Contestant> contestants;
  std::uint64_t seed = 1;
  int cases = 200;                 // number of cases of each regime in a round; without `count`
  int rounds = 1;                  // number of rounds; of cases alone
  double seconds = 0;              // rounds go on for so long instead; 0: `rounds` of them
  std::int64_t count = 1'000'000;  // of that mode: cases in all, spread evenly
  int workers = 2;                 // number of processes
  double time_limit = 10;          // seconds for one query; of axes, of processor time
  std::filesystem::path out;
  bool resume = false;               // resumes the work in the folder
  std::optional<record::Part> part;  // some jobs instead of all

  CheckSubjects subjects() const { return {narrow, regimes, families, contestants}; }
  // The jobs of one round: first those of the regimes, if there are narrow phases, then those of the
  // families.
  std::size_t regime_jobs() const { return narrow.empty() ? 0 : regimes.size(); }
  std::size_t period() const { return regime_jobs() + families.size(); }
  // The jobs of the whole check, if it does not go on for some time.
  std::int64_t job_count() const {
    if (mode == CheckMode::count) return (count + cases_of_a_count_job - 1) / cases_of_a_count_job;
    return static_cast<std::int64_t>(period()) * rounds;
  }
  // Returns the jobs of the part, or else `all`.
  base::UnitRange jobs(std::int64_t all) const {
    return part ? part->units : base::UnitRange{0, all};
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
