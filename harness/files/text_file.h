// Reads and writes text files.
#pragma once

#include <filesystem>
#include <string>

namespace touchstone::files {

// Returns the content of a file. Throws InputError if it cannot be read.
std::string read_text(const std::filesystem::path& file);

// Writes the file as an OutputFile is written: whole, or its old content stays. Throws InputError.
void write_text(const std::filesystem::path& file, const std::string& content);

}  // namespace touchstone::files
