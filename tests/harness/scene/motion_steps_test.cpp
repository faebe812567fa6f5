// Tests of the steps of scenes, and of the generators whose bodies move far in a step.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "harness/base/error.h"
#include "harness/base/reproducible_math.h"
#include "harness/scene/kinematics.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

scene::Scene made(const std::string& text) {
  const TemporaryFolder folder;
  return scene::load_scene(folder.write("scene.toml", text));
}

TEST(MotionSteps, GoFromFrameToFrame) {
  const scene::Scene scene = made(
      "frames = 3\ntime_step = 0.5\nmotion = \"free_fall\"\nacceleration = 8\n"
      "[[body]]\nshape = {type = \"sphere\", radius = 1}\nvelocity = [2, 0, 0]\n"
      "angular_velocity = [0, 0, 3]\n"
      "[[body]]\nshape = {type = \"sphere\", radius = 1}\nmoving = false\nvelocity = [2, 0, 0]\n");
  const auto steps = scene::motion_steps(scene, "scene.toml");
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps[0].motions[0].displacement, Vec3d(1, 0, -1));
  EXPECT_EQ(steps[1].motions[0].displacement, Vec3d(1, 0, -3));
  EXPECT_EQ(steps[1].poses[0].translation, Vec3d(1, 0, -1));
  EXPECT_EQ(steps[2].motions[0].rotation_vector, Vec3d(0, 0, 1.5));
  EXPECT_TRUE(steps[2].motions[1].displacement.isZero(0));
  EXPECT_FALSE(steps[2].motions[1].turns());
}

TEST(MotionSteps, OfScenesThatJumpAreRefused) {
  for (const char* text : {"generator = \"uniform\"\ncount = 20\nteleports = 0.2\n",
                           "generator = \"uniform\"\ncount = 20\nchurn = 0.2\n",
                           "generator = \"pairs\"\ncount = 4\n"}) {
    const scene::Scene scene = made(text);
    try {
      scene::motion_steps(scene, "mine.toml");
      FAIL() << text;
    } catch (const base::InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("mine.toml: has"));
    }
  }
}

// The hashes of these scenes, equal on every platform.
TEST(MotionGenerators, DatasetsAreWhatTheyWere) {
  const std::map<std::string, std::string> golden = {
      {"bullets", "6088727e1c72052a"},
      {"spinners", "f90ec0063aac386d"},
      {"robot", "ea1da48d12ba2e1e"},
      {"cards", "84fc2afcbf48c624"},
  };
  for (const auto& [name, hash] : golden) {
    const scene::Scene scene = scene::load_scene(
        std::filesystem::path(project_folder) / "datasets/motion" / (name + ".toml"),
        {.count = 150, .frames = 2});
    EXPECT_EQ(scene.size(), 150U) << name;
    EXPECT_EQ(scene::scene_hash(scene), hash) << name;
  }
}

TEST(MotionGenerators, BulletsFlyFarAndPlatesRest) {
  const scene::Scene scene = made("generator = \"bullets\"\ncount = 200\nframes = 1\n");
  const auto step = scene::motion_steps(scene, "").front();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double way = base::length(step.motions[i].displacement);
    EXPECT_EQ(way == 0, i < 50) << i;
    if (i < 50) continue;
    EXPECT_GT(way, 9.9);
    EXPECT_LT(way, 30.1);
    // Its axis points ahead.
    const Vec3d axis = step.poses[i].rotation.col(2);
    EXPECT_NEAR(axis.dot(step.motions[i].displacement), way, 1e-9);
  }
}

TEST(MotionGenerators, SpinnersTurnInPlace) {
  const scene::Scene scene = made("generator = \"spinners\"\ncount = 40\nframes = 1\nspin = 30\n");
  const auto step = scene::motion_steps(scene, "").front();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    EXPECT_TRUE(step.motions[i].displacement.isZero(0));
    const double angle = base::length(step.motions[i].rotation_vector);
    EXPECT_EQ(angle > 0, i % 8 == 0);
    EXPECT_LE(angle, 1 + 1e-9);
  }
}

// Links meet at their joints in both configurations: the end of each is the begin of the next.
TEST(MotionGenerators, ARobotKeepsItsJointsAtBothEnds) {
  const scene::Scene scene = made("generator = \"robot\"\ncount = 64\nframes = 1\nsize = 0.5\n");
  const auto step = scene::motion_steps(scene, "").front();
  double turned = 0;
  for (const double time : {0.0, 1.0}) {
    const auto end = [&](std::size_t i, double sign) {
      const Motion& motion = step.motions[i];
      const Mat3d rotation =
          base::product(base::rotation_over(motion.rotation_vector, time), step.poses[i].rotation);
      return Vec3d(step.poses[i].translation + time * motion.displacement +
                   sign * 0.25 * rotation.col(2));
    };
    for (std::size_t i = 0; i + 1 < 6; ++i) {
      EXPECT_NEAR((end(i, 1) - end(i + 1, -1)).norm(), 0, 1e-12) << i;
      turned += base::length(step.motions[i].rotation_vector);
    }
  }
  EXPECT_GT(turned, 0.5);
  for (std::size_t i = 6; i < 64; ++i) EXPECT_FALSE(scene.bodies[i].moving);
}

TEST(MotionGenerators, CardsLieApartAndAreDealtToEveryHand) {
  const scene::Scene scene =
      made("generator = \"cards\"\ncount = 104\nframes = 1\nplayers = 4\ngap = 0.001\n");
  const auto step = scene::motion_steps(scene, "").front();
  std::set<std::pair<long, long>> hands;
  for (std::size_t i = 0; i < 52; ++i) {
    const Vec3d place = step.poses[i].translation + step.motions[i].displacement;
    hands.insert({std::lround(1e6 * place.x()), std::lround(1e6 * place.y())});
    if (i > 0) {
      EXPECT_NEAR(step.poses[i].translation.z() - step.poses[i - 1].translation.z(), 0.0013, 1e-12);
    }
  }
  EXPECT_EQ(hands.size(), 4U);
}

}  // namespace
}  // namespace touchstone
