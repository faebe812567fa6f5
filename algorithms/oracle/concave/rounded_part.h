// Part of the oracle: a part of a body where doubles place it.
#pragma once

#include <cstdint>

#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/oracle/certificates/parts/placed_parts.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// The part in world coordinates, for hints: the product of its poses is rounded, and may be beyond doubles. `parts`
// are those of `body` at `pose`, and must outlive what is returned.
inline Body rounded_part(const PlacedParts& parts, const ConcaveBody& body, const Pose& pose,
                         std::uint32_t part) {
  return {parts.solid(part), body.mesh ? pose : composed(pose, body.parts[part].pose, 1).pose};
}

}  // namespace touchstone::oracle
