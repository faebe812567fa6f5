#include "harness/scene/player.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "algorithms/core/bounds.h"
#include "harness/base/random.h"
#include "harness/scene/scene.h"
#include "tests/harness/scene/scene_text.h"

namespace touchstone {
namespace {

using Vec3l = Vec3<long double>;

Shape sphere(double radius) {
  Shape shape;
  shape.radius = radius;
  return shape;
}

Shape halfspace(const Vec3d& normal, double offset) {
  Shape shape;
  shape.kind = ShapeKind::halfspace;
  shape.normal = normal;
  shape.offset = offset;
  return shape;
}

scene::Scene scene_of(const Shape& shape, const scene::Body& body, int frames) {
  scene::Scene scene;
  scene.shapes = {shape};
  scene.bodies = {body};
  scene.frames = frames;
  return scene;
}

// A point of the shape's boundary, or near it.
Vec3l boundary_point(const Shape& shape, base::Random& random) {
  const Vec3l direction = random.on_sphere().cast<long double>();
  const long double sign = random.below(2) == 0 ? 1 : -1;
  const auto rim = [&]() -> Vec3l {
    const long double angle = 2 * std::numbers::pi_v<long double> * random.unit();
    return {shape.radius * std::cos(angle), shape.radius * std::sin(angle), 0};
  };
  const Vec3l along(0, 0, shape.half_length);
  switch (shape.kind) {
    case ShapeKind::sphere: return shape.radius * direction;
    case ShapeKind::capsule: return sign * along + shape.radius * direction;
    case ShapeKind::box: {
      Vec3l corner;
      for (int i = 0; i < 3; ++i) {
        corner[i] = (random.below(2) == 0 ? 1 : -1) * shape.half_extents[i];
      }
      return corner;
    }
    case ShapeKind::cylinder: return sign * along + rim();
    case ShapeKind::cone: return random.below(4) == 0 ? along : Vec3l(rim() - along);
    case ShapeKind::ellipsoid: return shape.radii.cast<long double>().cwiseProduct(direction);
    case ShapeKind::hull: {
      const auto& vertices = shape.hull->vertices;
      return vertices[random.below(vertices.size())].cast<long double>();
    }
    case ShapeKind::halfspace: break;
  }
  return Vec3l::Zero();
}

std::string every_kind(const std::string& motion) {
  return "generator = \"uniform\"\ncount = 140\nframes = 12\noverlaps = 3\nspeed = 3\nspin = 20\n"
         "shapes = [\"sphere\", \"capsule\", \"box\", \"cylinder\", \"cone\", \"ellipsoid\", "
         "\"hull\"]\nmotion = \"" +
         motion + "\"\n";
}

TEST(Player, BoxesHoldAllPointsInAllFrames) {
  for (const std::string motion : {"inertial", "brownian", "free_fall", "rotating_gravity"}) {
    const scene::Scene scene = load_text(every_kind(motion));
    base::Random random(7);
    for (const scene::BoxKind kind : {scene::BoxKind::tight, scene::BoxKind::loose}) {
      scene::ScenePlayer player(scene, kind);
      do {
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
          const Shape& shape = scene.shapes[scene.bodies[i].shape];
          const Pose& pose = player.poses()[i];
          const Aabb& box = player.boxes()[i];
          Vec3l low = Vec3l::Constant(1e9), high = -low;
          for (int k = 0; k < 40; ++k) {
            const Vec3l x = pose.rotation.cast<long double>() * boundary_point(shape, random) +
                            pose.translation.cast<long double>();
            low = low.cwiseMin(x);
            high = high.cwiseMax(x);
          }
          for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            // The sampled points of curved shapes are not exact extremes in long double either.
            EXPECT_LE(box.min[a], low[axis] + 1e-15L * std::abs(low[axis]));
            EXPECT_GE(box.max[a], high[axis] - 1e-15L * std::abs(high[axis]));
            if (kind == scene::BoxKind::tight && shape.kind == ShapeKind::hull) {
              EXPECT_NEAR(static_cast<double>(box.max[a] - box.min[a]),
                          static_cast<double>(high[axis] - low[axis]), 1.0);
            }
          }
        }
      } while (player.next());
      EXPECT_EQ(player.frame(), 11);
    }
  }
}

