// The lines of a text file, plain or packed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/files/byte_reader.h"

namespace touchstone::files {

// Reads a file line by line, through a ByteReader and with its errors.
class LineReader {
 public:
  explicit LineReader(const std::filesystem::path& file);
  // Returns the next line with its LF, which the last may lack, or nothing at the end. It is valid
  // until the next call. Throws InputError with its number for a line of more than base::longest_text bytes, and for
  // one after base::most_rows.
  std::optional<std::string_view> next();

 private:
  void refuse_longer(std::size_t size) const;
  std::string_view take(std::size_t size);

  std::string file_;
  ByteReader bytes_;
  std::int64_t line_ = 0;  // that was taken last
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of what is in the buffer and was not taken
};

}  // namespace touchstone::files
