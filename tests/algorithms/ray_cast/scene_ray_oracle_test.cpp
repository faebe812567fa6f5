// What the oracle of rays at scenes says where bodies are close to each other along the ray.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "algorithms/registry.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

SceneBody resting(const Shape& shape) {
  SceneBody body;
  body.body.parts.push_back({.shape = shape, .pose = {}});
  return body;
}

// A curved body's time is an enclosure: where another body's is within it, nobody says which one is first.
TEST(SceneRayOracle, DoesNotGuessWhichBodyIsFirst) {
  const auto exact = find_scene_ray_cast("exact")->make();
  const std::vector<Ray> down = {{.origin = {0, 0, 10}, .direction = {0, 0, -1}}};
  int known = 0, open = 0;
  for (const double higher : {1e-13, 1e-11, 1e-3, 0.0, -1e-3}) {
    const std::vector<SceneBody> bodies = {resting(reference::make_box(1, 1, 1 + higher)),
                                           resting(reference::make_cylinder(1, 1)),
                                           resting(reference::make_halfspace(Vec3d::UnitZ(), -50))};
    exact->bind(bodies);
    SceneRayHit hit;
    exact->cast(RayTask::closest, down, {&hit, 1});
    ++(hit.status == Status::ok ? known : open);
    if (hit.status != Status::ok) continue;
    EXPECT_TRUE(hit.hit);
    EXPECT_EQ(hit.body, higher >= 0 ? 0u : 1u) << higher;
  }
  EXPECT_GE(known, 2);
  EXPECT_GE(open, 1);
}

}  // namespace
}  // namespace touchstone
