// Reads the files that say which cells are measured. Each kind of cell reads its own keys of
// the [[group]], and makes its cells.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/cells/cell_run.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::cells {

// Files are relative to `home`. Throw InputError with file, line and what was expected.
std::vector<kinds::PlannedSet> motion_cells(files::TomlTable& table,
                                            const std::filesystem::path& home);
std::vector<kinds::PlannedSet> frame_cells(files::TomlTable& table,
                                           const std::filesystem::path& home);

// Returns whether the file has a [[group]] of a kind, or a table [cells], which was its name before.
bool has_cells(const std::filesystem::path& file);
// The keys are documented in datasets/README.md. Throws InputError with file, line and what was
// expected.
CellRequest read_cells(const std::filesystem::path& file);

}  // namespace touchstone::cells
