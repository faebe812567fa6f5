// Worlds, held against all pairs of boxes over random inserts, moves and removes; rays, and stale handles.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/algorithms/api/api.h"
#include "tests/algorithms/random.h"

namespace touchstone::api_test {
namespace {

using Key = std::array<std::uint32_t, 4>;

Key key(const v1::Handle& a, const v1::Handle& b) {
  return a.slot < b.slot ? Key{a.slot, a.generation, b.slot, b.generation}
                         : Key{b.slot, b.generation, a.slot, a.generation};
}

struct Placed {
  v1::Handle handle;
  v1::Box box;
};

bool overlap(const v1::Box& a, const v1::Box& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
         a.min.z <= b.max.z && b.min.z <= a.max.z;
}

// On a grid of floats, so that no rounding moves a box.
v1::Box random_box(reference::Random& random) {
  const auto at = [&] { return 0.25 * random.below(40); };
  const auto size = [&] { return 0.25 * random.below(10); };
  const v1::Vec3 min = {at(), at(), at()};
  return {min, {min.x + size(), min.y + size(), min.z + size()}};
}

void expect_all_pairs(const std::string& broad_phase, int threads, bool asks_changes) {
  SCOPED_TRACE(broad_phase);
  v1::World world({.broad_phase = broad_phase, .threads = threads});
  reference::Random random(7);
  std::vector<Placed> placed;
  std::set<Key> known;  // by the changes
  std::size_t pairs = 0, began = 0, ended = 0;
  for (int frame = 0; frame < 60; ++frame) {
    for (int k = random.below(frame == 0 ? 200 : 8); k > 0; --k) {
      const v1::Box box = random_box(random);
      placed.push_back({world.insert(box), box});
    }
    for (int k = placed.empty() ? 0 : random.below(8); k > 0; --k) {
      Placed& one = placed[static_cast<std::size_t>(random.below(static_cast<int>(placed.size())))];
      one.box = random_box(random);
      world.move(one.handle, one.box);
    }
    for (int k = random.below(8); k > 0 && !placed.empty(); --k) {
      const auto at = static_cast<std::size_t>(random.below(static_cast<int>(placed.size())));
      world.remove(placed[at].handle);
      EXPECT_FALSE(world.contains(placed[at].handle));
      EXPECT_THROW(world.remove(placed[at].handle), v1::Error);
      placed[at] = placed.back();
      placed.pop_back();
    }
    if (frame % 7 == 3) {  // came and went between two updates
      const v1::Handle gone = world.insert(random_box(random));
      world.remove(gone);
    }
    EXPECT_EQ(world.size(), placed.size());
    world.update();
    std::set<Key> expected, found;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (overlap(placed[i].box, placed[j].box))
          expected.insert(key(placed[i].handle, placed[j].handle));
      }
    }
    world.for_each_pair(
        [&](v1::Handle a, v1::Handle b) { EXPECT_TRUE(found.insert(key(a, b)).second); });
    ASSERT_EQ(found, expected) << "frame " << frame;
    pairs += found.size();
    if (!asks_changes || frame % 3 == 1) continue;  // what changed is told later
    const v1::World::Changes changes = world.changes();
    for (const v1::HandlePair& pair : changes.ended)
      EXPECT_EQ(known.erase(key(pair.a, pair.b)), 1u);
    for (const v1::HandlePair& pair : changes.began)
      EXPECT_TRUE(known.insert(key(pair.a, pair.b)).second);
    ASSERT_EQ(known, expected) << "frame " << frame;
    began += changes.began.size();
    ended += changes.ended.size();
  }
  EXPECT_GT(pairs, 1000u);
  if (asks_changes) {
    EXPECT_GT(began, 100u);
    EXPECT_GT(ended, 100u);
  }
}

TEST(World, FindsAllPairs) {
  for (const std::string& name : v1::algorithm_names("box")) {
    expect_all_pairs(name, 1, true);
    expect_all_pairs(name, 2, false);
  }
}

