// A cast that asks `advance` for each pair, whatever the step. Used by conservative-advancement,
// rigid-advancement and bilateral-advancement.
#pragma once

#include <algorithm>

#include "algorithms/cast.h"
#include "algorithms/kernels/motion/advancement/advancement.h"
#include "algorithms/kernels/motion/advancement/halfspace_advancement.h"
#include "algorithms/kernels/motion/halfspace_cast.h"
#include "algorithms/kernels/motion/moving_scene.h"

namespace touchstone {

// `Step` has the function FreeUntil step(const RelativeMotion& motion, SupportPair<double>& pair, const
// PartingPlane& plane), where the pair is at the plane's time, `balls_first`: whether to begin where balls about
// the bodies' origins meet, and `lasting_planes`: whether planes are those that last and turn.
template <class Step>
class AdvancingCast final : public Cast {
 public:
  explicit AdvancingCast(const CastSettings& settings)
      : goal_{settings.tolerance, std::max(1, settings.max_iterations.value_or(2000)),
              Step::lasting_planes} {}

  void bind(std::span<const Shape> shapes) override { scene_.bind(shapes); }

  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    const BodyPairs& pairs = batch.pairs;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const MovingBody a = scene_.body(batch, pairs.first[i]),
                       b = scene_.body(batch, pairs.second[i]);
      outcomes[i] = {};
      const bool turns = a.motion->turns() || b.motion->turns();
      if (batch.kind_b == ShapeKind::halfspace && turns) {
        advance_onto_halfspace(a, b, goal_, outcomes[i]);
        continue;
      }
      if (batch.kind_b == ShapeKind::halfspace) {
        cast_halfspace(*a.shape, *a.pose, *a.motion, *b.shape, *b.pose, *b.motion,
                       {goal_.tolerance, StartContact::counts}, outcomes[i]);
        continue;
      }
      const MotionBounds bounds(a, b);
      FreeUntil free{0, false};
      if constexpr (Step::balls_first) free = apart_by_balls(bounds);
      if (free.to_the_end) {
        outcomes[i] = {.answer = CastAnswer::miss, .status = Status::ok, .iterations = 0};
        continue;
      }
      const RelativeMotion motion(bounds);
      advance(
          motion, goal_, free.time,
          [&](SupportPair<double>& pair, const PartingPlane& plane) {
            return Step::step(motion, pair, plane);
          },
          outcomes[i]);
    }
  }

 private:
  AdvancementGoal goal_;
  MovingScene scene_;
};

// Half-spaces may not turn: two that do are refused here, and a body with one that does by its status.
inline bool advancing_cast_supports(ShapeKind kind_a, ShapeKind, bool turns) {
  return !turns || kind_a != ShapeKind::halfspace;
}

}  // namespace touchstone