TEST(Player, LooseBoxesHoldTightOnesAndKeepTheirSize) {
  const scene::Scene scene = load_text(every_kind("inertial"));
  scene::ScenePlayer tight(scene, scene::BoxKind::tight), loose(scene, scene::BoxKind::loose);
  const std::vector<Aabb> first(loose.boxes().begin(), loose.boxes().end());
  do {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_LE(loose.boxes()[i].min[axis], tight.boxes()[i].min[axis]);
        EXPECT_GE(loose.boxes()[i].max[axis], tight.boxes()[i].max[axis]);
        EXPECT_NEAR(loose.boxes()[i].max[axis] - loose.boxes()[i].min[axis],
                    first[i].max[axis] - first[i].min[axis], 1e-4);
      }
    }
  } while (tight.next() && loose.next());
}

TEST(Player, MovedListsExactlyWhatChanged) {
  const scene::Scene scene =
      load_text("generator = \"uniform\"\ncount = 200\nmoving = 0.3\nframes = 8\n");
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  EXPECT_TRUE(player.change().moved.empty());
  std::vector<Aabb> before(player.boxes().begin(), player.boxes().end());
  while (player.next()) {
    std::vector<std::uint32_t> changed;
    for (std::uint32_t i = 0; i < before.size(); ++i) {
      if (std::memcmp(&before[i], &player.boxes()[i], sizeof(Aabb)) != 0) changed.push_back(i);
    }
    EXPECT_EQ(changed.size(), 60u);
    const auto moved = player.change().moved;
    EXPECT_EQ(std::vector<std::uint32_t>(moved.begin(), moved.end()), changed);
    EXPECT_EQ(player.change().boxes.data(), player.boxes().data());
    EXPECT_TRUE(player.change().inserted.empty());
    EXPECT_TRUE(player.change().removed.empty());
    before.assign(player.boxes().begin(), player.boxes().end());
  }
}

TEST(Player, TheFrameBeforeStaysAlive) {
  const scene::Scene scene = load_text("generator = \"uniform\"\ncount = 20\nframes = 3\n");
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  const std::span<const Aabb> before = player.boxes();
  const std::vector<Aabb> copy(before.begin(), before.end());
  ASSERT_TRUE(player.next());
  EXPECT_EQ(std::vector<Aabb>(before.begin(), before.end()), copy);
}

TEST(Player, PlaysTheSameBitsEachTime) {
  const scene::Scene scene = load_text(every_kind("brownian"));
  scene::ScenePlayer a(scene, scene::BoxKind::tight), b(scene, scene::BoxKind::tight);
  do {
    EXPECT_EQ(std::memcmp(a.boxes().data(), b.boxes().data(), a.boxes().size_bytes()), 0);
    EXPECT_EQ(std::memcmp(a.poses().data(), b.poses().data(), a.poses().size_bytes()), 0);
  } while (a.next() && b.next());
}

TEST(Player, InertialBodiesFlyStraightAndTurnEvenly) {
  scene::Body body;
  body.velocity = {3, -1, 0.5};
  body.angular_velocity = {0, 0, std::numbers::pi};  // half a turn a second
  scene::Scene scene = scene_of(sphere(1), body, 61);
  scene.motion.time_step = 0.25;
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  while (player.next()) {
    const double time = 0.25 * player.frame();
    EXPECT_LT((player.poses()[0].translation - time * body.velocity).norm(), 1e-12);
    const double angle = std::numbers::pi * time;
    const Vec3d x = player.poses()[0].rotation * Vec3d::UnitX();
    EXPECT_LT((x - Vec3d(std::cos(angle), std::sin(angle), 0)).norm(), 1e-13);
  }
  EXPECT_EQ(player.frame(), 60);
}

TEST(Player, RotationsStayOrthonormal) {
  scene::Body body;
  body.angular_velocity = {70, -31, 12};
  const scene::Scene scene = scene_of(sphere(1), body, 5000);
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  while (player.next()) {
    const Mat3d& r = player.poses()[0].rotation;
    ASSERT_LT((r.transpose() * r - Mat3d::Identity()).norm(), 4e-15);
    ASSERT_GT(r.determinant(), 0);
  }
}

