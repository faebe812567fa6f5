// Opens files and reads them in blocks.
#include "harness/base/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "harness/base/error.h"

namespace touchstone::base {
namespace {

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "Is a directory";
  if (S_ISSOCK(mode)) return "is a socket";
  return S_ISREG(mode) || S_ISFIFO(mode) ? nullptr : "is a device";
}

[[noreturn]] void refuse(const std::string& file, std::string message, std::string_view expected) {
  if (!expected.empty()) message += fmt::format("; expected {}", expected);
  throw InputError(file, 0, message);
}

}  // namespace

void check_kind(const std::filesystem::path& path, std::string_view expected) {
  const std::string file = path.string();
  struct stat facts = {};
  if (stat(file.c_str(), &facts) != 0) refuse(file, std::strerror(errno), expected);
  const char* const kind = kind_of(facts.st_mode);
  if (kind == nullptr) return;
  refuse(file, kind, expected.empty() ? "a regular file or a pipe" : expected);
}

InputFile::InputFile(const std::filesystem::path& file, std::string_view expected)
    : file_(file.string()), expected_(expected) {
  check_kind(file, expected);  // to open a device may do something
  descriptor_ = open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) refuse(file_, std::strerror(errno), expected_);
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::size_t InputFile::read(std::span<char> buffer) {
  for (;;) {
    const ssize_t got = ::read(descriptor_, buffer.data(), buffer.size());
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) refuse(file_, std::strerror(errno), expected_);
  }
}

std::string read_whole(const std::filesystem::path& path, std::size_t most,
                       std::string_view expected) {
  InputFile file(path, expected);
  std::string content;
  std::size_t size = 0;
  for (;;) {
    if (size == content.size()) content.resize(std::max<std::size_t>(2 * size, 1 << 16));
    const std::size_t got = file.read(std::span(content).subspan(size));
    size += got;
    if (size > most) {
      throw InputError(path.string(), 0,
                       fmt::format("more than {} bytes; expected at most so many", most));
    }
    if (got == 0) break;
  }
  content.resize(size);
  content.shrink_to_fit();
  return content;
}

}  // namespace touchstone::base
