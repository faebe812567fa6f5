// Reads, writes and hashes files, and follows links to their place.
#include "harness/files/text_file.h"

#include <algorithm>
#include <fstream>
#include <system_error>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/files/output_file.h"

namespace touchstone::files {

std::string read_text(const std::filesystem::path& file) {
  return base::read_whole(file, base::longest_text);
}

void write_text(const std::filesystem::path& file, const std::string& content) {
  OutputFile output(file);
  output.write(content);
  output.close(OutputFile::Durable::against_kills);
}

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

bool is_regular_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path place = std::filesystem::canonical(file, error);
  if (error) return false;
  const std::filesystem::path home = std::filesystem::canonical(folder, error);
  if (error || !std::filesystem::is_regular_file(place, error)) return false;
  return std::ranges::mismatch(home, place).in1 == home.end();
}

}  // namespace touchstone::files
