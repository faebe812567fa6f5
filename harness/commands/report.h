// The page that `report` and `query --page` write.
#pragma once

#include <filesystem>
#include <string>

#include "harness/files/json_line.h"

namespace touchstone::commands {

// Returns the built page of this file, or without one the launcher's. Throws InputError if it is not built.
std::string built_page(const std::filesystem::path& file);

// Writes the page with these results and scenes in it, and prints its name and size.
void write_report(const std::filesystem::path& out, const std::string& page,
                  files::OrderedJson results, files::OrderedJson scenes);

}  // namespace touchstone::commands
