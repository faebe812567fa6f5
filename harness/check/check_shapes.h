// Random shapes for the checks: of every kind, size and proportion.
#pragma once

#include <cstdint>

#include "algorithms/core/shape.h"
#include "harness/scene/random.h"

namespace touchstone {

enum class Form : std::uint8_t { compact, needle, plate };

// What a random shape is to be like. A compact shape's sides are within a factor of four of each
// other; a needle has one long side and two short ones, a plate two long sides and a short one, in
// the ratio `aspect`. Spheres are always compact, and capsules never plates.
struct ShapeStyle {
  double size = 1;  // metres: the longest side is between this and twice it (hulls: or less)
  Form form = Form::compact;
  double aspect = 1;

  friend bool operator==(const ShapeStyle&, const ShapeStyle&) = default;
};

// Boxes and hulls most, then spheres and capsules, then the other bounded kinds.
ShapeKind random_kind(Random& random);

// Hulls come from a pool of the seed's, built when they are first drawn: random points, tetrahedra,
// split icosahedra, subsets of a grid (coplanar points) and prisms, of 4 to 64 vertices and now and
// then up to 512; some lie away from their local origin. Safe to call from several threads.
Shape random_shape(ShapeKind kind, const ShapeStyle& style, std::uint64_t seed, Random& random);

// The hull turned inside out: each vertex v becomes -v, exactly. Of a random hull of the pool, it
// comes from the pool.
Shape mirrored(const Shape& hull);

// A box with the same points as a hull of eight vertices.
Shape box_as_hull(const Vec3d& half_extents);

Shape hull_of(std::vector<Vec3d> points);

// A point inside the shape, as far as it has an inside; body coordinates. Not for half-spaces.
Vec3d inner_point(const Shape& shape);

// The greatest n . x over the shape's points (metres, times the length of n), for n in body
// coordinates; infinite for half-spaces.
double support_value(const Shape& shape, const Vec3d& n);

}  // namespace touchstone
