// Files that are where they seem to be.
#pragma once

#include <filesystem>

namespace touchstone::files {

// True for a regular file in the folder or below it, with no symbolic link that leads out of it: not
// for a device, a pipe, or what is not there.
bool is_regular_inside(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace touchstone::files
