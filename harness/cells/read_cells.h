// Reads the files that say which cells are measured.
#pragma once

#include <filesystem>

#include "harness/cells/cell_run.h"

namespace touchstone::cells {

// Returns whether the file has a [[group]] of a kind, or a table [cells], which was its name before.
bool has_cells(const std::filesystem::path& file);
// The keys are documented in datasets/README.md. Throws InputError with file, line and what was
// expected.
CellRequest read_cells(const std::filesystem::path& file);

}  // namespace touchstone::cells
