// Part of certified: verdicts and depths of polytopes, rounded or not, at contact and inside it.
// Includes core, kernels and this folder.
//
// Each function writes a proven answer and returns true, or returns false; then normal and witness
// points may have changed.
#pragma once

#include "algorithms/kernels/epa/expanding_polytope.h"
#include "algorithms/kernels/minkowski/simplex.h"
#include "algorithms/narrow_phase/certified/distance_bounds.h"
#include "algorithms/narrow_phase/certified/exact_contact.h"
#include "algorithms/narrow_phase/certified/placed_body.h"

namespace touchstone {

class PolytopeContact {
 public:
  // In the pair's unit: what is nearer to contact is decided exactly.
  static constexpr double nearly = 64 * SupportPair<double>::rounding;

  // Decides polytopes without radius exactly. The simplex, which may be empty, has a face near the
  // origin. The direction (any length, or zero) is one along which a plane may separate them, from
  // a to b. What the task asks for is found at contact alone.
  bool decide_exactly(SupportPair<double>& pair, const Simplex<double>& simplex,
                      const Vec3d& direction, const PlacedPair& bodies, Task task,
                      Outcome& outcome);
  // Whether EPA's faces, from a simplex around the origin, prove that polytopes without radius
  // overlap.
  bool encloses(SupportPair<double>& pair, const Simplex<double>& simplex, Outcome& outcome);
  // Finds the depth of polytopes without radius that share a point, or at contact the exact answer
  // to the task, which asks for the depth. `bounder` proves the depth.
  bool find_depth(SupportPair<double>& pair, const Simplex<double>& simplex,
                  const PlacedPair& bodies, DistanceBounder& bounder, Task task, Outcome& outcome);
  // Decides whether the cores of rounded polytopes are their radii apart, if `gap`, the bounds on
  // the signed distance, leaves that open. The simplex is the feature nearest to the origin, and
  // `normal` the direction from a to b.
  bool decide_rounded(SupportPair<double>& pair, const Simplex<double>& simplex,
                      const Vec3d& normal, DistanceBounds gap, const PlacedPair& bodies, Task task,
                      Outcome& outcome);
  // The same for a polytope a and a half-space b. `unit` (metres) is above the reach of a.
  bool decide_over_plane(DistanceBounds gap, double unit, const PlacedPair& bodies, Task task,
                         Outcome& outcome);

 private:
  ExactContactFinder finder_;
  ExpandingPolytope<double> polytope_{64};
};

}  // namespace touchstone
