// Tests of bodies that fall and collide.
#include "harness/simulate/simulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "harness/scene/kinematics.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

const std::string ground =
    "[[body]]\nshape = {type = \"halfspace\", normal = [0, 0, 2], offset = 0}\n";

class Dynamics : public testing::Test {
 protected:
  void SetUp() override {
    if (!simulate::lacking().empty()) GTEST_SKIP() << simulate::lacking();
  }
  std::filesystem::path write(const std::string& text) { return folder_.write("scene.toml", text); }
  // Writes the log of a scene, and reads it as one.
  scene::Scene play(const std::string& text, const simulate::Settings& settings,
                    simulate::Simulated* done = nullptr) {
    const auto file = write(text);
    scene::PoseLogWriter log(folder_.path() / "log.csv");
    const simulate::Simulated made =
        simulate::simulate(scene::load_scene(file), file, settings,
                           [&](int frame, auto moved) { log.add(frame, moved); });
    log.close();
    if (done != nullptr) *done = made;
    return scene::load_scene(
        folder_.write("log.toml", "import = \"scene.toml\"\nposes = \"log.csv\"\n"));
  }
  std::string fault(const std::string& text) {
    return folder_.without_path(input_fault([&] { play(text, {.seconds = 0.1}); }));
  }
  static Pose last(const scene::Scene& scene, std::size_t body) {
    scene::Kinematics kinematics(scene);
    while (kinematics.frame() + 1 < scene.frames) kinematics.next();
    return kinematics.poses()[body];
  }

  TemporaryFolder folder_;
};

TEST_F(Dynamics, BodiesOfAllKindsComeToRestOnTheGround) {
  std::string text = ground;
  const std::vector<std::string> shapes = {
      "{type = \"box\", half_extents = [0.2, 0.3, 0.1]}",
      "{type = \"cylinder\", radius = 0.3, half_length = 0.1}",
      "{type = \"cone\", radius = 0.3, half_length = 0.2}",
      "{type = \"hull\", vertices = [[5, 0, 0], [6, 0, 0], [5, 1, 0], [5, 0, 1]]}",
      "{type = \"ellipsoid\", radii = [0.3, 0.3, 0.1]}",
      "{type = \"gear\", teeth = 6, root_radius = 0.8, hole_radius = 0.3, thickness = 0.4}",
      "{type = \"compound\", parts = [{shape = {type = \"box\", half_extents = [0.5, 0.1, 0.1]}}, "
      "{shape = {type = \"box\", half_extents = [0.1, 0.5, 0.1]}, translation = [3, 0, 0]}]}"};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    text += "[[body]]\nshape = " + shapes[i] + "\ntranslation = [" + std::to_string(10 * i) +
            ", 0, 1.5]\n";
  }
  simulate::Simulated done;
  const scene::Scene scene = play(text, {.seconds = 6}, &done);
  EXPECT_EQ(done.free, shapes.size());
  EXPECT_EQ(done.resting, shapes.size());
  EXPECT_EQ(scene.frames, 361);
  const double heights[] = {0.1, 0.1, 0.2, 0, 0.1, 0.2, 0.1};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    EXPECT_NEAR(last(scene, i + 1).translation.z(), heights[i], 0.02) << shapes[i];
  }
}

TEST_F(Dynamics, APileComesToRestAndEveryPoseIsARotation) {
  simulate::Simulated done;
  const std::string text =
      "generator = \"uniform\"\ncount = 60\nshapes = [{type = \"hull\", points = 12}]\nsize = "
      "[0.3, 0.6]\ndensity = 0.15\nwalls = false\n[[body]]\nshape = {type = \"halfspace\", normal "
      "= [0, 0, 1], offset = -3}\n";
  const scene::Scene scene = play(text, {.seconds = 8, .from = 1}, &done);
  EXPECT_EQ(done.frames, 421);
  EXPECT_EQ(scene.frames, 421);
  EXPECT_EQ(done.free, 60u);
  EXPECT_EQ(done.resting, 60u);
  ASSERT_EQ(scene.tracks.bodies.size(), 60u);
  for (const Pose& pose : scene.tracks.poses) {
    EXPECT_LT((pose.rotation.transpose() * pose.rotation - Mat3d::Identity()).norm(), 1e-14);
    EXPECT_GT(pose.translation.z(), -3.1);
  }
  // The same bits again, of the log too when it is read and written.
  const std::string log = folder_.read("log.csv");
  play(text, {.seconds = 8, .from = 1});
  EXPECT_EQ(folder_.read("log.csv"), log);
  scene::write_pose_log(scene, folder_.path() / "whole.csv");
  const scene::Scene again = scene::load_scene(
      folder_.write("again.toml", "import = \"scene.toml\"\nposes = \"whole.csv\"\n"));
  EXPECT_EQ(scene::scene_hash(again), scene::scene_hash(scene));
}

