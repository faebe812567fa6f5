// Moving vertices, faces and edges of a CSV file, or of a folder of them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/kinds/questions.h"

namespace touchstone::kinds {

std::vector<QueryOption> feature_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_feature_questions(const QuestionInput& input);

}  // namespace touchstone::kinds
