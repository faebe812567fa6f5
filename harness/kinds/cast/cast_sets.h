// Timed sets of moving bodies.
#pragma once

#include <vector>

#include "harness/files/toml_table.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::kinds {

std::vector<PlannedSet> cast_sets(files::TomlTable& table);

}  // namespace touchstone::kinds
