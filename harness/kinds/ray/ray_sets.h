// Timed sets of rays at meshes.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/files/toml_table.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::kinds {

std::vector<PlannedSet> ray_sets(files::TomlTable& table, const std::filesystem::path& home);

}  // namespace touchstone::kinds
