// A job of a check: the cases of one regime or family in one round, for all algorithms.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/check/check_request.h"
#include "harness/check/metamorphic.h"
#include "harness/grade/graded_answer.h"
#include "harness/grade/wrong.h"
#include "harness/kinds/batch.h"

namespace touchstone::check {

// Counts of an algorithm's answers for one kind of variant (harness/check/metamorphic.h), compared
// with its own answers for the original cases.
struct VariantCount {
  std::uint32_t regime = 0;  // place in the request
  std::uint64_t round = 0;
  std::uint32_t entry = 0;  // place in the request
  Precision scalar{};
  Task task{};
  std::string kind;           // kind of the variants, such as "rotation"
  std::int64_t compared = 0;  // pairs of answers that were compared
  std::int64_t flips = 0;     // answers on different sides of contact, for bodies that do not touch
  std::int64_t lost = 0;      // variants that crashed or hung, unlike the case itself
  std::int64_t beyond = 0;    // differences of ours beyond the documented margins
  double worst_flip = 0;      // exact |signed distance| of a flip, part of the scale
  double worst_difference = 0;    // difference of distances or depths, part of the scale
  std::uint64_t worst_index = 0;  // case of the first beyond, or else of the worst flip

  template <class Visit>
  void for_each_field(Visit visit) {
    visit(regime);
    visit(round);
    visit(entry);
    visit(scalar);
    visit(task);
    visit(kind);
    for (std::int64_t* count : {&compared, &flips, &lost, &beyond}) visit(*count);
    for (double* worst : {&worst_flip, &worst_difference}) visit(*worst);
    visit(worst_index);
  }
};

// Counts over the regime's cases in the round.
struct JobSummary {
  std::uint32_t regime = 0;
  std::uint64_t round = 0;
  std::int64_t cases = 0;
  std::int64_t unresolved = 0;    // cases whose side of contact the oracle's enclosure leaves open
  std::int64_t proven = 0;        // exact answers whose certificate was verified
  std::int64_t refused = 0;       // exact answers whose certificate was refused
  std::int64_t boxes = 0;         // tight and loose boxes of bodies
  std::int64_t boxes_broken = 0;  // boxes that do not contain their body
  std::uint64_t worst_index = 0;  // case of the first refusal or broken box
};

// The same of a value of an axis, where nothing is proven.
struct AxisSummary : JobSummary {
  std::int64_t dropped = 0;  // cases that could not be drawn as the value asks
};

// Counts of one algorithm's answers to one task at one value of an axis.
struct AxisCount {
  std::uint32_t regime = 0, entry = 0;  // places in the request
  Precision scalar{};
  Task task{};
  std::array<std::int32_t, grade::all_answer_classes.size()> counts{};
  std::int32_t skipped = 0;  // queries left out after too many crashes and hangs
  // Greatest of these cases, to three digits: see wrong_margin and worst_error.
  double margin = Outcome::none;
  double error = Outcome::none;
  // Indices of cases, or -1: the worst silent error, and the first query that crashed or hung.
  std::int64_t worst = -1;
  std::int64_t lost = -1;

  std::int32_t count(grade::AnswerClass outcome) const {
    return counts[static_cast<std::size_t>(outcome)];
  }
  // Returns the number of graded answers.
  std::int32_t answers() const {
    return std::accumulate(counts.begin(), counts.end(), std::int32_t{0});
  }
};

// The rest of a value's cases is skipped after this many crashes or hangs of an algorithm and task.
inline constexpr std::size_t most_lost = 3;

// Returns how bad a silent error is: a wrong side of contact is worse than a wrong number. An
// argument is NaN if there is no such error; if both are, the result is 0.
double badness(double margin, double error);

// Counts of the verdicts of one algorithm in one scalar in one regime.
struct VerdictCount {
  std::uint32_t entry = 0, regime = 0;  // places in the request
  Precision scalar{};
  std::uint64_t round = 0;
  std::int64_t pairs = 0;  // pairs of kinds that it takes
  // Exact answers of these pairs; `unresolved` are curved bodies that the oracle leaves open.
  std::int64_t separated = 0, touching = 0, overlapping = 0, unresolved = 0;
  std::int64_t silent = 0;  // wrong side of contact, with status ok or none
  std::int64_t honest =
      0;  // gave up: the answer is unknown, or the status says that it is not to be trusted
  std::int64_t lost = 0;          // failed: crashed, or gave no answer in time
  std::int64_t first_wrong = -1;  // index of the first case that was silently wrong or failed

  void add(const VerdictCount& other);
};

// Counts of what one contestant answers to the cases of one family in one form.
struct FamilyCount : kinds::GradeCount {
  std::uint32_t family = 0, contestant = 0;  // places in the request
  std::uint64_t round = 0;
  kinds::CaseForm form{};
};

// The sums over all rounds.
struct FamilyCountKey {
  std::uint32_t contestant, family;
  kinds::CaseForm form;
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a pointer in the comparison with 0
  friend auto operator<=>(const FamilyCountKey&, const FamilyCountKey&) = default;
};
using FamilyCounts = std::map<FamilyCountKey, FamilyCount>;

// The rows of a job, by their type: those of its mode, or of a job of a family its counts alone.
struct JobResult {
  std::tuple<std::vector<grade::GradedAnswer>, std::vector<VariantCount>, std::vector<JobSummary>,
             std::vector<AxisCount>, std::vector<AxisSummary>, std::vector<VerdictCount>,
             std::vector<FamilyCount>>
      lists;

  template <class Row>
  std::vector<Row>& rows() {
    return std::get<std::vector<Row>>(lists);
  }
  template <class Row>
  const std::vector<Row>& rows() const {
    return std::get<std::vector<Row>>(lists);
  }
  template <class Visit>
  void for_each_field(Visit visit) {
    std::apply([&](auto&... list) { (visit(list), ...); }, lists);
  }
};

// Does a job. Its number gives regime or family, and round: all of a round, then the next round.
JobResult do_job(const CheckRequest& request, std::size_t job, oracle::Oracle& oracle);

// The jobs of a regime in each mode.
JobResult do_pair_job(const CheckRequest& request, std::size_t job, oracle::Oracle& oracle);
JobResult do_axis_job(const CheckRequest& request, std::size_t job, oracle::Oracle& oracle);
JobResult do_count_job(const CheckRequest& request, std::size_t job, oracle::Oracle& oracle);

// Returns the cases of a value of an axis with their exact answers.
std::vector<grade::TrueCase> axis_cases(const CheckRequest& request, std::size_t regime,
                                        oracle::Oracle& oracle, AxisSummary& summary);

// Returns the variants of a sampled case, and none for other cases.
std::vector<Variant> sampled_variants(const files::Case& c, std::uint64_t seed,
                                      std::uint64_t index);
// Returns "rotation" for "rotation+y+z+x".
std::string kind_of(const Variant& variant);

}  // namespace touchstone::check
