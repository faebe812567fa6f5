// Shapes whose size, proportions, vertex count or flatness is a given number.
#pragma once

#include <cstddef>
#include <memory>

#include "algorithms/core/shape.h"
#include "harness/base/random.h"

namespace touchstone::check {

// Half the sides of the box around a shape, whose longest side is `size` (metres). Compact: the
// others are a quarter of it or more, in no order.
Vec3d compact_half(double size, base::Random& random);
// The shortest side is size / aspect, and the third side as long as the longest (a plate) or as the
// shortest (a needle); in no order.
Vec3d slender_half(double size, double aspect, base::Random& random);

// Of the kind, with these half extents along its own axes up to rounding: hulls are the pool's of
// the seed (hull_pool.h), stretched. Round shapes have fewer sizes: a sphere the longest; a capsule
// the longest and the shortest; cylinder and cone the longest and the shortest, of which the height
// is one or the other, but the longest and the middle one where the shape is compact.
Shape shape_of_extents(ShapeKind kind, const Vec3d& half, std::uint64_t seed, base::Random& random);

// The ratio of the longest extent to the shortest of all that the shape has.
double aspect_of(const Shape& shape);

// A hull with exactly so many vertices (4, or a power of ten from 10 to 100,000) on an ellipsoid
// with these semi-axes: rings of latitude, each turned by half a step against the next, between two
// flat ends. Its faces are triangles but for the ends. Built without a search.
std::shared_ptr<const Hull> ringed_hull(std::size_t vertices, const Vec3d& radii);

// A prism of `sides` sides and a metre across, below the plane z = 0, whose top is a cap: the rim
// at z = 0, and inside of it a ring and a middle that rise to `bulge` (metres, >= 0).
Shape capped_prism(int sides, double bulge);

}  // namespace touchstone::check