TEST(World, HoldsBodiesInTheirBoxes) {
  v1::World world;
  const v1::Shape ball = v1::Shape::sphere(1);
  const v1::Handle a = world.insert(ball, {}), b = world.insert(ball, v1::Pose::at({1.9, 0, 0}));
  EXPECT_EQ(world.pairs().chunks.size(), 0u);  // before the first update
  EXPECT_TRUE(world.changes().began.empty());
  world.update();
  int pairs = 0;
  world.for_each_pair([&](v1::Handle first, v1::Handle second) {
    EXPECT_TRUE((first == a && second == b) || (first == b && second == a));
    ++pairs;
  });
  EXPECT_EQ(pairs, 1);
  EXPECT_EQ(v1::distance(world.body(a), world.body(b)).answer, v1::Answer::overlapping);
  world.move(b, v1::Pose::at({2.1, 0, 0}));
  world.update();
  world.for_each_pair([&](v1::Handle, v1::Handle) { ++pairs; });
  EXPECT_EQ(pairs, 1);
}

TEST(World, RaysMeetTheFirstBody) {
  v1::World world;
  const v1::Handle ball = world.insert(v1::Shape::sphere(1), v1::Pose::at({5, 0, 0}));
  const v1::Handle box = world.insert(v1::Shape::box({1, 1, 1}), v1::Pose::at({10, 0, 0}));
  world.insert(v1::Box{{2, -1, -1}, {3, 1, 1}});  // no shape
  const v1::Ray ray = {.origin = {0, 0, 0}, .direction = {2, 0, 0}};
  v1::RayHit hit = world.ray(ray);
  EXPECT_TRUE(hit.hit);
  EXPECT_EQ(hit.body, ball);
  EXPECT_NEAR(hit.t, 2, 1e-12);
  EXPECT_NEAR(hit.normal.x, -1, 1e-12);
  world.move(ball, v1::Pose::at({5, 3, 0}));
  hit = world.ray(ray);
  EXPECT_EQ(hit.body, box);
  EXPECT_NEAR(hit.t, 4.5, 1e-12);
  world.remove(box);
  EXPECT_FALSE(world.ray(ray).hit);
  EXPECT_FALSE(world.ray({.origin = {5, 0, 0}, .direction = {0, 1, 0}, .t_max = 1}).hit);
  EXPECT_TRUE(world.ray({.origin = {5, 0, 0}, .direction = {0, 1, 0}, .t_max = 3}).hit);
}

TEST(World, RefusesWhatIsWrong) {
  v1::World world, other;
  const v1::Shape ball = v1::Shape::sphere(1);
  const v1::Handle body = world.insert(ball, {}), box = world.insert(v1::Box{{0, 0, 0}, {1, 1, 1}});
  EXPECT_THROW(world.insert(ball, v1::Pose::at({nan, 0, 0})), v1::Error);
  EXPECT_THROW(world.insert(v1::Shape::halfspace({0, 0, 1}, 0), {}), v1::Error);
  EXPECT_THROW(world.insert(v1::Box{{0, 0, 0}, {1, -1, 1}}), v1::Error);
  EXPECT_THROW(world.insert(v1::Box{{0, nan, 0}, {1, 1, 1}}), v1::Error);
  EXPECT_THROW(world.insert(v1::Box{{0, 0, 0}, {1, 1e300, 1}}), v1::Error);
  EXPECT_THROW(world.move(body, v1::Box{}), v1::Error);
  EXPECT_THROW(world.move(box, v1::Pose{}), v1::Error);
  EXPECT_THROW(world.body(box), v1::Error);
  EXPECT_THROW(other.body(body), v1::Error);
  EXPECT_THROW(world.body({}), v1::Error);
  EXPECT_THROW(world.ray({.origin = {nan, 0, 0}}), v1::Error);
  EXPECT_THROW(world.ray({.origin = {}, .direction = {0, 0, 0}}), v1::Error);
  EXPECT_THROW(v1::World({.broad_phase = "octree"}), v1::Error);
  EXPECT_THROW(v1::World({.threads = 0}), v1::Error);
  EXPECT_EQ(world.size(), 2u);
  // The slot of a removed body has another body, and another handle.
  world.update();
  world.remove(body);
  world.update();
  const v1::Handle next = world.insert(ball, {});
  EXPECT_EQ(next.slot, body.slot);
  EXPECT_FALSE(next == body);
  EXPECT_THROW(world.move(body, v1::Pose{}), v1::Error);
  v1::World moved = std::move(world);
  EXPECT_EQ(moved.size(), 2u);
  EXPECT_THROW(world.update(), v1::Error);
  EXPECT_FALSE(world.contains(next));
}

}  // namespace
}  // namespace touchstone::api_test
