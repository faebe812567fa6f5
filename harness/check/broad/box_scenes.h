// Small scenes of boxes that broad phases are checked on: where boxes touch exactly, have no
// volume, coincide, are huge, tiny, far away or of very different sizes.
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

// The same for a seed on every platform.
std::vector<BoxScene> box_scenes(std::uint64_t seed);

}  // namespace touchstone::check
