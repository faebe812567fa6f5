// The request of a check as its checkers of pairs see it: regimes for families, narrow phases for contestants.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/kinds/check_request.h"
#include "harness/kinds/pair/pair_grade.h"
#include "harness/kinds/pair/regimes/regimes.h"

namespace touchstone::kinds {

// An algorithm in one of its scalars.
struct CheckedAlgorithm {
  std::uint32_t entry = 0;  // place in the request
  Precision scalar{};
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a pointer in the comparison with 0
  friend auto operator<=>(const CheckedAlgorithm&, const CheckedAlgorithm&) = default;
};

// Rows refer to narrow phases and regimes by their places in these lists.
struct PairRequest : CheckRequest {
  explicit PairRequest(const CheckRequest& request);

  std::vector<const NarrowPhaseEntry*> narrow;
  std::vector<CheckedAlgorithm> algorithms;
  std::vector<const Regime*> regimes;

  // The place of the regime of a family, which is given by its place in the request.
  std::uint32_t regime_of(std::uint32_t family) const;
  // The axes of the regimes, in order.
  std::vector<const Axis*> axes() const;
  // Returns a name such as "gjk double".
  std::string name(const CheckedAlgorithm& algorithm) const {
    return narrow[algorithm.entry]->info.name + " " + std::string(to_string(algorithm.scalar));
  }
  // The grade of a row, whose entry and regime are places in the request.
  Graded graded(const grade::GradedAnswer& answer) const {
    return grade_pair(*narrow[answer.entry], answer, regimes[answer.regime]->extreme);
  }
  // True if the cases are those of a file.
  bool is_of_file() const;
  bool is_ours(std::uint32_t entry) const { return is_answerable(narrow[entry]->info.origin); }
};

// Takes the pairs of a file in place of all families, as one regime that is called after the file. Of algorithms
// narrow phases alone remain. Throws InputError for what is wrong in the file (files::read_cases), and if no narrow phase
// is left. There is one such file in a program.
void take_case_file(const std::filesystem::path& file, CheckRequest& request);

}  // namespace touchstone::kinds
