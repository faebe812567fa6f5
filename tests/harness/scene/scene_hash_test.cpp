#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "algorithms/hull/convex_hull.h"
#include "harness/scene/scene.h"

namespace touchstone {
namespace {

scene::Scene hashed_example() {
  scene::Scene scene;
  scene.frames = 5;
  for (const ShapeKind kind : all_shape_kinds) {
    Shape shape;
    shape.kind = kind;
    shape.radius = 1;
    shape.half_length = 2;
    shape.half_extents = {1, 2, 3};
    shape.radii = {1, 2, 3};
    shape.normal = {0, 0, 1};
    shape.offset = 1;
    if (kind == ShapeKind::hull) {
      shape.hull = make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    }
    scene.shapes.push_back(shape);
    scene::Body body;
    body.shape = static_cast<std::uint32_t>(kind);
    body.velocity = {1, 0, 0};
    body.angular_velocity = {0, 1, 0};
    scene.bodies.push_back(body);
  }
  return scene;
}

void nudge(double& x) { x = std::nextafter(x, 10); }

TEST(SceneHash, IsSixteenDigitsAndTheSameForTheSame) {
  EXPECT_EQ(scene::scene_hash(hashed_example()).size(), 16u);
  EXPECT_EQ(scene::scene_hash(hashed_example()).find_first_not_of("0123456789abcdef"),
            std::string::npos);
  EXPECT_EQ(scene::scene_hash(hashed_example()), scene::scene_hash(hashed_example()));
  scene::Scene renamed = hashed_example();
  renamed.name = "other";
  EXPECT_EQ(scene::scene_hash(renamed), scene::scene_hash(hashed_example()))
      << "a name decides nothing";
}

TEST(SceneHash, AnyParameterChangesIt) {
  const auto at = [](ShapeKind kind) { return static_cast<std::size_t>(kind); };
  const std::vector<std::function<void(scene::Scene&)>> changes = {
      [&](scene::Scene& s) { nudge(s.shapes[at(ShapeKind::sphere)].radius); },
      [&](scene::Scene& s) { nudge(s.shapes[at(ShapeKind::capsule)].radius); },
      [&](scene::Scene& s) { nudge(s.shapes[at(ShapeKind::capsule)].half_length); },
      [&](scene::Scene& s) { nudge(s.shapes[at(ShapeKind::cylinder)].half_length); },
      [&](scene::Scene& s) { nudge(s.shapes[at(ShapeKind::cone)].radius); },
      [&](scene::Scene& s) { nudge(s.shapes[at(ShapeKind::box)].half_extents.y()); },
      [&](scene::Scene& s) { nudge(s.shapes[at(ShapeKind::ellipsoid)].radii.z()); },
      [&](scene::Scene& s) { nudge(s.shapes[at(ShapeKind::halfspace)].normal.x()); },
      [&](scene::Scene& s) { nudge(s.shapes[at(ShapeKind::halfspace)].offset); },
      [&](scene::Scene& s) {
        s.shapes[at(ShapeKind::hull)].hull =
            make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nextafter(1, 2)}});
      },
      [&](scene::Scene& s) { s.shapes.push_back(s.shapes[0]); },
      [](scene::Scene& s) { s.bodies.pop_back(); },
      [](scene::Scene& s) { std::swap(s.bodies[0], s.bodies[1]); },
      [](scene::Scene& s) { s.bodies[0].shape = 2; },
      [](scene::Scene& s) { nudge(s.bodies[3].pose.translation.x()); },
      [](scene::Scene& s) { nudge(s.bodies[3].pose.rotation(2, 1)); },
      [](scene::Scene& s) { nudge(s.bodies[3].velocity.z()); },
      [](scene::Scene& s) { nudge(s.bodies[3].angular_velocity.x()); },
      [](scene::Scene& s) { s.bodies[3].moving = false; },
      [](scene::Scene& s) { s.frames = 6; },
      [](scene::Scene& s) { s.motion.kind = scene::MotionKind::brownian; },
      [](scene::Scene& s) { nudge(s.motion.time_step); },
      [](scene::Scene& s) { nudge(s.motion.acceleration); },
      [](scene::Scene& s) { nudge(s.motion.period); },
      [](scene::Scene& s) { nudge(s.motion.speed); },
      [](scene::Scene& s) { s.motion.seed = 1; },
      [](scene::Scene& s) { nudge(s.motion.wall_min.x()); },
      [](scene::Scene& s) { nudge(s.motion.wall_max.z()); },
  };
  std::set<std::string> hashes = {scene::scene_hash(hashed_example())};
  for (const auto& change : changes) {
    scene::Scene scene = hashed_example();
    change(scene);
    hashes.insert(scene::scene_hash(scene));
  }
  EXPECT_EQ(hashes.size(), changes.size() + 1);
}

TEST(SceneHash, TakesInRecordings) {
  scene::Scene scene;
  scene.recording = {{{{0, 0, 0}, {1, 1, 1}}, {{2, 2, 2}, {3, 3, 3}}}};
  std::set<std::string> hashes = {scene::scene_hash(scene)};
  scene::Scene other = scene;
  other.recording[0][1].max[2] = std::nextafter(3.0f, 4.0f);
  hashes.insert(scene::scene_hash(other));
  other = scene;
  std::swap(other.recording[0][0], other.recording[0][1]);
  hashes.insert(scene::scene_hash(other));
  other = scene;
  other.recording.push_back(other.recording[0]);
  hashes.insert(scene::scene_hash(other));
  other.recording = {{scene.recording[0][0]}, {scene.recording[0][1]}};
  hashes.insert(scene::scene_hash(other));
  EXPECT_EQ(hashes.size(), 5u);
}

}  // namespace
}  // namespace touchstone
