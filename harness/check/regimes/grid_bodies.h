// Bodies on a grid, whose contact is exact in double and in float.
//
// Sizes and places are whole multiples of a power of two, and rotations are signed permutations.
#pragma once

#include <cstdint>
#include <string>

#include "harness/base/random.h"
#include "harness/files/cases.h"

namespace touchstone::check {

inline constexpr double grid_step = 1.0 / 32;  // metres

// Makes a shape centred on the local origin, of 1 to `most` steps on each side of it; a hull has a
// box's vertices. Not for half-spaces.
Shape grid_shape(ShapeKind kind, int most, base::Random& random);
// Returns half the sides of the box around a shape that is centred on its local origin.
Vec3d grid_extents(const Shape& shape);
// Draws a whole number of steps between low and high, which are whole numbers of steps too.
double on_grid(double low, double high, base::Random& random);

enum class Roundness : std::uint8_t { none, balls };

// Makes two bodies touch, and returns how they do.
// - none: two boxes or hulls, or a half-space and one of them, share a piece of face, edge or
//   vertex.
// - balls: a sphere or capsule and a body of these kinds. The offset of their cores is an edge or
//   diagonal of Pythagorean whole numbers, so its length is whole and is the sum of the radii.
// With `ulps` > 0 one of the radii is less by as many units in the last place, which separates the
// bodies by that; with `ulps` < 0 it is more.
std::string touch_on_grid(files::Case& c, Roundness roundness, int ulps, base::Random& random);

// Makes a cylinder, cone or ellipsoid touch a body of any bounded kind along an axis.
std::string touch_along_axis(files::Case& c, base::Random& random);

}  // namespace touchstone::check
