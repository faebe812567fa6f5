// Draws the cases of each axis, and their bodies.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "algorithms/core/shape.h"
#include "harness/base/random.h"
#include "harness/files/cases.h"
#include "harness/kinds/pair/regimes/features.h"
#include "harness/kinds/pair/regimes/regimes.h"

namespace touchstone::kinds {

// The functions that draw the cases of each axis, for axes.cpp. regime.parameter is the value:

RegimeCase draw_at_scale(RegimeDraw& draw);       // longest side of both bodies, metres
RegimeCase draw_at_aspect(RegimeDraw& draw);      // longest side over shortest
RegimeCase draw_at_distance(RegimeDraw& draw);    // distance of a from the origin, metres
RegimeCase draw_at_ratio(RegimeDraw& draw);       // size of one body over that of the other
RegimeCase draw_at_gap(RegimeDraw& draw);         // part of the pair's size
RegimeCase draw_at_depth(RegimeDraw& draw);       // part of the pair's size
RegimeCase draw_with_vertices(RegimeDraw& draw);  // vertices of one hull, or of both

// Draws a cap of many facets that bulges out of its rim's plane by the value, or two boxes side by
// side whose faces miss one plane by it; the value is a part of the size.
RegimeCase draw_near_coplanar(RegimeDraw& draw);
// Draws two edges, sides or faces in contact at the angle, radians.
RegimeCase draw_near_parallel(RegimeDraw& draw);

// Pairs of given kinds in a mild contact, for the draws of several axes.

struct KindPair {
  ShapeKind a, b;
};
// Returns the kinds of a slot. Every algorithm's kinds come within sixteen slots, polytopes most
// often.
KindPair kinds_of_slot(std::uint64_t slot);

// A gap of a tenth, a hundredth or a thousandth; < 0: a depth.
struct MildAmount {
  std::string name;  // such as "gap-1e-2"
  double value;      // part of a length
};
MildAmount mild_amount(base::Random& random);

// Places b at `gap` (metres; < 0: a depth) between random features of both bodies, and turns it.
// The shapes and the pose of a must be set; `fine` is as in features.h. Returns the features'
// names.
std::string place_at_features(files::Case& c, double gap, bool fine, base::Random& random);

// Places b at a mild part of `length` (metres), or now and then anywhere. Returns the detail of the
// case.
std::string place_mildly(files::Case& c, double length, base::Random& random);

// Shapes with a given size, proportions, vertex count or flatness.

// Returns half the sides of a box whose longest side is `size` (metres). Compact: the others are a
// quarter of it or more, in random order.
Vec3d compact_half(double size, base::Random& random);
// Returns half the sides of a slender box. The shortest side is size / aspect, and the third is as
// long as the longest (a plate) or the shortest (a needle); in random order.
Vec3d slender_half(double size, double aspect, base::Random& random);

// Makes a shape of the kind with these half extents along its own axes, up to rounding. Hulls are
// the pool's of the seed (check_shapes.h), stretched. Round shapes have fewer sizes: a sphere takes
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

}  // namespace touchstone::kinds
