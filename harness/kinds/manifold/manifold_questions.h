// Pairs of bodies that touch, of a file or generated.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/kinds/questions.h"

namespace touchstone::kinds {

std::vector<QueryOption> manifold_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_manifold_questions(const QuestionInput& input);

}  // namespace touchstone::kinds
