// The columns of grades.csv, variants.csv, jobs.csv and summary.csv.
#pragma once

#include <span>

#include "harness/check/check_job.h"
#include "harness/check/tally.h"
#include "harness/record/row.h"

namespace touchstone::check {

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

}  // namespace touchstone::check
