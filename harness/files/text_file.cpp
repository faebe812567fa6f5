// Reads and writes text files.
#include "harness/files/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "harness/base/error.h"
#include "harness/base/input_file.h"

namespace touchstone::files {

std::string read_text(const std::filesystem::path& file) {
  return base::read_whole(file, base::longest_text);
}

void write_text(const std::filesystem::path& file, const std::string& content) {
  std::ofstream stream(file, std::ios::binary);
  const bool opened = stream.is_open();
  stream << content;
  stream.close();
  if (!stream) {
    const int cause = errno;
    std::error_code ignored;
    // Half a file would pass for a whole one. Devices stay, and so does what could not be opened.
    if (opened &&
        std::filesystem::is_regular_file(std::filesystem::symlink_status(file, ignored))) {
      std::filesystem::remove(file, ignored);
    }
    throw base::InputError(file.string(), 0,
                           fmt::format("cannot be written: {}", std::strerror(cause)));
  }
}

}  // namespace touchstone::files
