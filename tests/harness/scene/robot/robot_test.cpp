// Tests of robots: what is read of URDF and SRDF, where links are, and what is refused.
#include "harness/scene/robot/robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <numbers>
#include <string>

#include "harness/base/random.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

using scene::Robot;
using testing::HasSubstr;
using testing::StartsWith;

// An arm turns on a base, a flange slides along x, a hand is welded to it, and a finger follows the slide.
const std::string small_urdf = R"(<?xml version="1.0"?>
<robot name="small">
  <link name="base"><collision><geometry><box size="2 2 0.2"/></geometry></collision></link>
  <link name="arm">
    <collision><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/><geometry><cylinder radius="0.1" length="0.8"/></geometry></collision>
    <collision><geometry><sphere radius="0.3"/></geometry></collision>
  </link>
  <link name="flange"/>
  <link name="hand"><collision><geometry><capsule radius="0.1" length="0.4"/></geometry></collision></link>
  <link name="finger"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="follow" type="prismatic"><parent link="hand"/><child link="finger"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 0 2"/><limit lower="-1" upper="1"/><mimic joint="slide" multiplier="-2" offset="0.25"/></joint>
  <joint name="slide" type="prismatic"><parent link="arm"/><child link="flange"/><origin xyz="1 0 0"/>
    <axis xyz="1 0 0"/><limit lower="0.5" upper="0.75"/></joint>
  <joint name="weld" type="fixed"><parent link="flange"/><child link="hand"/><origin xyz="0 0 0.5"/></joint>
  <joint name="pan" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 1"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3"/></joint>
</robot>
)";

Robot read(const std::string& urdf, const std::string& srdf = "") {
  const TemporaryFolder folder;
  if (!srdf.empty()) folder.write("robot.srdf", srdf);
  return scene::read_robot(folder.write("robot.urdf", urdf));
}

std::string fault_of(const std::string& urdf, const std::string& srdf = "") {
  const TemporaryFolder folder;
  if (!srdf.empty()) folder.write("robot.srdf", srdf);
  const auto file = folder.write("robot.urdf", urdf);
  return folder.without_path(input_fault([&] { scene::read_robot(file); }));
}

std::string with(const std::string& old, const std::string& text) {
  std::string changed = small_urdf;
  const auto at = changed.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return changed.replace(at, old.size(), text);
}

TEST(Robots, HaveLinksShapesAndJointsBehindTheirParents) {
  const Robot robot = read(small_urdf);
  EXPECT_EQ(robot.name, "small");
  ASSERT_EQ(robot.links.size(), 5U);
  ASSERT_EQ(robot.links[1].shapes.size(), 2U);
  EXPECT_EQ(robot.links[0].shapes[0].shape.half_extents, Vec3d(1, 1, 0.1));
  const scene::LinkShape& cylinder = robot.links[1].shapes[0];
  EXPECT_EQ(cylinder.shape.kind, ShapeKind::cylinder);
  EXPECT_EQ(cylinder.shape.half_length, 0.4);
  EXPECT_EQ(cylinder.pose.translation, Vec3d(1, 0, 0));
  EXPECT_EQ(robot.links[3].shapes[0].shape.kind, ShapeKind::capsule);
  std::vector<std::string> joints;
  for (const scene::Joint& joint : robot.joints) joints.push_back(joint.name);
  EXPECT_THAT(joints, testing::ElementsAre("pan", "slide", "weld", "follow"));
  EXPECT_EQ(robot.joints[3].axis, Vec3d(0, 0, 1));
}

// URDF's angles are about the fixed axes x, y and z, in this order.
TEST(Robots, TurnByRollPitchAndYaw) {
  const Robot robot = read(with("rpy=\"0 0 1.5707963267948966\"", "rpy=\"0.3 -0.7 1.9\""));
  const Mat3d turn =
      (Eigen::AngleAxisd(1.9, Vec3d::UnitZ()) * Eigen::AngleAxisd(-0.7, Vec3d::UnitY()) *
       Eigen::AngleAxisd(0.3, Vec3d::UnitX()))
          .toRotationMatrix();
  EXPECT_LT((robot.links[1].shapes[0].pose.rotation - turn).norm(), 1e-14);
}

