// Families of cases, of all kinds, by name.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "harness/check/kinds/contestant.h"

namespace touchstone::check {

struct CaseFamily {
  std::string name;  // "triangles-edges-1e-9": lower case, words joined by '-'
  std::string
      group;  // "triangles", "bodies", "rays", "points", "casts", "turns", "vertex-face", "scene-rays", ...
  CaseKind kind{};
  std::uint32_t number = 0;  // among those of its kind
  int one_in = 1;            // so many times fewer cases, since the exact answer takes long
  // Of a value of an axis of stress; empty for others. Values of an axis follow each other.
  std::string axis, value;
};

// Returns all families, grouped by kind, in a stable order.
std::span<const CaseFamily> case_families();

// Returns the values of the axes of stress, in the same order.
std::span<const CaseFamily> axis_families();

}  // namespace touchstone::check
