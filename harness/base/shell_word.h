// Words of a command that a user may paste into a shell.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

#include "harness/base/file_text.h"

namespace touchstone::base {

// Returns the text as one word of the shell, quoted if it has to be. Control characters are written
// as $'\x1b', which bash reads, so that a terminal does not obey them.
inline std::string shell_word(std::string_view text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-+=.,:/@%").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return std::string(text);
  if (has_control(text)) {
    std::string word = "$'";
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (is_control_at(text, i) || (i > 0 && text[i - 1] == '\xc2')) {
        word += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i]));
      } else {
        if (text[i] == '\'' || text[i] == '\\') word += '\\';
        word += text[i];
      }
    }
    return word + "'";
  }
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace touchstone::base
