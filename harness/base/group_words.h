// Words that stand for several algorithms, or none, wherever names of algorithms are given.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace touchstone::base {

inline constexpr std::array<std::string_view, 7> group_words = {
    "all", "ours", "libraries", "peers", "oracle", "modules", "none"};

inline bool is_group_word(std::string_view word) {
  return std::ranges::find(group_words, word) != group_words.end();
}

}  // namespace touchstone::base
