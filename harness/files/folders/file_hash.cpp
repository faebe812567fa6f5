// Hashes files.
#include "harness/files/folders/file_hash.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include "harness/base/error.h"

namespace touchstone::files {

void add_file(base::ByteHash& hash, const std::filesystem::path& file, std::int64_t first,
              std::int64_t end) {
  if (first >= end) return;
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(first);
  constexpr std::int64_t most = 1 << 20;  // bytes at once
  std::vector<char> buffer(static_cast<std::size_t>(std::min(end - first, most)));
  while (first < end) {
    stream.read(buffer.data(), std::min(end - first, std::ssize(buffer)));
    if (stream.gcount() == 0) throw base::InputError(file.string(), 0, "cannot be read");
    hash.add({buffer.data(), static_cast<std::size_t>(stream.gcount())});
    first += stream.gcount();
  }
}

}  // namespace touchstone::files
