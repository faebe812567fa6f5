// Checks of option values that CLI11's own do not make.
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>

namespace touchstone {

// For CLI::Option::check: the fault of the text, or nothing.
inline std::string positive_number(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const bool good = error == std::errc{} && stop == end && std::isfinite(value) && value > 0;
  return good ? "" : fmt::format("found '{}'; expected a finite number > 0", text);
}

}  // namespace touchstone
