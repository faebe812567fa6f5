// Stands between the program and its two standard streams.
#include "harness/process/standard_output.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>
#include <string_view>

#include "harness/base/input_file.h"
#include "harness/base/progress.h"

namespace touchstone::process {
namespace {

// Returns the text with escapes, but for the progress bar's way to the begin of its line.
std::string escaped(std::string_view text) {
  const std::string_view kept = base::Progress::line_begin;
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(kept, at), text.size());
    shown += base::printable(text.substr(at, end - at));
    if (end < text.size()) shown += kept;
    at = end + kept.size();
  }
  return shown;
}

// The write function of a stream whose cookie is a descriptor.
ssize_t write_escaped(void* cookie, const char* bytes, std::size_t size) {
  const auto descriptor = static_cast<int>(reinterpret_cast<std::intptr_t>(cookie));
  const std::string text = escaped({bytes, size});
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::write(descriptor, text.data() + at, text.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return 0;
    at += static_cast<std::size_t>(written);
  }
  return static_cast<ssize_t>(size);
}

void escape(std::FILE*& stream, int descriptor, int buffering) {
  std::fflush(stream);
  std::FILE* const escaping = fopencookie(reinterpret_cast<void*>(std::intptr_t{descriptor}), "w",
                                          {nullptr, write_escaped, nullptr, nullptr});
  if (escaping == nullptr) return;
  std::setvbuf(escaping, nullptr, buffering, BUFSIZ);
  stream = escaping;
}

}  // namespace

void escape_output() {
  escape(stdout, STDOUT_FILENO, isatty(STDOUT_FILENO) == 1 ? _IOLBF : _IOFBF);
  escape(stderr, STDERR_FILENO, _IONBF);
}

bool finish_output() {
  errno = 0;
  std::cout.flush();
  bool lost = !std::cout || std::ferror(stdout) != 0;
  lost = std::fflush(stdout) != 0 || lost;
  // A file system of a network may say no sooner than when a file is closed.
  const int copy = dup(STDOUT_FILENO);
  lost = (copy >= 0 && close(copy) != 0) || lost;
  if (!lost) return true;
  const int cause = errno;
  std::fprintf(stderr, "touchstone: standard output: cannot be written%s%s\n",
               cause == 0 ? "" : ": ", cause == 0 ? "" : std::strerror(cause));
  return false;
}

}  // namespace touchstone::process
