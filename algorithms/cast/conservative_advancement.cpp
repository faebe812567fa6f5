// Conservative advancement: steps as long as the distance over a bound on the closing speed.
// Paper:   Mirtich, "Impulse-based dynamic simulation of rigid body systems", PhD thesis, Berkeley 1996;
//          Zhang, Lee, Kim, "Interactive continuous collision detection for non-convex polyhedra",
//          The Visual Computer 22, 2006 (the bound along the direction of the closest points).
// Steps:   1. GJK finds the distance and the direction n of the closest points (kernels/gjk).
//          2. No point of body a comes nearer to b along n faster than
//             mu = -n . v + |n x w_a| rho_a + |n x w_b| rho_b, with v the velocity of b's origin from a's,
//             w the rotation vectors and rho the greatest distance of a body's points from its origin.
//          3. Go on by distance / mu; if that is beyond the end, it is a miss. Repeat until the distance
//             is within the tolerance (kernels/motion/advancement/advancement).
// Departs: the distance is the gap of GJK's plane less a bound on all rounding, so that no contact is
//          missed. The ball of a sphere or capsule does not count towards rho.
// Fails:   unknown / not_converged at the cap of 2,000 steps: it converges linearly, with a factor near 1
//          where mu is far above the true speed (long bodies that turn).
// Cost:    a GJK distance a step. Tolerance: 1e-9 of the larger body's size.
#include "algorithms/kernels/motion/advancement/advancing_cast.h"

namespace touchstone {
namespace {

struct ConservativeStep {
  static constexpr bool balls_first = false, lasting_planes = false;
  static FreeUntil step(const RelativeMotion& motion, SupportPair<double>&,
                        const PartingPlane& plane) {
    const auto turning = [&](const MovingBody& body, double reach) {
      return plane.normal.cross(body.motion->rotation_vector).norm() * reach;
    };
    const double speed = turning(motion.a(), motion.reach_a()) +
                         turning(motion.b(), motion.reach_b()) -
                         plane.normal.dot(motion.displacement());
    const double left = 1 - plane.time;
    if (plane.gap - left * speed > 0) return {1, true};
    return {plane.time + plane.gap / speed, false};
  }
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CastEntry> cast_conservative_advancement() {
  return {
      {.info = {.name = "conservative-advancement",
                .citation = "Mirtich, \"Impulse-based dynamic simulation of rigid body systems\", "
                            "PhD thesis, Berkeley 1996; Zhang, Lee, Kim, \"Interactive continuous "
                            "collision detection for non-convex polyhedra\", The Visual Computer "
                            "22, 2006"},
       .scalars = {Precision::float64},
       .rotation = true,
       .in_time = true,
       .supports = advancing_cast_supports,
       .make = [](const CastSettings& settings) {
         return std::make_unique<AdvancingCast<ConservativeStep>>(settings);
       }}};
}

}  // namespace touchstone::entries
