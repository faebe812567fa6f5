// A pair of turning bodies as the steps of an advancement take it. For tests.
#pragma once

#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/kernels/motion/moving_scene.h"
#include "tests/algorithms/cast/moving_bodies.h"

namespace touchstone::reference {

inline GjkDistanceResult<double> nearest(SupportPair<double> pair) {
  return gjk_distance(pair, {.task = Task::distance, .tolerance = 1e-12, .most_iterations = 256});
}

// A moving pair as the step takes it.
struct Turning {
  explicit Turning(const MovingPairCase& c)
      : poses{c.pose_a, c.pose_b}, motions{c.motion_a, c.motion_b} {
    const std::array<Shape, 2> shapes = {c.a, c.b};
    scene.bind(shapes);
  }
  RelativeMotion motion() const {
    static constexpr std::array<std::uint32_t, 2> bodies = {0, 1};
    const std::span<const std::uint32_t> both(bodies);
    const CastBatch batch{.kind_a = ShapeKind::box,
                          .kind_b = ShapeKind::box,
                          .pairs = {both.subspan(0, 1), both.subspan(1, 1), bodies, poses},
                          .motions = motions};
    return RelativeMotion(MotionBounds(scene.body(batch, 0), scene.body(batch, 1)));
  }
  MovingScene scene;
  std::array<Pose, 2> poses;
  std::array<Motion, 2> motions;
};

}  // namespace touchstone::reference
