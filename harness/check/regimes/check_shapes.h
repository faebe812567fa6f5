// Random shapes for the checks: of every kind, size and proportion.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/core/shape.h"
#include "harness/base/random.h"

namespace touchstone::check {

enum class Proportions : std::uint8_t { compact, needle, plate };

// What a random shape is to be like. A compact shape's sides are within a factor of four of each
// other; a needle has one long side and two short ones, a plate two long sides and a short one, in
// the ratio `aspect`. Spheres are always compact, and capsules never plates.
struct ShapeStyle {
  double size = 1;  // metres: the longest side is between this and twice it (hulls: or less)
  Proportions form = Proportions::compact;
  double aspect = 1;

  friend bool operator==(const ShapeStyle&, const ShapeStyle&) = default;
};

// Boxes and hulls most, then spheres and capsules, then the other bounded kinds.
ShapeKind random_kind(base::Random& random);

// Half of each side, the longest between size / 2 and size, in no order.
Vec3d random_sides(const ShapeStyle& style, base::Random& random);

// Hulls come from the pool of the seed's (hull_pool.h). Safe to call from several threads.
Shape random_shape(ShapeKind kind, const ShapeStyle& style, std::uint64_t seed,
                   base::Random& random);

// A hull turned inside out: each vertex v becomes -v, exactly.
Shape mirrored(const Shape& hull);

// A box with the same points as a hull of eight vertices.
Shape box_as_hull(const Vec3d& half_extents);

Shape hull_of(std::vector<Vec3d> points);

// A point inside the shape, as far as it has an inside; body coordinates. Not for half-spaces.
Vec3d inner_point(const Shape& shape);

// The greatest n . x over the shape's points (metres, times the length of n), for n in body
// coordinates; infinite for half-spaces.
double support_value(const Shape& shape, const Vec3d& n);

}  // namespace touchstone::check
