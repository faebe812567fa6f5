// Writes text files.
#include "harness/files/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "harness/base/error.h"

namespace touchstone::files {

void write_text(const std::filesystem::path& file, const std::string& content) {
  std::ofstream stream(file, std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) {
    throw base::InputError(file.string(), 0,
                           fmt::format("cannot be written: {}", std::strerror(errno)));
  }
}

}  // namespace touchstone::files
