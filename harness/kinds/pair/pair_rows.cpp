// The rows of answers for pairs of bodies.
#include "harness/kinds/pair/pair_rows.h"

#include <cstdint>

namespace touchstone::kinds {

std::vector<std::string> query_columns() {
  return {"id",    "algorithm", "scalar",   "task",     "answer",     "status",       "distance",
          "lower", "upper",     "normal_x", "normal_y", "normal_z",   "a_x",          "a_y",
          "a_z",   "b_x",       "b_y",      "b_z",      "iterations", "support_calls"};
}

void write_query_fields(files::CsvWriter& csv, const QueryRowHead& head, const Outcome& outcome) {
  csv.field(head.id).field(head.algorithm).field(head.scalar).field(head.task);
  csv.field(to_string(outcome.answer)).field(to_string(outcome.status));
  csv.field(outcome.distance).field(outcome.lower).field(outcome.upper);
  for (const Vec3d& v : {outcome.normal, outcome.witness_a, outcome.witness_b}) {
    for (const double x : v) csv.field(x);
  }
  for (const std::int32_t count : {outcome.iterations, outcome.support_calls}) {
    if (count < 0) {
      csv.field("");
    } else {
      csv.field(count);
    }
  }
}

ShownAnswer shown_outcome(const Outcome& outcome) {
  return {.verdict = to_string(outcome.answer),
          .status = outcome.status,
          .number = outcome.distance,
          .lower = outcome.lower,
          .upper = outcome.upper};
}

}  // namespace touchstone::kinds
