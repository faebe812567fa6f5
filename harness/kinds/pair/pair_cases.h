// The cases of a file of pairs, which tell whether narrow phases or concave phases are asked, and the rows of their
// answers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/outcome.h"
#include "harness/files/concave_cases.h"
#include "harness/files/csv.h"
#include "harness/kinds/questions.h"

namespace touchstone::kinds {

// The cases of the file, or those with the id of --id; of a scene, two of its bodies (--bodies, --frame). Prints the
// sizes of the mesh files that were read. Throws InputError for what read_concave_cases and load_scene throw it for, if
// no case has the id, and if the scene lacks the bodies.
std::vector<files::ConcaveCase> asked_pair_cases(const QuestionInput& input);

// True if concave phases are asked: a body is not convex, or the task or the name of an algorithm is theirs alone.
bool asks_concave_phases(const QuestionInput& input);

// The options that tell which pairs are asked, and where they are drawn, and further ones.
std::vector<QueryOption> pair_case_options(const std::vector<QueryOption>& further);

std::vector<std::string> query_columns();

struct QueryRowHead {
  std::string_view id, algorithm, scalar, task;
};

// Writes the fields of query_columns(), and does not end the row.
void write_query_fields(files::CsvWriter& csv, const QueryRowHead& head, const Outcome& outcome);

// A line's view of it.
ShownAnswer shown_outcome(const Outcome& outcome);

}  // namespace touchstone::kinds
