// Points of a CSV file, which are asked of a mesh.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/kinds/questions.h"

namespace touchstone::kinds {

std::vector<QueryOption> point_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_point_questions(const QuestionInput& input);
// Prints what is refused and why; with the file of questions, if any, also what is of none of them.
bool verify_point_proofs(const std::string& proofs, const std::filesystem::path& file);

}  // namespace touchstone::kinds