// A body turns about its centre of mass, wherever its origin is.
TEST_F(Dynamics, VelocitiesAndGravityAreThoseOfTheScene) {
  const std::string spun =
      "[[body]]\nshape = {type = \"hull\", vertices = [[4, -1, -1], [6, -1, -1], [4, 1, -1], [6, "
      "1, -1], [4, -1, 1], [6, -1, 1], [4, 1, 1], [6, 1, 1]]}\nvelocity = [0, -5, "
      "0]\nangular_velocity = [0, 0, 1]\n";
  const scene::Scene free = play(spun, {.seconds = 1, .gravity = 0});
  const Pose pose = last(free, 0);
  EXPECT_LT((pose(Vec3d(5, 0, 0)) - Vec3d(5, 0, 0)).norm(), 1e-3)
      << "the centre of mass does not move";
  EXPECT_NEAR(pose.rotation(0, 0), std::cos(1.0), 1e-3);
  const std::string ball = "[[body]]\nshape = {type = \"sphere\", radius = 1}\n";
  const auto fallen = [&](const std::string& keys, std::optional<double> gravity) {
    return last(play(keys + ball, {.seconds = 1, .gravity = gravity}), 0).translation;
  };
  EXPECT_NEAR(fallen("", {}).z(), -9.81 / 2, 0.05);
  EXPECT_NEAR(fallen("", 2).z(), -1, 0.01);
  EXPECT_NEAR(fallen("motion = \"free_fall\"\nacceleration = 4\n", {}).z(), -2, 0.02);
  const Vec3d turned = fallen("motion = \"rotating_gravity\"\nacceleration = 4\nperiod = 1\n", {});
  EXPECT_GT(turned.x(), 0.5);
  EXPECT_NEAR(turned.z(), 0, 0.1);
}

TEST_F(Dynamics, WhatStaysWhatIsIgnoredAndWallsAreKept) {
  const std::string plate =
      "[[body]]\nname = \"plate\"\nshape = {type = \"box\", half_extents = [1, 1, "
      "0.1]}\ntranslation = [0, 0, -1]\nmoving = false\n";
  const std::string ball = "[[body]]\nname = \"ball\"\nshape = {type = \"sphere\", radius = 0.5}\n";
  EXPECT_NEAR(last(play(plate + ball, {.seconds = 3}), 1).translation.z(), -0.4, 0.02);
  EXPECT_LT(last(play("ignore = [[\"ball\", \"plate\"]]\n" + plate + ball, {.seconds = 3}), 1)
                .translation.z(),
            -20);
  const std::string walls = "wall_min = [-9, -9, -5]\nwall_max = [9, 9, 5]\n";
  EXPECT_NEAR(last(play(walls + ball, {.seconds = 3}), 0).translation.z(), -4.5, 0.02);
  // A mesh that stays is its triangles: the ball falls through the hole.
  const std::string ring =
      "[[body]]\nshape = {type = \"torus\", around = 24, across = 12, tube_radius = 0.2, scale = "
      "2}\ntranslation = [0, 0, -1]\nmoving = false\n";
  EXPECT_LT(last(play(ring + ball, {.seconds = 3}), 1).translation.z(), -20);
}

TEST_F(Dynamics, WhatCannotFallIsRefused) {
  const std::string ball = "shape = {type = \"sphere\", radius = 1}\n";
  EXPECT_THAT(fault("[[body]]\nmoving = false\n" + ball), HasSubstr("no body may move"));
  EXPECT_THAT(fault("[[body]]\nname = \"dot\"\nshape = {type = \"sphere\", radius = 0}\n"),
              HasSubstr("scene.toml: body 0 (\"dot\") has no volume"));
  EXPECT_THAT(fault("[[body]]\nshape = {type = \"hull\", vertices = [[0, 0, 0], [1, 0, 0], [0, 1, "
                    "0]]}\n"),
              HasSubstr("body 0 has no volume"));
  EXPECT_THAT(fault(ground + "moving = true\n"), HasSubstr("is a half-space that may move"));
  EXPECT_THAT(fault("generator = \"pairs\"\ncount = 4\n"), HasSubstr("pairs alone"));
  EXPECT_THAT(fault("generator = \"uniform\"\ncount = 100\nteleports = 0.1\n"),
              HasSubstr("bodies jump"));
  EXPECT_THAT(fault("motion = \"brownian\"\n[[body]]\n" + ball), HasSubstr("is brownian"));
  folder_.write("track.csv", "frame,body,x,y,z,qw,qx,qy,qz\n0,0,0,0,0,1,0,0,0\n");
  EXPECT_THAT(fault("poses = \"track.csv\"\n[[body]]\n" + ball), HasSubstr("a log of poses"));
}

}  // namespace
}  // namespace touchstone
