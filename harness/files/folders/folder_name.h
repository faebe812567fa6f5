// The name of a work, by which its folder of results is called.
#pragma once

#include <filesystem>
#include <string>

#include "harness/files/toml_table.h"

namespace touchstone::files {

// Returns the value of the key `name`, or without the key the stem of `file`, and `ending` behind it.
// Throws InputError with file and line if that cannot be the name of a folder (base::name_fault).
std::string folder_name(TomlTable& table, const std::filesystem::path& file,
                        const std::string& ending = "");

}  // namespace touchstone::files
