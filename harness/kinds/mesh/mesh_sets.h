// Timed sets of pairs of bodies that need not be convex.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/files/toml_table.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::kinds {

std::vector<PlannedSet> mesh_sets(files::TomlTable& table, const std::filesystem::path& home);

}  // namespace touchstone::kinds
