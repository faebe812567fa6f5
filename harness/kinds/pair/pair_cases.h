// The cases of a file of pairs, which tell whether narrow phases or concave phases are asked.
#pragma once

#include <vector>

#include "harness/files/concave/concave_cases.h"
#include "harness/kinds/questions.h"

namespace touchstone::kinds {

// The cases of the file, or those with the id of --id. Prints the sizes of the mesh files that were read. Throws
// InputError for what read_concave_cases throws it for, and if no case has the id.
std::vector<files::ConcaveCase> asked_pair_cases(const QuestionInput& input);

// True if concave phases are asked: a body is not convex, or the task or the name of an algorithm is theirs alone.
bool asks_concave_phases(const QuestionInput& input);

}  // namespace touchstone::kinds
