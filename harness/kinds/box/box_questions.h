// Frames of boxes, of a CSV file or a recording.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/kinds/questions.h"

namespace touchstone::kinds {

std::vector<QueryOption> box_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_box_questions(const QuestionInput& input);

}  // namespace touchstone::kinds
