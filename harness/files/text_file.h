// Whole files: their text, their hash, and whether they are where they seem to be.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "harness/base/hash.h"

namespace touchstone::files {

// Returns the content of a file. Throws InputError if it cannot be read.
std::string read_text(const std::filesystem::path& file);

// Writes the file as an OutputFile is written: whole, or its old content stays. Throws InputError.
void write_text(const std::filesystem::path& file, const std::string& content);

// Adds the bytes of a file from `first` to before `end`, as they are on the disk. Throws InputError
// if they cannot be read.
void add_file(base::ByteHash& hash, const std::filesystem::path& file, std::int64_t first,
              std::int64_t end);

// True for a regular file in the folder or below it, with no symbolic link that leads out of it: not
// for a device, a pipe, or what is not there.
bool is_regular_inside(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace touchstone::files
