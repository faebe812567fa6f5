// Timed sets of convex bodies that slide on a mesh.
#pragma once

#include <vector>

#include "harness/files/toml_table.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::kinds {

std::vector<PlannedSet> sliding_sets(files::TomlTable& table);

}  // namespace touchstone::kinds
