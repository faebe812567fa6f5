// One graded answer: a row of grades.csv.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/check/regimes/regimes.h"
#include "harness/files/csv.h"
#include "harness/grade/grade.h"

namespace touchstone {

// What is graded, as a row names it by numbers.
struct CheckSubjects {
  std::span<const NarrowPhaseEntry* const> narrow;
  std::span<const Regime* const> regimes;
};

// Plain bytes, so that a worker can send it.
struct GradedAnswer {
  std::uint32_t regime = 0;  // place in CheckSubjects
  std::uint32_t entry = 0;   // place in CheckSubjects
  std::uint64_t index = 0;   // of the case in its regime
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

std::vector<std::string> graded_answer_header();
void write(CsvWriter& file, const GradedAnswer& row, const CheckSubjects& subjects);
// InputError where a name is none of the subjects'.
GradedAnswer read_graded_answer(const CsvReader::Row& row, const CheckSubjects& subjects);

}  // namespace touchstone
