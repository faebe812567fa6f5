// Which algorithm answers a pair of kinds.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/api/conversions.h"

namespace touchstone::v1 {

// Places in a list of entries, for each task and two kinds in ascending order. `none`: unsupported.
struct Choice {
  static constexpr std::uint8_t none = 0xff;
  using Kinds = std::array<std::array<std::uint8_t, 8>, 8>;

  std::vector<const NarrowPhaseEntry*> pair_entries;
  std::array<Kinds, 4> alone, many;  // one pair a call, and a batch
  std::uint8_t where_open = none;    // asked if that leaves the answer unknown
  std::vector<const CastEntry*> cast_entries;
  std::array<Kinds, 2> casts;  // [1]: one of the bodies turns
};

// Empty names: what results/choosing.md says. Throws if there is no algorithm of a name.
Choice chosen(const std::string& algorithm, const std::string& cast_algorithm);

}  // namespace touchstone::v1
