// The files of a check with rows, and their columns.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "harness/check/axes/axes.h"
#include "harness/check/check_job.h"
#include "harness/check/tally.h"
#include "harness/record/row.h"

namespace touchstone::check {

// Calls visit.operator()<Row>(name) for each file to which jobs append rows, in order.
template <class Visit>
void for_each_row_file(CheckMode mode, const Visit& visit) {
  switch (mode) {
    case CheckMode::cases:
      visit.template operator()<grade::GradedAnswer>("grades.csv");
      visit.template operator()<VariantCount>("variants.csv");
      visit.template operator()<JobSummary>("jobs.csv");
      break;
    case CheckMode::axes:
      visit.template operator()<AxisCount>("stress.csv");
      visit.template operator()<AxisSummary>("cells.csv");
      break;
    case CheckMode::count: visit.template operator()<VerdictCount>("jobs.csv"); break;
  }
  visit.template operator()<FamilyCount>("families.csv");
}

template <record::row_of<grade::GradedAnswer> Row, class Visit>
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  visit("regime", record::place_in(row.regime, subjects.regimes.size(), subjects.regime_name()),
        "Regime of the case.");
  visit("index", row.index, "Number of the case in its regime.");
  visit("kind_a", row.kind_a, "Kind of the first shape.");
  visit("kind_b", row.kind_b, "Kind of the second shape.");
  visit("algorithm", record::place_in(row.entry, subjects.narrow.size(), subjects.narrow_name()),
        "The narrow phase.");
  visit("scalar", row.scalar, "Precision that it computes in.");
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
  visit("group", record::derived([&] { return subjects.regimes[row.regime]->group; }),
        "Group of the regime.");
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
}

template <record::row_of<VariantCount> Row, class Visit>
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  visit("regime", record::place_in(row.regime, subjects.regimes.size(), subjects.regime_name()),
        "Regime of the cases.");
  visit("group", record::derived([&] { return subjects.regimes[row.regime]->group; }),
        "Group of the regime.");
  visit("round", row.round, "Round of the check.");
  visit("algorithm", record::place_in(row.entry, subjects.narrow.size(), subjects.narrow_name()),
        "The narrow phase.");
  visit("scalar", row.scalar, "Precision that it computes in.");
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
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  visit("regime", record::place_in(row.regime, subjects.regimes.size(), subjects.regime_name()),
        "Regime of the cases.");
  visit("group", record::derived([&] { return subjects.regimes[row.regime]->group; }),
        "Group of the regime.");
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
  Tally::Key key;
  grade::AnswerCount answers;
  FlipCount flips;
};

template <record::row_of<SummaryRow> Row, class Visit>
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  auto& [key, a, f] = row;
  visit("algorithm", record::place_in(key.entry, subjects.narrow.size(), subjects.narrow_name()),
        "The narrow phase.");
  visit("scalar", key.scalar, "Precision that it computes in.");
  visit("regime", record::place_in(key.regime, subjects.regimes.size(), subjects.regime_name()),
        "Regime of the cases.");
  visit("group", record::derived([&] { return subjects.regimes[row.key.regime]->group; }),
        "Group of the regime.");
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
}

// Returns the axes of these regimes, in order.
inline std::vector<const Axis*> axes_of(const CheckSubjects& subjects) {
  std::vector<const Axis*> list;
  for (const Regime* regime : subjects.regimes) {
    if (list.empty() || list.back() != regime->axis) list.push_back(regime->axis);
  }
  return list;
}

// Visits the columns `axis` and `value`, which identify the row's regime.
template <class Row, class Visit>
void axis_columns(Row& row, Visit& visit, const CheckSubjects& subjects) {
  const std::vector<const Axis*> axes = axes_of(subjects);
  // Axes of families alone have no regimes, and no rows.
  const Axis* const of_row =
      subjects.regimes.empty() ? nullptr : subjects.regimes[row.regime]->axis;
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
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  axis_columns(row, visit, subjects);
  visit("algorithm", record::place_in(row.entry, subjects.narrow.size(), subjects.narrow_name()),
        "The narrow phase.");
  visit("scalar", row.scalar, "Precision that it computes in.");
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
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
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
void subject_columns(Count& row, Visit& visit, const CheckSubjects& subjects) {
  visit("algorithm", record::place_in(row.entry, subjects.narrow.size(), subjects.narrow_name()),
        "The narrow phase.");
  visit("scalar", row.scalar, "Precision that it computes in.");
  visit("regime", record::place_in(row.regime, subjects.regimes.size(), subjects.regime_name()),
        "Regime of the pairs.");
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
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  subject_columns(row, visit, subjects);
  visit("round", row.round, "Round of the count; each has 1000 pairs of every regime.");
  verdict_columns(row, visit);
}

template <record::row_of<VerdictSum> Row, class Visit>
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  subject_columns(row.count, visit, subjects);
  visit("seed", row.seed, "Seed of the cases.");
  visit("drawn", row.drawn,
        "Cases drawn in all regimes and families, whether an algorithm takes them or not.");
  verdict_columns(row.count, visit);
  visit("program", row.program, "Hash of the program.");
}

template <record::row_of<FamilyCount> Row, class Visit>
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  visit("family", record::place_in(row.family, subjects.families.size(), subjects.family_name()),
        "Family of the cases.");
  visit("group", record::derived([&] { return subjects.families[row.family]->group; }),
        "Group of the family.");
  visit("algorithm",
        record::place_in(row.contestant, subjects.contestants.size(), subjects.contestant_name()),
        "The kind, the algorithm, its precision and its task.");
  visit("form", row.form, "Form of the cases; all but `as drawn` are asked for every fifth case.");
  visit("round", row.round, "Round of the check.");
  visit("cases", row.cases, "Cases that it was asked for.");
  visit("contacts", row.contacts, "Of these, contacts, hits or points inside by the exact answer.");
  visit("unresolved", row.unresolved, "Cases whose exact answer is not known.");
  visit("right", row.right, "Answers that are right.");
  kinds::grade_columns(row, visit);
  visit("failed", row.failed, "Queries that crashed, or gave no answer in time.");
  visit("first_wrong", record::with_sign(row.first_wrong),
        "First case that is missed, false, inexact or failed; -1 where there is none.");
}

}  // namespace touchstone::check
