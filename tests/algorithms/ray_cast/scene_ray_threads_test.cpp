// Rays at scenes by two threads.
#include <gtest/gtest.h>

#include <bit>
#include <span>
#include <thread>
#include <vector>

#include "algorithms/registry.h"
#include "harness/families/ray_scenes.h"

namespace touchstone {
namespace {

void cast_at(RayTask task, std::span<const SceneBody> bodies, std::span<const Ray> rays,
             std::span<SceneRayHit> hits) {
  const auto cast = registry::find<SceneRayCastEntry>("wide-bvh")->make();
  cast->bind(bodies);
  cast->cast(task, rays, hits);
}

// Two threads, each with an instance of its own, give what one gives, to the last bit.
TEST(SceneRayThreads, AnswerAsOneDoes) {
  families::RandomDraws draws(13);
  const auto bodies = families::bodies_of(families::RayScene::mixed, draws);
  std::vector<Ray> rays;
  for (int i = 0; i < 200; ++i) {
    const auto scene = families::all_ray_scenes[static_cast<std::size_t>(i) % 5];
    rays.push_back(families::ray_at(scene, bodies, draws));
  }
  int found = 0, missed = 0;
  for (const RayTask task : {RayTask::closest, RayTask::any}) {
    std::vector<SceneRayHit> one(rays.size()), two(rays.size());
    cast_at(task, bodies, rays, one);
    const auto half = [&](std::size_t first) {
      cast_at(task, bodies, std::span(rays).subspan(first, 100),
              std::span(two).subspan(first, 100));
    };
    std::thread other(half, 100);
    half(0);
    other.join();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(two[i].hit, one[i].hit);
      EXPECT_EQ(two[i].body, one[i].body);
      EXPECT_EQ(two[i].part, one[i].part);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(two[i].t), std::bit_cast<std::uint64_t>(one[i].t));
      ++(one[i].hit ? found : missed);
    }
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(missed, 20);
}

}  // namespace
}  // namespace touchstone
