// Part of certified: the exact verdict for two polytopes that touch, or are nearer to that than
// rounding. Includes core, kernels, the oracle's solids and this folder.
//
// Doubles tell which vertices may be furthest in a direction. Only these few are taken as integers.
// Rounded polytopes are compared by the squared distance of their cores (exact_gap.inl).
// Paper:   Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008
//          (portals); Shewchuk, "Adaptive precision floating-point arithmetic and fast robust
//          geometric predicates", Discrete & Computational Geometry 18, 1997 (filters).
// Steps:   1. Cast a ray from a point inside the difference C = A - B through the origin. Take the
//             face of GJK's last simplex that the ray passes, or find three points of C around the
//             ray, and push them to the surface of C, in doubles (rough_portal).
//          2. Place them on a grid of integers (grid_body); signs confirm that the ray passes their
//             triangle, the portal.
//          3. Take the portal's normal exactly, and list the vertices of a and of b within 2e-9 of
//             the pair's unit of their support planes along it.
//          4. The origin strictly below the portal: overlapping. All of C below the origin along
//             the normal: separated. Neither, and the portal contains the origin and no point of C
//             is beyond it: touching.
//          5. Otherwise replace a corner of the portal by the point of C furthest along the normal
//             and repeat from step 3.
//          6. If that fails, repeat from step 1 with rays from the middle of C. At last, a single
//             point of C near the given plane may be the origin, or all of C be behind the plane.
// Departs: the portal is refined in integers; signs are taken from doubles where a bound on their
//          rounding allows it.
// Fails:   unknown where C has no volume around the rays, where more than 128 vertices of a body
//          are looked at, and for numbers whose exponents are too far apart for 256 bits. Never
//          wrong.
// Cost:    24 products of 64 bits for each vertex near the plane and each portal where two limbs
//          do, 9 where one does.
#pragma once

#include <limits>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/minkowski/simplex.h"
#include "algorithms/narrow_phase/certified/placed_body.h"

namespace touchstone {

// `answer` is unknown if nothing is proven. The rest is set if the task asks for it: the signed
// distance lies in [lower, upper] (metres), the normal is from a to b, and the witness points
// (metres, world) are those of the portal's point on the ray.
struct ExactContact {
  Answer answer = Answer::unknown;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  Vec3d normal = Vec3d::Zero();
  Vec3d on_a = Vec3d::Zero(), on_b = Vec3d::Zero();
};

// What an iteration in doubles says of the place of contact. It need not be right.
struct ContactGuess {
  Vec3d normal;  // unit length, from a to b, world
  // Support points of the pair near the origin, which may be none. Of rounded polytopes: one to
  // three, the corners of the feature nearest to the origin.
  const Simplex<double>& simplex;
};

class ExactContactFinder {
 public:
  // Both are polytopes, and `pair` has their cores. If they have a radius, the guess must
  // have a corner, the answer is that of the rounded bodies, and nothing else is set.
  ExactContact find(const PlacedBody& a, const PlacedBody& b, const ContactGuess& guess,
                    SupportPair<double>& pair, Task task);
  // The verdict of a polytope, rounded or not, and a half-space whose pose has no rotation. Unknown
  // for a half-space that is turned. `unit` (metres) is above the reach of a.
  Answer find_over_plane(const PlacedBody& a, const PlacedBody& halfspace, double unit);

 private:
  std::vector<double> heights_;  // memory to work in
};

}  // namespace touchstone
