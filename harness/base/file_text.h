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

}  // namespace touchstone::base
