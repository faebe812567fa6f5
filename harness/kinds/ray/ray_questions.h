// Rays of a CSV file, which are cast at a mesh.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/kinds/questions.h"

namespace touchstone::kinds {

std::vector<QueryOption> ray_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_ray_questions(const QuestionInput& input);
// Prints what is refused and why; with the file of questions, if any, also what is of none of them.
bool verify_ray_proofs(const std::string& proofs, const std::filesystem::path& file);

}  // namespace touchstone::kinds