TEST(Player, FreeFallIsAParabola) {
  scene::Body body;
  body.velocity = {1, 0, 10};
  scene::Scene scene = scene_of(sphere(1), body, 100);
  scene.motion.kind = scene::MotionKind::free_fall;
  scene.motion.acceleration = 9.81;
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  while (player.next()) {
    const double t = player.frame() / 30.0;
    const Vec3d expected(t, 0, 10 * t - 9.81 * t * t / 2);
    EXPECT_LT((player.poses()[0].translation - expected).norm(), 1e-11);
  }
}

TEST(Player, GravityTurnsOnceAPeriod) {
  scene::Scene scene = scene_of(sphere(1), scene::Body{}, 241);
  scene.motion.kind = scene::MotionKind::rotating_gravity;
  scene.motion.acceleration = 3;
  scene.motion.period = 8;  // 240 frames
  scene::Kinematics kinematics(scene);
  kinematics.next();
  EXPECT_NEAR(kinematics.velocities()[0].z(), -0.1, 1e-15);
  EXPECT_EQ(kinematics.velocities()[0].x(), 0);
  while (kinematics.frame() < 240) kinematics.next();
  EXPECT_LT(kinematics.velocities()[0].norm(), 1e-13) << "a full turn gives as much as it takes";
}

// Walls keep origins between them and preserve the energy, however fast the bodies are.
TEST(Player, WallsAreElastic) {
  for (const double speed : {0.1, 5.0, 400.0, 1e6}) {
    for (const scene::MotionKind kind :
         {scene::MotionKind::inertial, scene::MotionKind::free_fall}) {
      scene::Scene scene;
      scene.shapes = {sphere(0.1)};
      scene.frames = 400;
      scene.motion.kind = kind;
      scene.motion.acceleration = kind == scene::MotionKind::free_fall ? 4 : 0;
      scene.motion.wall_min = {-1, -2, -3};
      scene.motion.wall_max = {1, 2, 3};
      base::Random random(3);
      for (int i = 0; i < 20; ++i) {
        scene::Body body;
        body.pose.translation = random.in_ball();
        body.velocity = speed * random.in_ball();
        scene.bodies.push_back(body);
      }
      const auto energy = [&](const scene::Kinematics& k, std::size_t i) {
        return k.velocities()[i].squaredNorm() / 2 +
               scene.motion.acceleration * (k.poses()[i].translation.z() + 3);
      };
      scene::Kinematics kinematics(scene);
      std::vector<double> start;
      for (std::size_t i = 0; i < 20; ++i) start.push_back(energy(kinematics, i));
      while (kinematics.frame() < 399) {
        kinematics.next();
        for (std::size_t i = 0; i < 20; ++i) {
          const Vec3d& x = kinematics.poses()[i].translation;
          for (int axis = 0; axis < 3; ++axis) {
            ASSERT_GE(x[axis], scene.motion.wall_min[axis]);
            ASSERT_LE(x[axis], scene.motion.wall_max[axis]);
          }
          ASSERT_NEAR(energy(kinematics, i) / start[i], 1, 1e-9) << speed;
        }
      }
    }
  }
}

TEST(Player, BrownianKicksOneInAHundredInTurn) {
  const scene::Scene scene =
      load_text("generator = \"brownian\"\ncount = 250\nwalls = false\nframes = 200\n");
  scene::Kinematics kinematics(scene);
  std::vector<int> kicks(250);
  for (int frame = 0; frame < 84; ++frame) {  // 250 / 3, rounded up
    const std::vector<Vec3d> before(kinematics.velocities().begin(), kinematics.velocities().end());
    kinematics.next();
    int changed = 0;
    for (std::size_t i = 0; i < 250; ++i) {
      if (kinematics.velocities()[i] == before[i]) continue;
      ++changed;
      ++kicks[i];
      EXPECT_LE(kinematics.velocities()[i].norm(), scene.motion.speed);
    }
    EXPECT_EQ(changed, 3);
  }
  for (const int count : kicks) EXPECT_GE(count, 1);
}

