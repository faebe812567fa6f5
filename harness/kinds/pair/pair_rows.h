// The rows of a check of pairs, and their columns.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "harness/grade/graded_answer.h"
#include "harness/grade/wrong.h"
#include "harness/kinds/pair/axes/axes.h"
#include "harness/kinds/pair/pair_grade.h"
#include "harness/kinds/pair/pair_request.h"
#include "harness/record/row.h"

namespace touchstone::kinds {

// An algorithm in one of its scalars, in one regime; places in the request.
struct RegimeKey {
  std::uint32_t entry = 0;
  Precision scalar{};
  std::uint32_t regime = 0;
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a pointer in the comparison with 0
  friend auto operator<=>(const RegimeKey&, const RegimeKey&) = default;
};

// Counts over variants (metamorphic.h), whose answers are compared with those for the original cases.
struct FlipCount {
  std::int64_t compared = 0;  // pairs of answers that were compared
  std::int64_t flips = 0;     // answers on different sides of contact, for bodies that do not touch
  std::int64_t lost = 0;      // variants that crashed or hung, unlike the case itself
  std::int64_t beyond = 0;    // differences of ours beyond the documented margins
  double worst_flip = 0;      // exact |signed distance| of a flip, part of the scale
  double worst_difference = 0;  // difference of distances or depths, part of the scale

  void add(const FlipCount& other) {
    compared += other.compared;
    flips += other.flips;
    lost += other.lost;
    beyond += other.beyond;
    worst_flip = std::max(worst_flip, other.worst_flip);
    worst_difference = std::max(worst_difference, other.worst_difference);
  }
};

// Those of one algorithm and one kind of variant.
struct VariantCount : FlipCount {
  std::uint32_t regime = 0;  // place in the request
  std::uint64_t round = 0;
  std::uint32_t entry = 0;  // place in the request
  Precision scalar{};
  Task task{};
  std::string kind;               // kind of the variants, such as "rotation"
  std::uint64_t worst_index = 0;  // case of the first beyond, or else of the worst flip

