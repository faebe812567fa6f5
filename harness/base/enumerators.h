// The values of an enumeration, derived by the compiler, so that no list is kept by hand.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>

namespace touchstone::base {

// True if `value` has a name in its enumeration. The compiler prints other values as a cast,
// "(touchstone::Phase)7".
template <auto value>
constexpr bool is_enumerator() {
  std::string_view text = __PRETTY_FUNCTION__;
  text = text.substr(0, text.rfind(']'));
  const std::size_t close = text.rfind(')');
  return close == std::string_view::npos || close + 1 == text.size() || text[close + 1] < '0' ||
         text[close + 1] > '9';
}

// Counts the named values from `first` on without a gap. They are at most 64.
template <class Enum, std::size_t first = 0>
constexpr std::size_t count_enumerators() {
  if constexpr (first >= 64 || !is_enumerator<static_cast<Enum>(first)>()) {
    return first;
  } else {
    return count_enumerators<Enum, first + 1>();
  }
}

// All values of an enumeration whose values are 0, 1, 2, ... in order.
template <class Enum>
requires std::is_enum_v<Enum>
inline constexpr auto enumerators = [] {
  std::array<Enum, count_enumerators<Enum>()> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<Enum>(i);
  return values;
}();

}  // namespace touchstone::base
