// Tests of logs of poses.
#include "harness/scene/pose_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "harness/scene/kinematics.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

const std::string three_bodies =
    "[[body]]\nname = \"lid\"\nshape = {type = \"sphere\", radius = 1}\n"
    "[[body]]\nshape = {type = \"box\", half_extents = [1, 2, 3]}\nmoving = false\n"
    "[[body]]\nname = \"ball\"\nshape = {type = \"sphere\", radius = 1}\nvelocity = [1, 0, 0]\n";

class PoseLogs : public testing::Test {
 protected:
  scene::Scene load(const std::string& csv, const std::string& rest = "") {
    folder_.write("log.csv", csv);
    return scene::load_scene(
        folder_.write("scene.toml", "poses = \"log.csv\"\ntime_step = 1\n" + rest + three_bodies));
  }
  std::string fault(const std::string& csv, const std::string& rest = "") {
    return folder_.without_path(input_fault([&] { load(csv, rest); }));
  }

  TemporaryFolder folder_;
};

TEST_F(PoseLogs, PlaceBodiesByNumberAndName) {
  const scene::Scene scene = load(
      "frame,body,x,y,z,qw,qx,qy,qz\n"
      "0,lid,0,0,5,1,0,0,0\n0,1,7,0,0,1,0,0,0\n"
      "1,1,8,0,0,0,0,0,-3\n"
      "2,lid,0,0,6,1,0,0,0\n");
  EXPECT_EQ(scene.frames, 3);
  EXPECT_TRUE(scene.bodies[1].moving);
  scene::Kinematics kinematics(scene);
  EXPECT_EQ(kinematics.poses()[0].translation, Vec3d(0, 0, 5));
  kinematics.next();
  EXPECT_EQ(kinematics.poses()[0].translation, Vec3d(0, 0, 5)) << "without a row it stays";
  EXPECT_EQ(kinematics.poses()[1].translation, Vec3d(8, 0, 0));
  EXPECT_EQ(kinematics.poses()[1].rotation, Mat3d(Vec3d(-1, -1, 1).asDiagonal()));
  EXPECT_EQ(kinematics.velocities()[1], Vec3d(1, 0, 0));
  kinematics.next();
  EXPECT_EQ(kinematics.poses()[0].translation, Vec3d(0, 0, 6));
  EXPECT_EQ(kinematics.poses()[2].translation, Vec3d(2, 0, 0)) << "by its velocity";
}

// A number is a body's; what only begins with digits is a name.
TEST_F(PoseLogs, TellNumbersFromNames) {
  folder_.write("log.csv",
                "frame,body,x,y,z,qw,qx,qy,qz\n0,2nd,1,0,0,1,0,0,0\n0,0,2,0,0,1,0,0,0\n");
  const std::string ball = "shape = {type = \"sphere\", radius = 1}\n";
  const scene::Scene scene = scene::load_scene(
      folder_.write("scene.toml", "poses = \"log.csv\"\n[[body]]\nname = \"1\"\n" + ball +
                                      "[[body]]\nname = \"2nd\"\n" + ball));
  EXPECT_EQ(scene.bodies[0].pose.translation, Vec3d(2, 0, 0));
  EXPECT_EQ(scene.bodies[1].pose.translation, Vec3d(1, 0, 0));
}

TEST_F(PoseLogs, AreWrittenAndReadWithTheSameBits) {
  const auto original =
      folder_.write("turning.toml",
                    "frames = 20\nmotion = \"free_fall\"\n[[body]]\nshape = {type = \"box\", "
                    "half_extents = [1, 1, 1]}\n"
                    "velocity = [1, 2, 3]\nangular_velocity = [3, 2, 1]\n"
                    "[[body]]\nshape = {type = \"sphere\", radius = 1}\nmoving = false\n");
  const scene::Scene scene = scene::load_scene(original);
  EXPECT_EQ(scene::write_pose_log(scene, folder_.path() / "turning.csv"), 20);
  const scene::Scene again = scene::load_scene(folder_.write(
      "again.toml",
      "poses = \"turning.csv\"\n[[body]]\nshape = {type = \"box\", half_extents = [1, 1, 1]}\n"
      "[[body]]\nshape = {type = \"sphere\", radius = 1}\nmoving = false\n"));
  scene::Kinematics first(scene), second(again);
  for (int frame = 0; frame < 20; ++frame) {
    for (std::size_t body = 0; body < 2; ++body) {
      EXPECT_EQ(first.poses()[body].translation, second.poses()[body].translation);
      EXPECT_EQ(first.poses()[body].rotation, second.poses()[body].rotation);
    }
    first.next();
    second.next();
  }
  EXPECT_EQ(scene::write_pose_log(again, folder_.path() / "third.csv"), 20);
  EXPECT_EQ(folder_.read("turning.csv"), folder_.read("third.csv"));
}

TEST_F(PoseLogs, ThatAreMalformedAreRefusedWithTheirPlace) {
  const std::string quaternions = "frame,body,x,y,z,qw,qx,qy,qz\n";
  EXPECT_THAT(fault(quaternions), HasSubstr("no row behind the header"));
  EXPECT_THAT(fault(quaternions + "1,0,0,0,0,1,0,0,0\n"),
              HasSubstr("log.csv:2: frame 1; expected 0"));
  EXPECT_THAT(fault(quaternions + "0,0,0,0,0,1,0,0,0\n2,0,0,0,0,1,0,0,0\n"),
              HasSubstr("log.csv:3: frame 2 after frame 0"));
  EXPECT_THAT(fault(quaternions + "0,3,0,0,0,1,0,0,0\n"), HasSubstr("a number below 3"));
  EXPECT_THAT(fault(quaternions + "0,lip,0,0,0,1,0,0,0\n"), HasSubstr("body \"lip\""));
  EXPECT_THAT(fault(quaternions + "0,0,0,0,nan,1,0,0,0\n"), HasSubstr("z: found nan"));
  EXPECT_THAT(fault(quaternions + "0,0,0,0,0,0,0,0,0\n"), HasSubstr("the quaternion is 0"));
  EXPECT_THAT(fault(quaternions + "0,0,0,0,0,1,0,0,0\n0,lid,0,0,0,1,0,0,0\n"),
              HasSubstr("log.csv:3: a second row"));
  EXPECT_THAT(fault("frame,body,x,y,z\n0,0,0,0,0\n"), HasSubstr("no column 'qw'"));
  EXPECT_THAT(fault("frame,body,m00,m01,m02,m03,m10,m11,m12,m13,m20,m21,m22,m23\n"
                    "0,0,2,0,0,0,0,1,0,0,0,0,1,0\n"),
              HasSubstr("the matrix is no rotation"));
}

}  // namespace
}  // namespace touchstone