  template <class Visit>
  void for_each_field(Visit visit) {
    visit(static_cast<FlipCount&>(*this));
    visit(regime);
    visit(round);
    visit(entry);
    visit(scalar);
    visit(task);
    visit(kind);
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

  void add(const JobSummary& other) {
    cases += other.cases;
    unresolved += other.unresolved;
    proven += other.proven;
    refused += other.refused;
    boxes += other.boxes;
    boxes_broken += other.boxes_broken;
  }
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

template <class Place, class Visit>
void regime_column(Place& regime, Visit& visit, const PairRequest& subjects, const char* meaning) {
  visit("regime",
        record::place_in(regime, subjects.regimes.size(),
                         [&](std::size_t i) { return subjects.regimes[i]->name; }),
        meaning);
}

template <class Place, class Visit>
void group_column(const Place& regime, Visit& visit, const PairRequest& subjects) {
  visit("group", record::derived([&] { return subjects.regimes[regime]->group; }),
        "Group of the regime.");
}

template <class Row, class Visit>
void algorithm_columns(Row& row, Visit& visit, const PairRequest& subjects) {
  visit("algorithm",
        record::place_in(row.entry, subjects.narrow.size(),
                         [&](std::size_t i) { return subjects.narrow[i]->info.name; }),
        "The narrow phase.");
  visit("scalar", row.scalar, "Precision that it computes in.");
}

template <record::row_of<grade::GradedAnswer> Row, class Visit>
void columns(Row& row, Visit visit, const PairRequest& subjects) {
  regime_column(row.regime, visit, subjects, "Regime of the case.");
  visit("index", row.index, "Number of the case in its regime.");
  visit("kind_a", row.kind_a, "Kind of the first shape.");
  visit("kind_b", row.kind_b, "Kind of the second shape.");
  algorithm_columns(row, visit, subjects);
  visit("task", row.task, "What it was asked.");
  visit("encoding", row.encoding, "Form in which it was given the pair.");
  visit("exact", row.exact, "Exact answer for the pair as the case has it.");
  visit("answer", row.answer, "Its answer.");
  visit("status", row.status, "Status of its answer.");
  visit("verdict", row.given.verdict, "Grade of the answer, against what it was given.");
  visit("end_verdict", row.end_to_end.verdict, "Grade of the answer, against the case.");
  visit("not_a_number", row.witnesses.not_a_number, "1 if a reported number is NaN or infinite.");
  visit("beyond_margin", row.beyond, "1 if one of ours is beyond its documented margins.");
  visit("iterations", row.iterations, "Iterations, where they are counted.");
  group_column(row.regime, visit, subjects);
  visit("size", row.size, "Size of the pair, metres.");
  visit("scale", row.scale, "Length that errors are parts of, metres.");
  visit("exact_lower", row.lower, "Lower bound of the exact signed distance, metres.");
  visit("exact_upper", row.upper, "Upper bound of the exact signed distance, metres.");
  visit("given_lower", row.given_lower, "Lower bound for what the algorithm was given, metres.");
  visit("given_upper", row.given_upper, "Upper bound for what the algorithm was given, metres.");
  visit("margin", row.given.margin, "Exact distance or depth that was called wrongly, metres.");
  visit("distance_error", row.given.distance_error, "Reported gap less the exact one, metres.");
  visit("depth_error", row.given.depth_error, "Reported depth less the exact one, metres.");
  visit("separation_error", row.given.separation_error,
        "Length by which the reported translation fails to separate the bodies, metres.");
  visit("excess", row.given.excess,
        "Length that the reported direction needs beyond the least, metres.");
  visit("bounds_error", row.given.bounds_error,
        "Length by which certified bounds miss the exact value, metres.");
  visit("resolution", record::newer(row.given.resolution),
        "Distance between the bounds of an answer `touching`, metres.");
  visit("end_margin", row.end_to_end.margin, "margin, against the case.");
  visit("end_distance_error", row.end_to_end.distance_error, "distance_error, against the case.");
  visit("end_depth_error", row.end_to_end.depth_error, "depth_error, against the case.");
  visit("end_separation_error", row.end_to_end.separation_error,
        "separation_error, against the case.");
  visit("end_excess", row.end_to_end.excess, "excess, against the case.");
  visit("end_bounds_error", row.end_to_end.bounds_error, "bounds_error, against the case.");
  visit("witness_error", row.witnesses.off_body,
        "Greatest distance of a witness point from its body, metres.");
  visit("witness_length_error", row.witnesses.length_error,
        "Distance of the witness points less the reported distance, metres.");
  visit("normal_error", row.witnesses.normal_error, "Length of the normal less 1, absolute.");
  visit("grade", record::derived([&] { return subjects.graded(row).grade; }),
        "Grade of the answer, in the words of all kinds.");
}

template <record::row_of<VariantCount> Row, class Visit>
void columns(Row& row, Visit visit, const PairRequest& subjects) {
  regime_column(row.regime, visit, subjects, "Regime of the cases.");
  group_column(row.regime, visit, subjects);
  visit("round", row.round, "Round of the check.");
  algorithm_columns(row, visit, subjects);
  visit("task", row.task, "What it was asked.");
  visit("variant", row.kind, "How the cases were changed.");
  visit("compared", row.compared, "Pairs of answers that were compared.");
  visit("flips", row.flips, "Answers on the other side of contact.");
  visit("lost", row.lost, "Changed cases alone that crashed or hung.");
  visit("beyond_margin", row.beyond, "Differences of ours beyond the documented margins.");
  visit("worst_flip", row.worst_flip, "Greatest exact distance of a flip, part of the scale.");
  visit("worst_difference", row.worst_difference,
        "Greatest difference of a distance or depth, part of the scale.");
  visit("worst_index", row.worst_index, "Case of the first beyond, or else of the worst flip.");
}

template <record::row_of<JobSummary> Row, class Visit>
void columns(Row& row, Visit visit, const PairRequest& subjects) {
  regime_column(row.regime, visit, subjects, "Regime of the cases.");
  group_column(row.regime, visit, subjects);
  visit("round", row.round, "Round of the check.");
  visit("cases", row.cases, "Cases of the job.");
  visit("unresolved", row.unresolved, "Cases whose side of contact the oracle leaves open.");
  visit("proven", row.proven, "Exact answers whose certificate was verified.");
  visit("refused", row.refused, "Exact answers whose certificate was refused.");
  visit("boxes", row.boxes, "Boxes of bodies that were looked at.");
  visit("boxes_broken", row.boxes_broken, "Boxes that do not hold their body.");
  visit("worst_index", row.worst_index, "Case of the first refusal or broken box.");
}

// A row of summary.csv: the answers of an algorithm in one regime, over all tasks.
struct SummaryRow {
  RegimeKey key;
  grade::AnswerCount answers;
  FlipCount flips;
  GradeCount grades;
};

template <record::row_of<SummaryRow> Row, class Visit>
void columns(Row& row, Visit visit, const PairRequest& subjects) {
  auto& [key, a, f, grades] = row;
  algorithm_columns(key, visit, subjects);
  regime_column(key.regime, visit, subjects, "Regime of the cases.");
  group_column(key.regime, visit, subjects);
  visit("answers", a.answers, "Pairs that it takes and was asked about.");
  visit("silent", a.silent, "Silent errors, against what it was given.");
  visit("silent_end", a.silent_end, "Silent errors, against the case.");
  visit("honest", a.honest, "Gave up: the status says so, or there is no answer.");
  visit("not_reported", a.not_reported, "Answers whose status says nothing.");
  visit("crashed", a.crashed, "Queries that crashed.");
  visit("timed_out", a.timed_out, "Queries that gave no answer in time.");
  visit("touching", a.touching, "Pairs that touch exactly.");
  visit("touching_contact", a.touching_contact, "Pairs of these that were called contact.");
  visit("bounds", a.bounds, "Certified bounds that miss the exact value.");
  visit("not_a_number", a.not_a_number, "Answers with a number that is NaN or infinite.");
  visit("beyond_margin", a.beyond, "Answers of ours beyond the documented margins.");
  visit("honest_margin", a.honest_margin,
        "Greatest exact distance or depth of a reported failure.");
  visit("margin", a.margin, "Greatest exact distance or depth that was called wrongly.");
  visit("margin_end", a.margin_end, "margin, against the case.");
  visit("distance", a.distance, "Greatest error of a gap.");
  visit("distance_end", a.distance_end, "distance, against the case.");
  visit("too_deep", a.too_deep, "Greatest error of a depth that is too deep.");
  visit("too_shallow", a.too_shallow, "Greatest error of a depth that is too shallow.");
  visit("depth_end", a.depth_end, "Greatest error of a depth, against the case.");
  visit("does_not_separate", a.does_not_separate,
        "Greatest length by which the reported translation fails to separate the bodies.");
  visit("excess", a.excess, "Greatest length that the reported direction needs beyond the least.");
  visit("bounds_missed", a.bounds_missed,
        "Greatest length by which certified bounds miss, against the case.");
  visit("witness", a.witness, "Greatest distance of a witness point from its body.");
  visit("witness_length", a.witness_length,
        "Greatest difference between the witness points' distance and the reported one.");
  visit("normal", a.normal, "Greatest difference of the normal's length from 1.");
  visit("variants", f.compared, "Pairs of answers to a case and its variant.");
  visit("flips", f.flips, "Answers of these on the other side of contact.");
  visit("worst_flip", f.worst_flip, "Greatest exact distance of a flip.");
  visit("worst_difference", f.worst_difference, "Greatest difference of a distance or depth.");
  visit("unresolved", grades.unresolved, "Answers about pairs whose exact answer is not known.");
  visit("right", grades.right, "Answers that are right.");
  grade_columns(grades, visit);
  visit("failed", grades.failed, "Queries that crashed, or gave no answer in time.");
  std::int64_t score = grades.score();
  visit("score", record::with_sign(score),
        "1 for each right answer, -16 for each that is missed, false or inexact, 0 for all else.");
}

// Visits the columns `axis` and `value`, which identify the row's regime.
template <class Row, class Visit>
void axis_columns(Row& row, Visit& visit, const PairRequest& subjects) {
  const std::vector<const Axis*> axes = subjects.axes();
  // Without regimes there are no rows.
  const Axis* const of_row = axes.empty() ? nullptr : subjects.regimes[row.regime]->axis;
  auto axis = static_cast<std::size_t>(std::ranges::find(axes, of_row) - axes.begin());
  visit("axis", record::place_in(axis, axes.size(), [&](std::size_t i) { return axes[i]->name; }),
        "The axis.");
  std::vector<std::uint32_t> values;  // regimes of the axis
  for (std::uint32_t i = 0; i < subjects.regimes.size(); ++i) {
    if (subjects.regimes[i]->axis == axes[axis]) values.push_back(i);
  }
  auto place = static_cast<std::size_t>(std::ranges::find(values, row.regime) - values.begin());
  visit(
      "value",
      record::place_in(place, values.size(),
                       [&](std::size_t i) { return value_of(*subjects.regimes[values[i]]).name; }),
      "The value on the axis.");
  if constexpr (!std::is_const_v<Row>) {
    if (!values.empty()) row.regime = values[place];
  }
}

template <record::row_of<AxisCount> Row, class Visit>
void columns(Row& row, Visit visit, const PairRequest& subjects) {
  axis_columns(row, visit, subjects);
  algorithm_columns(row, visit, subjects);
  visit("task", row.task, "What it was asked.");
  for (const grade::AnswerClass one : grade::all_answer_classes) {
    visit(to_string(one), row.counts[static_cast<std::size_t>(one)], "Answers of this class.");
  }
  visit("skipped", row.skipped, "Queries that were not asked, after too many crashes and hangs.");
  visit("worst_margin", record::rounded(row.margin, 3),
        "Greatest exact distance or depth that was called wrongly, part of the scale.");
  visit("worst_error", record::rounded(row.error, 3),
        "Greatest error of a number, part of the scale.");
  visit("worst_index", row.worst, "Case of the silent error that is furthest off.");
  visit("lost_index", row.lost, "Case of the first query that crashed or hung.");
}

template <record::row_of<AxisSummary> Row, class Visit>
void columns(Row& row, Visit visit, const PairRequest& subjects) {
  axis_columns(row, visit, subjects);
  visit("cases", row.cases, "Cases that were drawn, and are what the value asks for.");
  visit("dropped", row.dropped, "Cases that could not be drawn so.");
  visit("unresolved", row.unresolved, "Cases whose side of contact the oracle leaves open.");
}

// A row of soak.csv: an algorithm's counts in one regime.
struct VerdictSum {
  VerdictCount count;
  std::uint64_t seed = 0;
  std::int64_t drawn = 0;
  std::string program;
};

template <record::row_of<VerdictCount> Count, class Visit>
void subject_columns(Count& row, Visit& visit, const PairRequest& subjects) {
  algorithm_columns(row, visit, subjects);
  regime_column(row.regime, visit, subjects, "Regime of the pairs.");
}

template <record::row_of<VerdictCount> Count, class Visit>
void verdict_columns(Count& count, Visit& visit) {
  visit("pairs", count.pairs, "Pairs that it was asked about.");
  visit("separated", count.separated, "Pairs that are apart.");
  visit("touching", count.touching, "Pairs that touch exactly.");
  visit("overlapping", count.overlapping, "Pairs that overlap.");
  visit("unresolved", count.unresolved, "Pairs whose side of contact the oracle leaves open.");
  visit("silent", count.silent, "Answers on the wrong side of contact that nothing tells.");
  visit("honest", count.honest,
        "Gave up: the answer is unknown, or the status says that it is not to be trusted.");
  visit("lost", count.lost, "Failed: crashed, or gave no answer in time.");
  visit("first_wrong", record::with_sign(count.first_wrong),
        "First case that was silently wrong or failed; -1 where there is none.");
}

template <record::row_of<VerdictCount> Row, class Visit>
void columns(Row& row, Visit visit, const PairRequest& subjects) {
  subject_columns(row, visit, subjects);
  visit("round", row.round, "Round of the count; each has 1000 pairs of every regime.");
  verdict_columns(row, visit);
}

template <record::row_of<VerdictSum> Row, class Visit>
void columns(Row& row, Visit visit, const PairRequest& subjects) {
  subject_columns(row.count, visit, subjects);
  visit("seed", row.seed, "Seed of the cases.");
  visit("drawn", row.drawn,
        "Cases drawn in all regimes and families, whether an algorithm takes them or not.");
  verdict_columns(row.count, visit);
  visit("program", row.program, "Hash of the program.");
}

}  // namespace touchstone::kinds
