// A range of numbered units of work.
#pragma once

#include <cstdint>
#include <string>

#include <fmt/core.h>

namespace touchstone::base {

// The units first, first + 1, ... below `end`, such as the blocks of a campaign or the jobs of a
// check.
struct UnitRange {
  std::int64_t first = 0, end = 0;

  std::int64_t size() const { return end - first; }
  bool empty() const { return end <= first; }
  bool operator==(const UnitRange&) const = default;
};

// Returns "12-34" for the units 12 to 33.
inline std::string to_string(const UnitRange& range) {
  return fmt::format("{}-{}", range.first, range.end);
}

}  // namespace touchstone::base
