// Counts of instructions in the output of Valgrind's Callgrind.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace touchstone::files {

struct CallgrindCount {
  std::string name;  // of the dump, if a client asked for one; else the command that was run
  std::int64_t instructions = 0;
};

// Returns whether the file begins as one of Callgrind's does. Throws InputError if it cannot be read.
bool is_callgrind(const std::filesystem::path& file);

// Reads the sum of a file. Throws InputError if it has no name or no sum.
CallgrindCount read_callgrind(const std::filesystem::path& file);

}  // namespace touchstone::files
