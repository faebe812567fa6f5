// One answer with its grades.
#pragma once

#include <cstdint>

#include "algorithms/registry.h"
#include "harness/grade/grade.h"
#include "harness/grade/true_case.h"

namespace touchstone::grade {

// A row of grades.csv. Regime and algorithm are places in the lists of what is checked.
struct GradedAnswer {
  std::uint32_t regime = 0, entry = 0;
  std::uint64_t index = 0;  // of the case in its regime
  ShapeKind kind_a{}, kind_b{};
  Precision scalar{};
  Task task{};
  Encoding encoding{};
  Answer exact{};  // of the pair as the case has it
  Answer answer{};
  Status status{};
  bool beyond = false;  // one of ours, and beyond its documented margins
  std::int32_t iterations = -1;
  double size = 0;              // pair_size, metres
  double scale = 0;             // what errors are parts of, metres; see margins.h
  double lower = 0, upper = 0;  // metres: enclose the exact signed distance of the case,
  double given_lower = 0, given_upper = 0;  // and of what the algorithm was given
  Grade given;                              // against what the algorithm was given
  Grade end_to_end;                         // against the case
  WitnessGrade witnesses;                   // against the case
};

// Which query an answer is to. Regime and algorithm are places in the lists of what is checked.
struct Query {
  std::uint32_t regime, entry;
  Precision scalar;
  Task task;
};
inline Query query_of(const GradedAnswer& answer) {
  return {answer.regime, answer.entry, answer.scalar, answer.task};
}

// `algorithm` is the query's; `extreme` is its regime's (margins.h).
GradedAnswer grade_answer(const NarrowPhaseEntry& algorithm, bool extreme, const Query& query,
                          TrueCase& c, const Outcome& outcome);

}  // namespace touchstone::grade
