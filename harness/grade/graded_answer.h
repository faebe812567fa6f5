// One answer with its grades.
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

}  // namespace touchstone::grade
