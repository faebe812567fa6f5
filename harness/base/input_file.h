// Files of strangers: of which kinds they may be, and how much of one is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace touchstone::base {

// The limits of all readers, which datasets/README.md states. What exceeds one is an InputError.
inline constexpr std::size_t longest_text = std::size_t{1} << 28;  // bytes: a line, or TOML or JSON
inline constexpr std::size_t largest_file = std::size_t{1} << 32;  // bytes: a mesh or an image
inline constexpr std::int64_t most_rows = 50'000'000;              // lines of a file of rows
inline constexpr std::uint64_t most_unpacked = std::uint64_t{1} << 34;  // bytes from a packed file
inline constexpr std::size_t most_digits = 100'000;  // of an integer; reading one is quadratic

// Throws InputError if the file is neither a regular one nor a pipe, or is not there. Does not open it.
void check_kind(const std::filesystem::path& file, std::string_view expected);

// A file that is open for reading: a regular one, or a pipe. `expected` is what a message asks for. Throws InputError
// if it is of another kind, such as a directory or a device, or cannot be read.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& file, std::string_view expected = "");
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  // Writes the next bytes to the front of the buffer, which must not be empty. Returns their number: 0 at the end
  // alone.
  std::size_t read(std::span<char> buffer);

 private:
  std::string file_, expected_;
  int descriptor_ = -1;
};

// The content of a file of at most so many bytes. Throws InputError as above, and if it has more.
std::string read_whole(const std::filesystem::path& file, std::size_t most,
                       std::string_view expected = "");

}  // namespace touchstone::base
