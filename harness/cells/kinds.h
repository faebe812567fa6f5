// The kinds of cells. Each reads its own keys of a [[group]] and makes its cells.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/files/toml_table.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::cells {

// Files are relative to `home`. Throw InputError with file, line and what was expected.
std::vector<kinds::PlannedSet> motion_cells(files::TomlTable& table,
                                            const std::filesystem::path& home);
std::vector<kinds::PlannedSet> frame_cells(files::TomlTable& table,
                                           const std::filesystem::path& home);

}  // namespace touchstone::cells
