// The text of files of strangers: where it begins, and how messages quote it.
#pragma once

#include <cstddef>
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

}  // namespace touchstone::base
