// Shapes with a given size, proportions, vertex count or flatness.
#pragma once

#include <cstddef>
#include <memory>

#include "algorithms/core/shape.h"
#include "harness/base/random.h"

namespace touchstone::check {

// Returns half the sides of a box whose longest side is `size` (metres). Compact: the others are a
// quarter of it or more, in random order.
Vec3d compact_half(double size, base::Random& random);
// Returns half the sides of a slender box. The shortest side is size / aspect, and the third is as
// long as the longest (a plate) or the shortest (a needle); in random order.
Vec3d slender_half(double size, double aspect, base::Random& random);

// Makes a shape of the kind with these half extents along its own axes, up to rounding. Hulls are
// the pool's of the seed (hull_pool.h), stretched. Round shapes have fewer sizes: a sphere takes
// the longest; a capsule the longest and the shortest; a cylinder or cone the longest and the
// shortest, of which the height is either one, or the longest and the middle one if the shape is
// compact.
Shape shape_of_extents(ShapeKind kind, const Vec3d& half, std::uint64_t seed, base::Random& random);

// Makes a hull with exactly so many vertices (4, or a power of ten from 10 to 100,000) on an
// ellipsoid with these semi-axes: rings of latitude, each turned by half a step against the next,
// between two flat ends. All other faces are triangles. It is built directly, without a hull
// search.
std::shared_ptr<const Hull> ringed_hull(std::size_t vertices, const Vec3d& radii);

// Makes a prism of `sides` sides, a metre across and below the plane z = 0, whose top is a cap: the
// rim at z = 0, and inside of it a ring and a middle point that rise to `bulge` (metres, >= 0).
Shape capped_prism(int sides, double bulge);

}  // namespace touchstone::check
