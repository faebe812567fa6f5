// The functions that draw the cases of each group of regimes; for regimes.cpp.
#pragma once

#include <cstdint>
#include <string>

#include "harness/base/random.h"
#include "harness/files/cases.h"
#include "harness/kinds/pair/regimes/check_shapes.h"
#include "harness/kinds/pair/regimes/regimes.h"

namespace touchstone::kinds {

// Places features at a gap or depth of regime.parameter times the pair's size.
RegimeCase draw_contact(RegimeDraw& draw);
// These draw features at several gaps and depths and random poses, of extreme bodies or far away.
// The unit of regime.parameter is beside each.
RegimeCase draw_aspect(RegimeDraw& draw);  // ratio of long and short sides
RegimeCase draw_scale(RegimeDraw& draw);   // size of both bodies, metres
RegimeCase draw_far(RegimeDraw& draw);     // distance from the origin, metres
RegimeCase draw_ratio(RegimeDraw& draw);   // ratio of the two sizes

// These touch exactly, in every encoding of the input.
RegimeCase draw_touching_baked(RegimeDraw& draw);
RegimeCase draw_touching_origin(RegimeDraw& draw);
RegimeCase draw_touching_grid(RegimeDraw& draw);
// regime.parameter is the number of ulps by which one radius is less.
RegimeCase draw_touching_pythagorean(RegimeDraw& draw);
RegimeCase draw_touching_curved(RegimeDraw& draw);

RegimeCase draw_identical(RegimeDraw& draw);
RegimeCase draw_same_pose(RegimeDraw& draw);
RegimeCase draw_same_centre(RegimeDraw& draw);
RegimeCase draw_contained(RegimeDraw& draw);
RegimeCase draw_contained_touching(RegimeDraw& draw);
RegimeCase draw_coplanar(RegimeDraw& draw);

RegimeCase draw_sliver(RegimeDraw& draw);
RegimeCase draw_flat_hull(RegimeDraw& draw);
RegimeCase draw_segment(RegimeDraw& draw);
RegimeCase draw_point(RegimeDraw& draw);
RegimeCase draw_zero_size(RegimeDraw& draw);
RegimeCase draw_redundant_hull(RegimeDraw& draw);
RegimeCase draw_scaled_degenerate(RegimeDraw& draw);

RegimeCase draw_random_polytopes(RegimeDraw& draw);
RegimeCase draw_random_mixed(RegimeDraw& draw);

// --- shared by several groups -------------------------------------------------------------------

// Draws a translation of about `size`, or none, and a random rotation, or now and then none.
Pose random_pose(double size, base::Random& random);
// Exchanges the two bodies half of the time.
void swap_at_random(files::Case& c, base::Random& random);
// Returns names such as "box-hull" for the id.
std::string kinds_of(const files::Case& c);

// A gap (as a part of the size), a depth, or a random pose.
struct Amount {
  std::string_view name;
  double value = 0;
  bool random_pose = false;
};
Amount random_amount(base::Random& random);
// Places b at the amount between random features of the two shapes, which must be set, and sets the
// poses. Returns the detail of the case's id.
std::string place_by_amount(files::Case& c, const Amount& amount, base::Random& random);

// Bodies on a grid, whose contact is exact in double and in float.
//
// Sizes and places are whole multiples of a power of two, and rotations are signed permutations.

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

}  // namespace touchstone::kinds
