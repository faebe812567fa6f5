// Contact manifolds held to the bodies themselves: by the oracle, and by the area in which two
// faces touch, cut out in long double by other means than the algorithms have.
#pragma once

#include <optional>

#include "algorithms/contact_manifold.h"
#include "harness/files/cases.h"

namespace touchstone::grade {

// What is graded against, found once for each case.
struct ManifoldTruth {
  double size = 1;  // of the pair, metres
  // Of the least penetration, metres: the middle of the oracle's interval, which is wide for some
  // curved bodies. Negative where the bodies are apart.
  double depth = 0, least_depth = 0, greatest_depth = 0;

  bool overlap() const { return depth > 0; }
};

ManifoldTruth manifold_truth(const files::Case& c);

// Lengths as a part of the pair's size.
struct ManifoldGrade {
  bool missed = false;     // no point, though the bodies overlap
  double off_body = 0;     // the greatest distance of a point on_a from a, or on_b from b
  double off_line = 0;     // the greatest distance of on_a - on_b from depth * normal
  double depth_error = 0;  // of the deepest point, beyond the oracle's interval
  double apart = 0;        // the greatest gap at a point: how far from touching a place is
  // The area between the points, seen along the normal, as a part of the greatest that four
  // corners of the contact area span of which one is the deepest; and of all of it. At most 1: who
  // reports places that are apart may have more. Only where both bodies are boxes, solid hulls or
  // half-spaces and their faces, within 20 degrees of each being across the normal, touch in an
  // area.
  std::optional<double> of_best_four, of_all;
};

ManifoldGrade grade(const files::Case& c, const ManifoldTruth& truth, const Manifold& manifold);

// What rounding of world coordinates may put a point off by, as a part of the size.
double coordinate_rounding(const files::Case& c, const ManifoldTruth& truth);

}  // namespace touchstone::grade
