// Small scenes of boxes for checks of broad phases.
//
// Their boxes touch exactly, have no volume, coincide, are huge, tiny or far away, or differ much
// in size.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/core/aabb.h"

namespace touchstone::check {

struct BoxScene {
  std::string name;
  // From frame to frame some boxes move, some leave (their slot is then empty), some come back and
  // some are new. The array never shrinks.
  std::vector<std::vector<Aabb>> frames;
};

// Returns the scenes of a seed, equal on every platform.
std::vector<BoxScene> box_scenes(std::uint64_t seed);

}  // namespace touchstone::check
