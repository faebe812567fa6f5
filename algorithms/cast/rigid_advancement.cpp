// Rigid advancement: steps as long as the plane of the closest points parts the turning bodies.
// Paper:   the step is ours; the loop is that of conservative advancement (Mirtich 1996), and the search
//          along a fixed direction is in the spirit of Catto, "Continuous collision", GDC 2013.
// Steps:   0. Begin where balls about the bodies' origins meet.
//          1. Choose a plane that parts them, with normal n: for boxes, along the axis of a face or two edges whose gap
//             lasts longest (kernels/motion/advancement/box_planes); for spheres and capsules, that of the closest
//             points at the contact to come (round_planes); otherwise GJK's of the closest points (kernels/gjk).
//          2. Go on for as long as that plane provably parts the bodies, turning with the face or the edges that it
//             belongs to where they are near (parting_step, turning_normal).
//          3. If the end is reached, it is a miss. Repeat until the distance is within the tolerance
//             (kernels/motion/advancement/advancement).
// Departs: gaps are taken less a bound on all rounding, so that no contact is missed.
// Fails:   unknown / not_converged at the cap of 2,000 steps. It is slow at many turns, where the
//          bound k belongs to the whole body.
// Cost:    a plane, which is a GJK distance for other bodies than boxes, spheres and capsules, and two to four support
//          calls a step; steps converge like Newton's, unless the
//          bodies graze. Tolerance: 1e-9 of the larger body's size.
#include "algorithms/kernels/motion/advancement/advancing_cast.h"
#include "algorithms/kernels/motion/advancement/parting_step.h"

namespace touchstone {
namespace {

struct RigidStep {
  static constexpr bool balls_first = true, lasting_planes = true;
  static FreeUntil step(const RelativeMotion& motion, SupportPair<double>& pair,
                        const PartingPlane& plane) {
    return longest_step(motion, pair, plane);
  }
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CastEntry> cast_rigid_advancement() {
  return {
      {.info = {.name = "rigid-advancement",
                .citation = "Touchstone's: conservative advancement by the longest step in which "
                            "the plane of the closest points parts the turning bodies"},
       .scalars = {Precision::float64},
       .rotation = true,
       .in_time = true,
       .supports = advancing_cast_supports,
       .make = [](const CastSettings& settings) {
         return std::make_unique<AdvancingCast<RigidStep>>(settings);
       }}};
}

}  // namespace touchstone::entries
