// Names of the user's, as names of folders and files, and as words of a command that may be pasted
// into a shell.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

#include "harness/base/input_file.h"

namespace touchstone::base {

inline constexpr std::size_t longest_name = 100;  // bytes

// True for one component of a path that leads to no other folder: neither empty, "." nor "..", and
// without '/' and NUL.
bool is_component(std::string_view name);

// Returns why a text cannot name a folder of results; empty if it can. Such a name is one component
// of a path, of 1 to 100 bytes, without control characters, and neither "." nor "..".
std::string name_fault(std::string_view name);

// Returns a file's name of at most `longest_name` bytes for a text: letters, digits and a few signs
// stay, and each other byte becomes '_'. Different texts may get the same name.
std::string safe_file_name(std::string_view text);

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

// Replaces each `from` in the text, which is not empty, by `to`.
inline void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
}

}  // namespace touchstone::base
