// The convex shape that a body is, where it is no more than that.
#pragma once

#include "algorithms/core/mesh/concave_body.h"

namespace touchstone {

// The shape of a body of one part that is neither placed nor rounded; null for all others.
inline const Shape* sole_shape(const ConcaveBody& body) {
  if (body.mesh || body.parts.size() != 1) return nullptr;
  const ConvexPart& part = body.parts.front();
  const bool is_plain = part.rounding == 0 && part.pose.rotation == Mat3d::Identity() &&
                        part.pose.translation == Vec3d::Zero();
  return is_plain ? &part.shape : nullptr;
}

}  // namespace touchstone
