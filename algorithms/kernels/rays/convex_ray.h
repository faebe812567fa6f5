// A ray against a convex shape, in the shape's coordinates and in doubles.
#pragma once

#include <optional>

#include "algorithms/core/shape.h"
#include "algorithms/ray_cast.h"

namespace touchstone {

struct ConvexRayHit {
  double t = 0;
  // Outward normal of the surface, of any length; NaN where the ray begins in the shape, or the shape is
  // a point or a segment.
  Vec3d normal = Vec3d::Constant(Outcome::none);
};

// The least t in [0, ray.t_max] at which the ray is in the closed shape. The ray is proper. What is decided
// is off by some roundings of the shape's size and of the distance to it.
std::optional<ConvexRayHit> first_hit(const Shape& shape, const Ray& ray);

}  // namespace touchstone