TEST(Player, StillBodiesStayWhateverTheirVelocity) {
  scene::Body body;
  body.velocity = {1, 2, 3};
  body.angular_velocity = {1, 2, 3};
  body.moving = false;
  scene::Scene scene = scene_of(sphere(1), body, 5);
  scene.motion.kind = scene::MotionKind::free_fall;
  scene.motion.acceleration = 9.81;
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  while (player.next()) {
    EXPECT_TRUE(player.change().moved.empty());
    EXPECT_EQ(player.poses()[0].translation, Vec3d::Zero());
  }
}

// Every pair that overlaps with infinite boxes overlaps with the cut ones, in every frame.
TEST(Player, HalfspacesAreCutWithoutLosingAPair) {
  scene::Scene scene;
  scene.shapes = {sphere(0.5), halfspace({0, 0, 1}, -5), halfspace({-1, 0, 0}, -5),
                  halfspace({1, 1, 0}, 0), halfspace({0, 1, 0}, 40)};
  scene.frames = 30;
  for (std::uint32_t shape = 1; shape < scene.shapes.size(); ++shape) {
    scene::Body body;
    body.shape = shape;
    body.moving = false;
    scene.bodies.push_back(body);
  }
  base::Random random(5);
  for (int i = 0; i < 40; ++i) {
    scene::Body body;
    body.pose.translation = 4 * random.in_ball();
    body.velocity = 10 * random.in_ball();
    scene.bodies.push_back(body);
  }
  for (const scene::BoxKind kind : {scene::BoxKind::tight, scene::BoxKind::loose}) {
    scene::ScenePlayer player(scene, kind);
    int hits = 0, misses = 0;
    do {
      const auto boxes = player.boxes();
      std::vector<Aabb> uncut(boxes.begin(), boxes.end());
      for (std::size_t i = 0; i < 4; ++i) {
        uncut[i] = tight_box(scene.shapes[scene.bodies[i].shape], player.poses()[i]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_TRUE(std::isfinite(boxes[i].min[axis]) && std::isfinite(boxes[i].max[axis]));
          EXPECT_LE(boxes[i].min[axis], boxes[i].max[axis]);
        }
      }
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t j = i + 1; j < boxes.size(); ++j) {
          ASSERT_EQ(overlap(boxes[i], boxes[j]), overlap(uncut[i], uncut[j])) << i << ' ' << j;
          if (i < 4) ++(overlap(boxes[i], boxes[j]) ? hits : misses);
        }
      }
    } while (player.next());
    EXPECT_GT(hits, 300);
    EXPECT_GT(misses, 300);
  }
}

TEST(Player, HalfspacesAloneHaveFiniteBoxes) {
  scene::Body body;
  body.moving = false;
  scene::Scene scene = scene_of(halfspace({1, 2, 3}, 1), body, 2);
  scene.bodies.push_back(body);
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  EXPECT_TRUE(overlap(player.boxes()[0], player.boxes()[1]));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(std::isfinite(player.boxes()[0].min[axis]));
  }
  EXPECT_TRUE(player.next());
}

TEST(Player, PlaysRecordings) {
  scene::Scene scene;
  for (float f = 0; f < 4; ++f) {
    scene.recording.push_back({{{f, 0, 0}, {f + 1, 1, 1}}, {{0.0f, 5, 5}, {6, 6, 6}}});
  }
  scene.recording[2][1].min[0] = -0.0f;  // equal as a number, other bits
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  EXPECT_TRUE(player.poses().empty());
  for (std::size_t frame = 0; frame < 4; ++frame) {
    EXPECT_EQ(std::vector<Aabb>(player.boxes().begin(), player.boxes().end()),
              scene.recording[frame]);
    const std::size_t moved[] = {0, 1, 2, 2};
    EXPECT_EQ(player.change().moved.size(), moved[frame]);
    EXPECT_EQ(player.next(), frame < 3);
  }
  EXPECT_EQ(player.frame(), 3);
}

}  // namespace
}  // namespace touchstone