TEST(Robots, StandWhereTheirJointsSay) {
  const Robot robot = read(small_urdf);
  std::vector<double> values = scene::usual_values(robot);
  EXPECT_EQ(values[1], 0.625) << "the middle of limits that exclude 0";
  EXPECT_EQ(values[3], 0.25 - 2 * 0.625);
  values[0] = std::numbers::pi / 2;
  values[1] = 0.5;
  scene::follow_mimics(robot, values);
  const std::vector<Pose> links =
      scene::link_poses(robot, values, {Mat3d::Identity(), Vec3d(10, 0, 0)});
  EXPECT_EQ(links[0].translation, Vec3d(10, 0, 0));
  EXPECT_LT((links[2].translation - Vec3d(10, 1.5, 1)).norm(), 1e-15);
  EXPECT_LT((links[3].translation - Vec3d(10, 1.5, 1.5)).norm(), 1e-15);
  EXPECT_LT((links[4].translation - Vec3d(10, 1.5, 1.5 + 0.5 - 0.75)).norm(), 1e-15);
}

// Against the products of Eigen's affine maps, along each link's way to the root.
TEST(Robots, StandWhereProductsOfTheirTransformsAre) {
  const Robot robot =
      scene::read_robot(std::filesystem::path(project_folder) / "datasets/robots/walker.urdf");
  base::Random random(7);
  double farthest = 0;
  for (int round = 0; round < 50; ++round) {
    std::vector<double> values(robot.joints.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = random.uniform(robot.joints[i].lower, robot.joints[i].upper);
    }
    const std::vector<Pose> links = scene::link_poses(robot, values, Pose{});
    for (std::uint32_t link = 0; link < robot.links.size(); ++link) {
      Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
      for (std::uint32_t at = link; at != robot.root;) {
        const auto joint = std::ranges::find(robot.joints, at, &scene::Joint::child);
        const double value = values[static_cast<std::size_t>(joint - robot.joints.begin())];
        Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
        origin.linear() = joint->origin.rotation;
        origin.translation() = joint->origin.translation;
        place = origin * Eigen::AngleAxisd(value, joint->axis) * place;
        at = joint->parent;
      }
      EXPECT_LT((place.translation() - links[link].translation).norm(), 1e-14);
      EXPECT_LT((place.linear() - links[link].rotation).norm(), 1e-14);
      farthest = std::max(farthest, links[link].translation.norm());
    }
  }
  EXPECT_GT(farthest, 0.4);
}

std::set<std::pair<std::string, std::string>> ignored(const Robot& robot) {
  std::set<std::pair<std::string, std::string>> names;
  for (const auto* pairs : {&robot.joined, &robot.disabled}) {
    for (const IndexPair& pair : *pairs) {
      names.insert(std::minmax(robot.links[pair.a].name, robot.links[pair.b].name));
    }
  }
  return names;
}

TEST(Robots, IgnoreWhatIsJoined) {
  using Names = std::set<std::pair<std::string, std::string>>;
  // The hand is welded to the flange, so that the slide joins it to the arm.
  const Names joined = {{"arm", "base"}, {"arm", "flange"},  {"flange", "hand"},
                        {"arm", "hand"}, {"finger", "hand"}, {"finger", "flange"}};
  EXPECT_EQ(ignored(read(small_urdf)), joined);
  // Through a link without shapes two joints join their ends.
  const std::string through = with("type=\"fixed\"", "type=\"continuous\"");
  EXPECT_EQ(ignored(read(through)), (Names{{"arm", "base"},
                                           {"arm", "flange"},
                                           {"flange", "hand"},
                                           {"arm", "hand"},
                                           {"finger", "hand"}}));
}

TEST(Robots, IgnoreWhatSrdfDisables) {
  const Robot robot = read(small_urdf, R"(<robot name="small">
    <disable_collisions link1="finger" link2="base" reason="Never"/>
    <group_state name="ready" group="all"><joint name="pan" value="1.5"/></group_state></robot>)");
  EXPECT_TRUE(ignored(robot).contains({"base", "finger"}));
  EXPECT_FALSE(ignored(robot).contains({"base", "hand"}));
  EXPECT_EQ(robot.states.at("ready").at("pan"), 1.5);
  const Robot all = read(small_urdf, R"(<robot name="small">
    <disable_default_collisions link="finger"/><enable_collisions link1="finger" link2="arm"/></robot>)");
  EXPECT_TRUE(ignored(all).contains({"base", "finger"}));
  EXPECT_FALSE(ignored(all).contains({"arm", "finger"}));
  EXPECT_TRUE(all.unknown_links.empty());
  // A file for several robots names links that this one does not have.
  const Robot part = read(small_urdf, R"(<robot name="small">
    <disable_collisions link1="finger" link2="camera"/><disable_collisions link1="camera" link2="base"/></robot>)");
  EXPECT_TRUE(part.disabled.empty());
  EXPECT_THAT(part.unknown_links, testing::ElementsAre("camera"));
}

