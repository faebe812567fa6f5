// Pairs of bodies that lie face on face, as in a pile at rest.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "harness/files/cases.h"

namespace touchstone::kinds {

// A family of such pairs.
struct SettledFamily {
  std::string_view name;  // "stack", "tilt-1e-6": lower case, words joined by '-'
  std::string_view what;  // one line of description
};

// Returns all families in a stable order.
std::span<const SettledFamily> settled_families();

// Makes the case of this index alone, with the id "family/index". The bodies overlap by 1e-6 to
// 1e-3 of their size. Safe to call from several threads.
files::Case settled_pair(const SettledFamily& family, std::uint64_t seed, std::uint64_t index);

}  // namespace touchstone::kinds
