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
  const auto exact = registry::find<SceneRayCastEntry>("exact")->make();
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

// Bodies beyond floats, and directions near the least and the greatest doubles: the answer is that at about 1, or none.
TEST(SceneRayOracle, MissesNothingAtAnyScale) {
  const auto exact = registry::find<SceneRayCastEntry>("exact")->make();
  int hits = 0, open = 0;
  for (const int power : {-900, -300, 0, 125, 130, 300, 900, 1015}) {
    const double size = std::ldexp(1.0, power);
    const std::vector<SceneBody> bodies = {
        resting(reference::make_box(1, 1, 1)), resting(reference::make_sphere(size)),
        resting(reference::make_capsule(size, size)),
        resting(hull_of({{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}))};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      std::vector<SceneBody> one = {bodies[i]};
      if (i == 0) one[0].pose.rotation *= size;
      exact->bind(one);
      for (const int speed : {-1060, -900, -300, 0, 300, 900}) {
        const double step = std::ldexp(1.0, speed);
        const Ray ray{.origin = {size / 8, size / 4, 5 * size}, .direction = {0, 0, -step}};
        SceneRayHit hit;
        exact->cast(RayTask::closest, {&ray, 1}, {&hit, 1});
        if (hit.status != Status::ok) {
          ++open;
          EXPECT_FALSE(hit.hit);
          continue;
        }
        ++hits;
        EXPECT_TRUE(hit.hit) << i << ' ' << power << ' ' << speed;
      }
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(open, 10);
}

}  // namespace
}  // namespace touchstone