TEST(Robots, ThatAreMalformedAreRefusedWithTheirPlace) {
  const auto place = [](const std::string& fault) { return fault.substr(0, fault.find(' ')); };
  EXPECT_THAT(fault_of("<robot><link"), StartsWith("robot.urdf:1: malformed XML"));
  EXPECT_THAT(fault_of("<sdf/>"), HasSubstr("expected <robot>"));
  EXPECT_THAT(fault_of("<robot name=\"none\"/>"), HasSubstr("0 links; expected 1"));
  const std::string twice = with("name=\"flange\"", "name=\"arm\"");
  EXPECT_EQ(place(fault_of(twice)), "robot.urdf:8:");
  EXPECT_THAT(fault_of(twice), HasSubstr("there twice"));
  EXPECT_THAT(
      fault_of(with("radius=\"0.3\"", "radius=\"0.3m\"")),
      HasSubstr("robot.urdf:6: <sphere>: radius: found \"0.3m\"; expected a finite number"));
  EXPECT_THAT(fault_of(with("radius=\"0.3\"", "radius=\"nan\"")), HasSubstr("finite number"));
  EXPECT_THAT(fault_of(with("radius=\"0.3\"", "radius=\"-1\"")), HasSubstr("expected 0 or more"));
  EXPECT_THAT(fault_of(with("2 2 0.2", "2 2")), HasSubstr("found 2 numbers; expected three"));
  EXPECT_THAT(fault_of(with("<parent link=\"hand\"/>", "")), HasSubstr("no <parent> in it"));
  EXPECT_THAT(fault_of(with("parent link=\"hand\"", "parent link=\"hook\"")),
              HasSubstr("no link of the name \"hook\""));
  EXPECT_THAT(fault_of(with("type=\"revolute\"", "type=\"floating\"")),
              HasSubstr("type \"floating\"; expected fixed, revolute"));
  EXPECT_THAT(fault_of(with("lower=\"-3\"", "lower=\"4\"")), HasSubstr("lower 4 above upper 3"));
  EXPECT_THAT(fault_of(with("child link=\"hand\"", "child link=\"finger\"")),
              HasSubstr("expected a tree of links"));
  EXPECT_THAT(fault_of(with("parent link=\"base\"", "parent link=\"hand\"")),
              HasSubstr("part of a loop"));
  EXPECT_THAT(fault_of(with("joint=\"slide\"", "joint=\"follow\"")),
              HasSubstr("mimic each other in a circle"));
  EXPECT_THAT(fault_of(with("<axis xyz=\"0 0 2\"/>", "<axis xyz=\"0 0 0\"/>")),
              HasSubstr("expected a direction"));
  EXPECT_THAT(fault_of(with("<capsule radius=\"0.1\" length=\"0.4\"/>",
                            "<mesh filename=\"package://kit/hand.stl\"/>")),
              HasSubstr("\"package://kit/hand.stl\" is not there; tried"));
  EXPECT_THAT(fault_of(with("<limit lower=\"-3\" upper=\"3\"/>", "<limit effort=\"9\"/>")),
              HasSubstr("robot.urdf:17: <limit>: neither lower nor upper; expected the range"));
  EXPECT_EQ(fault_of(with("<limit lower=\"-3\" upper=\"3\"/>", "<limit lower=\"0\" upper=\"0\"/>")),
            "");
  EXPECT_EQ(fault_of(with("<limit lower=\"-1\" upper=\"1\"/>", "<limit effort=\"9\"/>")), "")
      << "a joint that mimics another";
  EXPECT_THAT(
      fault_of(with("</robot>", "<link name=\"stray\"/></robot>")),
      HasSubstr("2 links are no joint's child: \"base\", \"stray\"; expected one, the root"));
  EXPECT_THAT(fault_of(with("<link name=\"flange\"/>",
                            "<link name=\"flange\"><xacro:shape size=\"1\"/></link>")),
              HasSubstr("robot.urdf:8: <xacro:shape>: a macro; expected an expanded file: `xacro"));
  EXPECT_THAT(fault_of(small_urdf, "<robot><disable_collisions link1=\"arm\"/></robot>"),
              HasSubstr("robot.srdf:1: <disable_collisions>: no attribute link2"));
}

