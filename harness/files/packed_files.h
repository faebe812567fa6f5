// Files that zstd may have packed: their names, bytes and lines, unpacked on the way, and their
// writing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/input_file.h"
#include "harness/files/output_file.h"

struct ZSTD_CCtx_s;

namespace touchstone::files {

// Returns the name of the file when it is packed: raw.csv.zst for raw.csv.
std::filesystem::path packed_name(std::filesystem::path csv);

// Returns true if the file's name says that it is packed.
bool is_packed(const std::filesystem::path& file);

// Returns the file of rows that is there: `csv`, or else its packed name; `csv` if neither is.
std::filesystem::path row_file(const std::filesystem::path& csv);

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

// Packs bytes into one frame, with a checksum, in constant memory. The file is written as an
// OutputFile, with the same errors: it is whole after `close`, and absent without.
class ZstdWriter {
 public:
  // Levels go from 1, the fastest, to 19, the smallest file.
  explicit ZstdWriter(std::filesystem::path file, int level = 3);
  ~ZstdWriter();
  ZstdWriter(const ZstdWriter&) = delete;
  ZstdWriter& operator=(const ZstdWriter&) = delete;

  void write(std::string_view bytes);
  void close();

 private:
  struct FreeContext {
    void operator()(ZSTD_CCtx_s* context) const;
  };
  // Packs the bytes, and ends the frame if they are the last.
  void pack(std::string_view bytes, bool last);

  OutputFile file_;
  std::unique_ptr<ZSTD_CCtx_s, FreeContext> context_;
  std::vector<char> packed_;
};

}  // namespace touchstone::files
