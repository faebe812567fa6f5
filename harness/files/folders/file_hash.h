// The hash of a file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "harness/base/byte_hash.h"

namespace touchstone::files {

// Adds the bytes of a file from `first` to before `end`, as they are on the disk. Throws InputError
// if they cannot be read.
void add_file(base::ByteHash& hash, const std::filesystem::path& file, std::int64_t first,
              std::int64_t end);

}  // namespace touchstone::files
