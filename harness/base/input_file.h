// Files of strangers: of which kinds they may be, how much of one is read, where its text begins,
// and how messages quote it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace touchstone::base {

// The text behind the byte-order mark of UTF-8, which editors may put in front.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

// The text for a message: cut after so many characters, and with '?' for those that are not printable
// ASCII.
inline std::string shortened(std::string_view text, std::size_t most = 80) {
  std::string shown(text.substr(0, most));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text.size() > most ? shown + "..." : shown;
}

// True for a byte below ' ', DEL, and the first byte of a control character of two bytes (C1).
inline bool is_control_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const bool is_c1 = byte(at) == 0xc2 && at + 1 < text.size() && (byte(at + 1) & 0xe0) == 0x80;
  return byte(at) < ' ' || byte(at) == 0x7f || is_c1;
}

inline bool has_control(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_control_at(text, i)) return true;
  }
  return false;
}

// The text for a terminal: each control character but the line feed and the tab is written as
// "\x1b", so that no name sets a title or moves the cursor.
inline std::string printable(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string shown;
  shown.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n' || text[i] == '\t' || !is_control_at(text, i)) {
      shown += text[i];
      continue;
    }
    const std::size_t bytes = static_cast<unsigned char>(text[i]) == 0xc2 ? 2 : 1;
    for (const char c : text.substr(i, bytes)) {
      shown += "\\x";
      shown += digits[static_cast<unsigned char>(c) >> 4];
      shown += digits[static_cast<unsigned char>(c) & 15];
    }
    i += bytes - 1;
  }
  return shown;
}

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
