// What became of isolated work, told on the terminal.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "harness/process/isolate.h"

namespace touchstone {

// One line for each of the first failures of an algorithm, and how many more there are; `name_of`
// says what an item is called.
inline void print_failures(std::string_view algorithm, std::span<const IsolationFailure> failures,
                           const std::function<std::string(std::size_t)>& name_of) {
  constexpr std::size_t shown = 5;
  for (const IsolationFailure& failure : failures.first(std::min(shown, failures.size()))) {
    fmt::print(stderr, "{}, {}: {}\n", algorithm, name_of(failure.item), failure.reason());
  }
  if (failures.size() > shown) {
    fmt::print(stderr, "{}: {} more failures\n", algorithm, failures.size() - shown);
  }
}

}  // namespace touchstone
