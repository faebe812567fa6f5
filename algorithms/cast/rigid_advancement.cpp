// Rigid advancement: steps as long as the plane of the closest points parts the turning bodies.
// Paper:   the step is ours; the loop is that of conservative advancement (Mirtich 1996), and the search
//          along a fixed direction is in the spirit of Catto, "Continuous collision", GDC 2013.
// Steps:   0. Begin where balls about the bodies' origins meet.
//          1. GJK finds the plane of the closest points, with normal n (kernels/gjk).
//          2. Go on for as long as that plane provably parts the bodies (kernels/motion/parting_step).
//          3. If the end is reached, it is a miss. Repeat until the distance is within the tolerance
//             (kernels/motion/advancement).
// Departs: gaps are taken less a bound on all rounding, so that no contact is missed.
// Fails:   unknown / not_converged at the cap of 2,000 steps. It is slow at many turns, where the
//          bound k belongs to the whole body.
// Cost:    a GJK distance and two to four support calls a step; steps converge like Newton's, unless the
//          bodies graze. Tolerance: 1e-9 of the larger body's size.
#include <algorithm>
#include <vector>

#include "algorithms/cast.h"
#include "algorithms/kernels/motion/advancement.h"
#include "algorithms/kernels/motion/halfspace_cast.h"
#include "algorithms/kernels/motion/parting_step.h"

namespace touchstone {
namespace {

class RigidAdvancement final : public Cast {
 public:
  explicit RigidAdvancement(const CastSettings& settings)
      : goal_{settings.tolerance, std::max(1, settings.max_iterations.value_or(2000)), true} {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<double>(shapes);
    inner_radii_ = inner_radii(shapes, shapes_);
  }

  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    const BodyPairs& pairs = batch.pairs;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t a = pairs.first[i], b = pairs.second[i];
      const MovingBody body_a = moving(batch, a);
      const MovingBody body_b = moving(batch, b);
      outcomes[i] = {};
      if (batch.kind_b == ShapeKind::halfspace) {
        cast_halfspace(*body_a.shape, *body_a.pose, *body_a.motion, *body_b.shape, *body_b.pose,
                       *body_b.motion, {goal_.tolerance.value_or(0)}, outcomes[i]);
        continue;
      }
      const RelativeMotion motion(body_a, body_b);
      advance(
          motion, goal_,
          [&](SupportPair<double>& pair, const PartingPlane& plane) {
            return longest_step(motion, pair, plane);
          },
          outcomes[i]);
    }
  }

 private:
  MovingBody moving(const CastBatch& batch, std::uint32_t k) const {
    const std::uint32_t shape = batch.pairs.shape_of[k];
    return {&shapes_[shape], &batch.pairs.poses[k], &batch.motions[k], inner_radii_[shape]};
  }

  AdvancementGoal goal_;
  std::vector<SupportShape<double>> shapes_;
  std::vector<double> inner_radii_;  // metres, one for each shape
};

bool supports_rigid(ShapeKind, ShapeKind kind_b, bool turns) {
  return !turns || kind_b != ShapeKind::halfspace;
}

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
       .supports = supports_rigid,
       .make = [](const CastSettings& settings) {
         return std::make_unique<RigidAdvancement>(settings);
       }}};
}

}  // namespace touchstone::entries
