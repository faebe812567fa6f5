// Pairs of convex bodies, one JSON object a line.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/kinds/questions.h"

namespace touchstone::kinds {

std::vector<QueryOption> pair_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_pair_questions(const QuestionInput& input);

}  // namespace touchstone::kinds
