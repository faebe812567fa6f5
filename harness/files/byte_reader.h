// The bytes of a file, unpacked on the way where zstd packed them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace touchstone::files {

// Reads a file from its beginning to its end. A file whose name ends in ".zst" is unpacked on the
// way, in constant memory, and its frames are read as one. Throws InputError with the file's name if
// it cannot be read, is no zstd, is damaged, or ends in the middle of a frame.
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

  std::size_t read_plain(std::span<char> buffer);
  std::size_t unpack(std::span<char> buffer);
  [[noreturn]] void fail(const std::string& message) const;

  std::string file_;
  int descriptor_ = -1;
  std::unique_ptr<Unpacking> unpacking_;  // null for a plain file
};

}  // namespace touchstone::files
