// The kinds of cells. Each reads its own keys of a table [cells] and makes its cells.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/cells/cell.h"
#include "harness/files/toml_table.h"

namespace touchstone::cells {

// Files are relative to `home`. Throw InputError with file, line and what was expected.
std::vector<PlannedCell> ray_cells(files::TomlTable& table, const std::filesystem::path& home);
std::vector<PlannedCell> point_cells(files::TomlTable& table, const std::filesystem::path& home);
std::vector<PlannedCell> cast_cells(files::TomlTable& table, const std::filesystem::path& home);
std::vector<PlannedCell> concave_cells(files::TomlTable& table, const std::filesystem::path& home);
std::vector<PlannedCell> motion_cells(files::TomlTable& table, const std::filesystem::path& home);
std::vector<PlannedCell> frame_cells(files::TomlTable& table, const std::filesystem::path& home);
std::vector<PlannedCell> sliding_cells(files::TomlTable& table, const std::filesystem::path& home);
std::vector<PlannedCell> ccd_cells(files::TomlTable& table, const std::filesystem::path& home);

}  // namespace touchstone::cells
