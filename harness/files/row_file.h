// Names of files of rows, which may be packed by zstd.
#pragma once

#include <filesystem>

namespace touchstone::files {

// Returns the name of the file when it is packed: raw.csv.zst for raw.csv.
std::filesystem::path packed_name(std::filesystem::path csv);

// Returns true if the file's name says that it is packed.
bool is_packed(const std::filesystem::path& file);

// Returns the file of rows that is there: `csv`, or else its packed name; `csv` if neither is.
std::filesystem::path row_file(const std::filesystem::path& csv);

}  // namespace touchstone::files
