// One answer with its grades, and counts of graded answers, with their greatest errors.
#pragma once

#include <cstdint>

#include "algorithms/registry.h"
#include "harness/grade/grade.h"
#include "harness/grade/true_case.h"

namespace touchstone::grade {

// A row of grades.csv. `regime` and `entry` are places in the lists of the request.
struct GradedAnswer {
  std::uint32_t regime = 0, entry = 0;
  std::uint64_t index = 0;  // number of the case in its regime
  ShapeKind kind_a{}, kind_b{};
  Precision scalar{};
  Task task{};
  Encoding encoding{};
  Answer exact{};  // answer for the pair of the case
  Answer answer{};
  Status status{};
  bool beyond = false;  // an answer of ours beyond its documented margins
  std::int32_t iterations = -1;
  double size = 0;                          // pair_size, metres
  double scale = 0;                         // unit of errors, metres; see margins.h
  double lower = 0, upper = 0;              // enclosure of the case's exact signed distance, metres
  double given_lower = 0, given_upper = 0;  // its enclosure for the given problem, metres
  Grade given;                              // against the given problem
  Grade end_to_end;                         // against the case
  WitnessGrade witnesses;                   // against the case
};

// Identifies a query. `regime` and `entry` are places in the lists of the request.
struct Query {
  std::uint32_t regime, entry;
  Precision scalar;
  Task task;
};
inline Query query_of(const GradedAnswer& answer) {
  return {answer.regime, answer.entry, answer.scalar, answer.task};
}

// Grades an outcome. `algorithm` belongs to the query, `extreme` to its regime (margins.h).
GradedAnswer grade_answer(const NarrowPhaseEntry& algorithm, bool extreme, const Query& query,
                          TrueCase& c, const Outcome& outcome);

// Counts for one algorithm in one scalar, over all tasks. Each error is the greatest seen, as a
// part of the scale (GradedAnswer::scale), or NaN if there is none.
struct AnswerCount {
  std::int64_t answers = 0;       // supported pairs that it was asked about
  std::int64_t not_reported = 0;  // answers with status not_reported
  std::int64_t silent = 0;        // answers on the wrong side of contact, against the given problem
  std::int64_t silent_end = 0;    // answers on the wrong side of contact, against the case
  std::int64_t honest = 0;        // failures that the algorithm reports as such
  std::int64_t crashed = 0;
  std::int64_t timed_out = 0;
  std::int64_t within_resolution = 0;  // `touching` within bounds on the signed distance
  std::int64_t touching = 0;           // answers about bodies that touch exactly
  std::int64_t touching_contact = 0;   // number of these that are contact
  std::int64_t bounds = 0;             // certified bounds that miss the exact value
  std::int64_t not_a_number = 0;
  std::int64_t beyond = 0;             // answers of ours beyond the documented margins
  double resolution = Grade::none;     // distance between the bounds of `touching`
  double honest_margin = Grade::none;  // exact |signed distance| of an honest failure
  double margin = Grade::none,
         margin_end = Grade::none;  // exact |signed distance| with a wrong verdict
  double distance = Grade::none, distance_end = Grade::none;  // |error| of a gap
  double too_deep = Grade::none,
         too_shallow = Grade::none;  // errors of a depth, both >= 0, against the given problem
  double depth_end = Grade::none;    // |error| of a depth, against the case
  double does_not_separate =
      Grade::none;              // distance by which the reported translation fails to separate
  double excess = Grade::none;  // length of that translation beyond the necessary one
  double bounds_missed = Grade::none;  // distance by which certified bounds miss, against the case
  // Greatest distance of a point from its body; | |a - b| less the distance |.
  double witness = Grade::none, witness_length = Grade::none;
  double normal = Grade::none;  // | |n| - 1 |

  void add(const GradedAnswer& answer);
  void add(const AnswerCount& other);
};

// Keeps the greater of the two; an unknown number (NaN) does not count.
void keep_greater(double& worst, double value);

}  // namespace touchstone::grade
