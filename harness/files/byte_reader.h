// The bytes of a file, unpacked on the way where zstd packed them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "harness/base/input_file.h"

namespace touchstone::files {

// Reads a file from its beginning to its end. A file whose name ends in ".zst" is unpacked on the
// way, in constant memory, and its frames are read as one. Throws InputError with the file's name if
// it is no regular file or pipe, cannot be read, is no zstd, is damaged, ends in the middle of a frame, or is more
// than base::most_unpacked when it is unpacked.
class ByteReader {
 public:
  explicit ByteReader(const std::filesystem::path& file);
  ~ByteReader();
  ByteReader(const ByteReader&) = delete;
  ByteReader& operator=(const ByteReader&) = delete;

  // Writes the next bytes to the front of the buffer, which must not be empty. Returns their number:
  // 0 at the end alone.
  std::size_t read(std::span<char> buffer);

 private:
  struct Unpacking;

  std::size_t unpack(std::span<char> buffer);
  [[noreturn]] void fail(const std::string& message) const;

  std::string file_;
  base::InputFile input_;
  std::unique_ptr<Unpacking> unpacking_;  // null for a plain file
  std::uint64_t unpacked_ = 0;            // bytes
};

}  // namespace touchstone::files
