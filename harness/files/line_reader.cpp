// Cuts the bytes of a file into lines.
#include "harness/files/line_reader.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace touchstone::files {

LineReader::LineReader(const std::filesystem::path& file)
    : bytes_(file), buffer_(std::size_t{1} << 17) {}

std::string_view LineReader::take(std::size_t size) {
  const std::string_view line(buffer_.data() + begin_, size);
  begin_ += size;
  return line;
}

std::optional<std::string_view> LineReader::next() {
  std::size_t searched = 0;  // bytes from begin_ on that hold no LF
  for (;;) {
    const char* const from = buffer_.data() + begin_;
    const std::size_t there = end_ - begin_;
    if (const void* const found = std::memchr(from + searched, '\n', there - searched)) {
      return take(static_cast<std::size_t>(static_cast<const char*>(found) - from) + 1);
    }
    searched = there;
    std::copy(from, from + there, buffer_.data());
    begin_ = 0;
    end_ = there;
    if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
    const std::size_t got = bytes_.read(std::span(buffer_).subspan(end_));
    end_ += got;
    if (got > 0) continue;
    if (there == 0) return std::nullopt;
    return take(there);
  }
}

}  // namespace touchstone::files
