// What the files about points share.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/files/toml_table.h"
#include "harness/kinds/questions.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::kinds {

// Timed sets of points at meshes.

std::vector<PlannedSet> point_sets(files::TomlTable& table, const std::filesystem::path& home);

// Points of a CSV file, which are asked of a mesh.

std::vector<QueryOption> point_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_point_questions(const QuestionInput& input);
// Prints what is refused and why; with the file of questions, if any, also what is of none of them.
bool verify_point_proofs(const std::string& proofs, const std::filesystem::path& file);

}  // namespace touchstone::kinds
