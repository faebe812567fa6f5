// The rows of answers for pairs of bodies, convex or not.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/outcome.h"
#include "harness/files/csv.h"
#include "harness/kinds/questions.h"

namespace touchstone::kinds {

std::vector<std::string> query_columns();

struct QueryRowHead {
  std::string_view id, algorithm, scalar, task;
};

// Writes the fields of query_columns(), and does not end the row.
void write_query_fields(files::CsvWriter& csv, const QueryRowHead& head, const Outcome& outcome);

// A line's view of it.
ShownAnswer shown_outcome(const Outcome& outcome);

}  // namespace touchstone::kinds
