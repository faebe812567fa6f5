// Random shapes for the checks: all kinds, sizes and proportions.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/core/shape.h"
#include "harness/base/random.h"

namespace touchstone::kinds {

// Random shapes for the checks: all kinds, sizes and proportions.

enum class Proportions : std::uint8_t { compact, needle, plate };

// The size and proportions of a random shape. A compact shape's sides are within a factor of four
// of each other; a needle has one long side and two short ones, a plate two long sides and a short
// one, in the ratio `aspect`. Spheres are always compact, and capsules never plates.
struct ShapeStyle {
  double size = 1;  // metres: the longest side is between this and twice it (hulls: or less)
  Proportions form = Proportions::compact;
  double aspect = 1;

  friend bool operator==(const ShapeStyle&, const ShapeStyle&) = default;
};

// Draws a kind: boxes and hulls are most frequent, then spheres and capsules, then the other
// bounded kinds.
ShapeKind random_kind(base::Random& random);

// Returns half of each side, the longest between size / 2 and size, in random order.
Vec3d random_sides(const ShapeStyle& style, base::Random& random);

// Draws a shape of the kind. Hulls come from the seed's pool (check_shapes.h). Safe to call from
// several threads.
Shape random_shape(ShapeKind kind, const ShapeStyle& style, std::uint64_t seed,
                   base::Random& random);

// Returns the point reflection of a hull: each vertex v becomes -v, exactly.
Shape mirrored(const Shape& hull);

// Returns a hull of eight vertices with the points of a box.
Shape box_as_hull(const Vec3d& half_extents);

// Returns a point inside the shape, or on it if it has no inside; body coordinates. Not for
// half-spaces.
Vec3d inner_point(const Shape& shape);

// Returns the greatest n . x over the shape's points (metres, times the length of n), for n in body
// coordinates; infinite for half-spaces.
double support_value(const Shape& shape, const Vec3d& n);

// The hulls of generated cases, built once each, since building takes long.

// Returns hull `entry` of the style, for the seed: random points, tetrahedra, split icosahedra,
// subsets of a grid (coplanar points) and prisms, of 4 to 64 vertices and, for two entries, up to
// 512; some lie away from their local origin. It depends on nothing else. The first call builds it,
// and later ones may find it again. Safe to call from several threads.
std::shared_ptr<const Hull> pooled_hull(std::uint64_t seed, std::uint64_t entry,
                                        const ShapeStyle& style);

// Returns the point reflection: each vertex v becomes -v, exactly. It is kept too if the hull is in
// the pool.
std::shared_ptr<const Hull> mirrored_hull(const Hull& hull);

}  // namespace touchstone::kinds