TEST(Robots, WarnOfWhatSrdfDoesNotHave) {
  const auto warnings_of = [](const std::string& srdf) {
    testing::internal::CaptureStderr();
    const Robot robot = read(small_urdf, srdf);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(warnings_of("<robot name=\"small\"><group name=\"all\"/></robot>"), "");
  EXPECT_THAT(
      warnings_of("<robot name=\"small\">\n<disable_collision link1=\"arm\" "
                  "link2=\"finger\"/></robot>"),
      HasSubstr("robot.srdf:2: warning: <disable_collision>: is left out: no element of SRDF "
                "is called 'disable_collision'; did you mean disable_collisions?\n"));
  EXPECT_THAT(
      warnings_of("<robot name=\"large\"/>"),
      HasSubstr("robot.srdf:1: warning: <robot>: of the robot \"large\"; expected \"small\""));
  EXPECT_THAT(fault_of(small_urdf, small_urdf),
              HasSubstr("robot.srdf:3: <link>: of URDF; expected SRDF"));
  EXPECT_THAT(fault_of(small_urdf, "<robot><xacro:include filename=\"a\"/></robot>"),
              HasSubstr("robot.srdf:1: <xacro:include>: a macro"));
}

TEST(Robots, RefuseMeshesThatAreNotRead) {
  const TemporaryFolder folder;
  folder.write("hand.step", "<COLLADA/>");
  const auto fault_with = [&](const std::string& name) {
    const auto file = folder.write(
        "robot.urdf", "<robot>\n<link name=\"hand\"><collision><geometry><mesh filename=\"" + name +
                          "\"/></geometry></collision></link></robot>");
    return folder.without_path(input_fault([&] { scene::read_robot(file); }));
  };
  EXPECT_THAT(fault_with("hand.step"),
              testing::AllOf(StartsWith("robot.urdf:2: <mesh>: filename: the format of"),
                             HasSubstr("hand.step\" is not read; expected .obj, .off, .stl, .ply, "
                                       ".dae, .glb, .gltf, .fbx or .3ds")));
  const std::string missing = fault_with("meshes/hand.stl");
  EXPECT_THAT(missing, HasSubstr("\"meshes/hand.stl\" is not there; tried "));
  EXPECT_THAT(missing, HasSubstr("Expected a mesh, by a path from the robot's file"));
  EXPECT_THAT(fault_with("http://kit/hand.stl"),
              HasSubstr("is no file; expected a path, file:// or package://"));
  EXPECT_THAT(fault_with("$(find kit)/hand.stl"), HasSubstr("expected an expanded file: `xacro"));
  EXPECT_THAT(fault_with("package://kit/hand.stl"), HasSubstr("Expected the key packages"));
}

TEST(Robots, FindMeshesInPackages) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "kit/urdf");
  std::filesystem::create_directories(folder.path() / "kit/meshes");
  std::filesystem::create_directories(folder.path() / "elsewhere/other/meshes");
  for (const char* at : {"kit/meshes/hand.obj", "elsewhere/other/meshes/hand.obj"}) {
    folder.write(at, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  }
  const auto mesh_of = [&](const std::string& name, const scene::Packages& packages) {
    const auto urdf = folder.write(
        "kit/urdf/robot.urdf", "<robot><link name=\"hand\"><collision><geometry><mesh filename=\"" +
                                   name + "\"/></geometry></collision></link></robot>");
    const Robot robot = scene::read_robot(urdf, {}, packages);
    return std::filesystem::canonical(robot.links[0].shapes[0].mesh);
  };
  const auto own = std::filesystem::canonical(folder.path() / "kit/meshes/hand.obj");
  const auto other = std::filesystem::canonical(folder.path() / "elsewhere/other/meshes/hand.obj");
  EXPECT_EQ(mesh_of("package://kit/meshes/hand.obj", {}), own);
  EXPECT_EQ(mesh_of("../meshes/hand.obj", {}), own);
  EXPECT_EQ(mesh_of("file://" + own.string(), {}), own);
  EXPECT_EQ(mesh_of("package://other/meshes/hand.obj",
                    {.named = {}, .folders = {folder.path() / "elsewhere"}}),
            other);
  EXPECT_EQ(mesh_of("package://mine/meshes/hand.obj",
                    {.named = {{"mine", folder.path() / "elsewhere/other"}}, .folders = {}}),
            other);
}

}  // namespace
}  // namespace touchstone
