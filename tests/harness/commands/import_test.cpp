// Tests of touchstone scene import.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/scene/box_frames.h"
#include "tests/harness/commands/importing.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

namespace fs = std::filesystem;
using testing::ContainsRegex;
using testing::HasSubstr;

const std::string ball = "[[body]]\nname = \"ball\"\nshape = {type = \"sphere\", radius = 0.1}\n";

// Names of files are relative, absolute, above the scene and in scenes that it imports.
TEST_F(Import, AScenesFolderIsWhole) {
  folder_.write("mine/log.csv",
                "frame,body,x,y,z,qw,qx,qy,qz\n0,1,0,0,0,1,0,0,0\n1,1,0,0,1,1,0,0,0\n");
  folder_.write("mine/heights.csv", "0,1\n1,0\n");
  folder_.write("mine/inner.toml", "[[body]]\nmesh = '" + path("mine/meshes/tip.obj") + "'\n");
  fs::create_directories(folder_.path() / "mine/scenes");
  folder_.write("mine/scenes/s.toml",
                "import = \"../inner.toml\"\nposes = \"" + path("mine/log.csv") +
                    "\"\n[[body]]\nmesh = \"../meshes/tip.obj\"\nscale = 2\nas = \"hull\"\n"
                    "[[body]]\nshape = {type = \"height_field\", file = \"../heights.csv\", "
                    "cell_size = 1}\n");
  folder_.write("mine/LICENSE", "\n# The MIT License\n\nPermission ...\n");
  const std::string file = path("mine/scenes/s.toml");
  EXPECT_EQ(import_alone(file, "The MIT License"), hash_of(file));
  EXPECT_EQ(folder_.read("out0/mine/heights.csv"), "0,1\n1,0\n");
  EXPECT_EQ(folder_.read("out0/LICENSE"), folder_.read("mine/LICENSE"));
  // One that generates, and cannot be imported by another.
  folder_.write("mine/pairs.toml", "generator = \"pairs\"\ncount = 6\n");
  EXPECT_EQ(import_alone(path("mine/pairs.toml")), hash_of(path("mine/pairs.toml")));
}

TEST_F(Import, RobotsComeWithTheirPackagesAndTheirWorld) {
  fs::create_directories(folder_.path() / "mine/arm_description/urdf");
  fs::create_directories(folder_.path() / "mine/arm_description/meshes");
  folder_.write("mine/arm_description/meshes/tip.obj", folder_.read("mine/meshes/tip.obj"));
  folder_.write("mine/arm_description/urdf/arm.urdf",
                "<robot name=\"arm\"><link name=\"base\"><visual/><inertial/></link><link "
                "name=\"tip\"><collision><geometry><mesh "
                "filename=\"package://arm_description/meshes/tip.obj\"/></geometry></collision>"
                "</link><joint name=\"lift\" type=\"prismatic\"><parent link=\"base\"/><child "
                "link=\"tip\"/><axis xyz=\"0 0 1\"/><limit lower=\"0\" upper=\"1\" effort=\"1\" "
                "velocity=\"1\"/></joint><transmission name=\"t\"/></robot>");
  folder_.write("mine/path.csv", "lift\n0\n1\n");
  folder_.write("mine/world.toml", ball + "moving = false\n");
  const std::string arm = path("mine/arm_description/urdf/arm.urdf");
  EXPECT_EQ(import_alone(arm, "1 inertial, 1 transmission, 1 visual"), hash_of(arm));
  folder_.write("mine/all.toml",
                "import = [\"" + arm + "\", \"world.toml\"]\nconfigurations = \"path.csv\"\n");
  EXPECT_EQ(import_alone(arm + " " + path("mine/world.toml") + " " + path("mine/path.csv")),
            hash_of(path("mine/all.toml")));
}

TEST_F(Import, RecordingsMeshesAndRigidIpc) {
  scene::BoxRecording recording{"s", "t", {{0, 0, 0}, {4, 4, 4}}, {}};
  recording.frames.push_back({{{0, 0, 0}, {1, 1, 1}}, {{2, 2, 2}, {3, 3, 3}}});
  scene::write_aabbs(recording, folder_.path() / "mine/r.aabbs");
  EXPECT_EQ(import_alone(path("mine/r.aabbs")), hash_of(path("mine/r.aabbs")));
  folder_.write("mine/two.toml", "[[body]]\nmesh = \"meshes/tip.obj\"\n");
  EXPECT_EQ(import_alone(path("mine/meshes/tip.obj")), hash_of(path("mine/two.toml")));
  folder_.write(
      "mine/ipc.json",
      "{\"rigid_body_problem\": {\"rigid_bodies\": [{\"mesh\": \"tip.obj\", \"position\": "
      "[1, 2, 3]}]}}");
  EXPECT_EQ(import_alone(path("mine/ipc.json")), hash_of(path("mine/ipc.json")));
  // A log beside the scene that names its bodies.
  folder_.write("mine/log.csv",
                "frame,body,x,y,z,qw,qx,qy,qz\n0,ball,0,0,0,1,0,0,0\n1,0,0,0,1,1,0,0,0\n");
  folder_.write("mine/ball.toml", ball);
  folder_.write("mine/moved.toml", "poses = \"log.csv\"\nimport = \"ball.toml\"\n");
  EXPECT_EQ(import_alone(path("mine/log.csv") + " " + path("mine/ball.toml")),
            hash_of(path("mine/moved.toml")));
}

TEST_F(Import, TheHomeIsThatOfTheDataSets) {
  const std::string home = (fs::path(project_folder) / "datasets/concave/home.toml").string();
  const Ran ran = run_program("scene import " + home + " --out " + path("home"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_EQ(hash_of(path("home/scene.toml")), hash_of(home));
  EXPECT_THAT(ran.text, ContainsRegex("datasets/home/armchair.obj"));
}

TEST_F(Import, WhatIsNoSceneIsRefusedAndLeavesNothing) {
  folder_.write("mine/a.csv", "frame,body,x,y,z,qw,qx,qy,qz\n0,0,0,0,0,1,0,0,0\n");
  folder_.write("mine/b.txt", "");
  folder_.write("mine/bad.toml", "[[body]]\nmesh = \"none.obj\"\n");
  const auto refuse = [&](const std::string& files, const std::string& text) {
    expect_refusal("scene import " + files + " --out " + path("made"), text, folder_);
  };
  refuse(path("none.toml"), "none.toml");
  // A file that the robot names by a whole path would stay outside.
  folder_.write("mine/part.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  folder_.write("mine/robot.urdf",
                "<robot name=\"r\"><link name=\"l\"><collision><geometry><mesh filename=\"file://" +
                    path("mine/part.obj") + "\"/></geometry></collision></link></robot>");
  refuse(path("mine/robot.urdf"), "by a whole path");
  refuse(path("mine/b.txt"), "unknown kind of file");
  refuse(path("mine/bad.toml"), "none.obj");
  refuse(path("mine/a.csv"), "missing; expected generator");
  refuse(path("mine/a.csv") + " " + path("mine/a.csv"), "a second file for the key `poses`");
  folder_.write("mine/ball.toml", ball);
  expect_refusal("scene import " + path("mine/ball.toml") + " --out " + path("mine"),
                 "is there; expected a new folder", folder_);
}

}  // namespace
}  // namespace touchstone
