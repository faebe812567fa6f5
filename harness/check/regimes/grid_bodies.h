// Bodies on a grid: sizes and places are whole multiples of a power of two and rotations are signed
// permutations, so that contact is exact, in double and in float.
#pragma once

#include <cstdint>
#include <string>

#include "harness/base/random.h"
#include "harness/files/cases.h"

namespace touchstone::check {

inline constexpr double grid_step = 1.0 / 32;  // metres

// Centred on the local origin, of 1 to `most` steps on each side of it; a hull is a box's. Not a
// half-space.
Shape grid_shape(ShapeKind kind, int most, base::Random& random);
// Half the sides of the box around a shape that is centred on its local origin.
Vec3d grid_extents(const Shape& shape);
// A whole number of steps from low to high, which are whole numbers of steps.
double on_grid(double low, double high, base::Random& random);

enum class Roundness : std::uint8_t { none, balls };

// Two boxes or hulls that share a piece of face, edge or vertex, or a half-space and one of them
// (none); or a sphere or capsule and a body of those kinds, whose cores' offset is an edge or
// diagonal of Pythagorean whole numbers, so that their distance is whole, and is the sum of the
// radii (balls). With `ulps` > 0 one of the radii is less by as many units in the last place: the
// bodies are apart by that; with `ulps` < 0 it is more. Returns how they touch.
std::string touch_on_grid(files::Case& c, Roundness roundness, int ulps, base::Random& random);

// A cylinder, cone or ellipsoid and a body of any bounded kind that touch along an axis.
std::string touch_along_axis(files::Case& c, base::Random& random);

}  // namespace touchstone::check
