// How the cases of each group of regimes are drawn; for regimes.cpp.
#pragma once

#include "harness/check/regimes/check_shapes.h"
#include "harness/check/regimes/regimes.h"

namespace touchstone::check {

// Features at a gap or depth: regime.parameter times the pair's size.
RegimeCase draw_contact(RegimeDraw& draw);
// Features at several gaps and depths and random poses, of extreme bodies or far away:
// regime.parameter is ...
RegimeCase draw_aspect(RegimeDraw& draw);  // the ratio of long and short sides
RegimeCase draw_scale(RegimeDraw& draw);   // the size of both bodies, metres
RegimeCase draw_far(RegimeDraw& draw);     // their distance from the origin, metres
RegimeCase draw_ratio(RegimeDraw& draw);   // the ratio of the two sizes

// Exactly touching, in every encoding of the input.
RegimeCase draw_touching_baked(RegimeDraw& draw);
RegimeCase draw_touching_origin(RegimeDraw& draw);
RegimeCase draw_touching_grid(RegimeDraw& draw);
RegimeCase draw_touching_pythagorean(RegimeDraw& draw);  // parameter: ulps that a radius is less by
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

// --- what several groups share ------------------------------------------------------------------

// A random translation of about `size`, or none; a random rotation, or now and then none.
Pose random_pose(double size, base::Random& random);
// The two bodies exchanged, half of the time.
void swap_at_random(files::Case& c, base::Random& random);
// Names such as "box-hull" for the id.
std::string kinds_of(const files::Case& c);

// A gap (as a part of the size), a depth, or a random pose.
struct Amount {
  std::string_view name;
  double value = 0;
  bool random_pose = false;
};
Amount random_amount(base::Random& random);
// Places b at the amount between random features of the two shapes, which are set; sets the poses.
// Returns what it did, for the detail.
std::string place_by_amount(files::Case& c, const Amount& amount, base::Random& random);

}  // namespace touchstone::check
