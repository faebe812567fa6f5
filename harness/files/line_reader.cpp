// Cuts the bytes of a file into lines.
#include "harness/files/line_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "harness/base/error.h"
#include "harness/base/input_file.h"

namespace touchstone::files {

LineReader::LineReader(const std::filesystem::path& file)
    : file_(file.string()), bytes_(file), buffer_(std::size_t{1} << 17) {}

void LineReader::refuse_longer(std::size_t size) const {
  if (size <= base::longest_text) return;
  throw base::InputError(
      file_, line_ + 1,
      fmt::format("a line of more than {} bytes; expected at most so many", base::longest_text));
}

std::string_view LineReader::take(std::size_t size) {
  refuse_longer(size);
  const std::string_view line(buffer_.data() + begin_, size);
  begin_ += size;
  if (++line_ > base::most_rows) {
    throw base::InputError(file_, line_,
                           fmt::format("more lines; expected at most {}", base::most_rows));
  }
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
    refuse_longer(there);
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
