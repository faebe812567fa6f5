// Tests of scenes with robots: configurations, obstacles, and the pairs that are asked.
#include "harness/scene/robot/robot_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "harness/base/random.h"
#include "harness/base/reproducible_math.h"
#include "harness/scene/kinematics.h"
#include "harness/scene/pair_filter.h"
#include "harness/scene/player.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

// A ball on a boom of 1 m that turns about z, and a ball that slides along z above the pivot.
const char* const crane_urdf = R"(<robot name="crane">
  <link name="foot"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="boom"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="lift"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="foot"/><child link="boom"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2"/></joint>
  <joint name="rise" type="prismatic"><parent link="foot"/><child link="lift"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1"/></joint>
</robot>)";

class RobotScenes : public testing::Test {
 protected:
  RobotScenes() { folder_.write("crane.urdf", crane_urdf); }

  scene::Scene load(const std::string& rest, const scene::SceneOverrides& overrides = {}) {
    return scene::load_scene(folder_.write("scene.toml", "import = \"crane.urdf\"\n" + rest),
                             overrides);
  }
  std::string fault(const std::string& rest, const scene::SceneOverrides& overrides = {}) {
    return folder_.without_path(input_fault([&] { load(rest, overrides); }));
  }

  TemporaryFolder folder_;
};

// Where a body is, frame by frame.
std::vector<Vec3d> places(const scene::Scene& scene, std::size_t body) {
  std::vector<Vec3d> all;
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  do {
    all.push_back(player.poses()[body].translation);
  } while (player.next());
  return all;
}

TEST_F(RobotScenes, StandInTheirUsualConfiguration) {
  const scene::Scene scene = load("joints = {turn = 1.5707963267948966}\n");
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.frames, 1);
  EXPECT_THAT(scene.names, testing::ElementsAre("foot", "boom", "lift"));
  EXPECT_LT((scene.bodies[1].pose.translation - Vec3d(0, 1, 0)).norm(), 1e-15);
  const scene::Scene alone = scene::load_scene(folder_.path() / "crane.urdf");
  EXPECT_EQ(alone.bodies.size(), 3U);
  EXPECT_EQ(alone.bodies[1].pose.translation, Vec3d(1, 0, 0));
}

TEST_F(RobotScenes, FollowTheRowsOfAFile) {
  folder_.write("path.csv", "time,rise,turn\n0,0.5,0\n0.25,0.75,1.5707963267948966\n0.5,1,0\n");
  const scene::Scene scene = load("configurations = \"path.csv\"\n");
  EXPECT_EQ(scene.frames, 3);
  EXPECT_EQ(scene.motion.time_step, 0.25);
  const auto boom = places(scene, 1), lift = places(scene, 2);
  EXPECT_LT((boom[1] - Vec3d(0, 1, 0)).norm(), 1e-15);
  EXPECT_EQ(boom[2], Vec3d(1, 0, 0));
  EXPECT_EQ(lift[0], Vec3d(0, 0, 0.5));
  EXPECT_EQ(lift[2], Vec3d(0, 0, 1));

  // The motion of a step leads to the next frame; the last one stays.
  const auto steps = scene::motion_steps(scene, "scene.toml");
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_LT((steps[0].motions[1].rotation_vector - Vec3d(0, 0, 1.5707963267948966)).norm(), 1e-15);
  EXPECT_LT((steps[1].motions[1].rotation_vector + Vec3d(0, 0, 1.5707963267948966)).norm(), 1e-15);
  EXPECT_EQ(steps[0].motions[2].displacement, Vec3d(0, 0, 0.25));
  EXPECT_FALSE(steps[2].motions[1].turns());
  EXPECT_EQ(steps[2].motions[2].displacement, Vec3d(0, 0, 0));

  const scene::Scene two = load("configurations = \"path.csv\"\nframes = 2\n");
  EXPECT_EQ(two.frames, 2);
  EXPECT_THAT(fault("configurations = \"path.csv\"\nframes = 4\n"),
              HasSubstr("4 frames; expected 1 to 3"));
}

TEST_F(RobotScenes, RefuseMalformedFilesOfConfigurations) {
  const auto fault_of = [&](const std::string& csv) {
    folder_.write("path.csv", csv);
    return fault("configurations = \"path.csv\"\n");
  };
  EXPECT_THAT(fault_of("turn,elbow\n0,0\n"),
              HasSubstr("path.csv:1: column 'elbow'; expected none but"));
  EXPECT_THAT(fault_of("turn\n0\nup\n"), HasSubstr("path.csv:3:"));
  EXPECT_THAT(fault_of("turn\ninf\n"), HasSubstr("path.csv:2: turn: found inf"));
  EXPECT_THAT(fault_of("turn\n"), HasSubstr("no row behind the header"));
  EXPECT_THAT(fault_of(""), HasSubstr("expected a header line with some of time,turn,rise"));
  EXPECT_THAT(fault_of("time\n0\n"), HasSubstr("no column of a joint"));
  EXPECT_THAT(fault_of("time,turn\n1,0\n1,0\n"), HasSubstr("path.csv:3: time 1 after 1"));
  EXPECT_THAT(fault("configurations = \"none.csv\"\n"), HasSubstr("scene.toml:2:"));
}

TEST_F(RobotScenes, WarnOfConfigurationsBeyondLimits) {
  const auto warning_of = [&](const std::string& csv) {
    folder_.write("path.csv", csv);
    testing::internal::CaptureStderr();
    EXPECT_EQ(load("configurations = \"path.csv\"\n").frames, 4);
    return folder_.without_path(testing::internal::GetCapturedStderr());
  };
  EXPECT_EQ(warning_of("turn,rise\n2.0000001,0\n-2,1\n0,-1e-7\n0,0\n"), "");
  EXPECT_EQ(warning_of("turn,rise\n0,0\n2.5,1\n3,-1\n0,1.5\n"),
            "path.csv:3: warning: turn: 2.5 is outside of the joint's limits, -2 to 2; rows with "
            "such values: 3 of 4\n");
}

TEST_F(RobotScenes, DrawConfigurationsWithinLimits) {
  const std::string random = "held = [\"rise\"]\nconfigurations = {random = 500, seed = 3}\n";
  const scene::Scene scene = load(random);
  double least = 2, greatest = -2;
  for (const Vec3d& at : places(scene, 1)) {
    const double angle = std::atan2(at.y(), at.x());
    least = std::min(least, angle);
    greatest = std::max(greatest, angle);
  }
  EXPECT_GE(least, -2);
  EXPECT_LT(least, -1.8);
  EXPECT_LE(greatest, 2 + 1e-15);
  EXPECT_GT(greatest, 1.8);
  for (const Vec3d& at : places(scene, 2)) EXPECT_EQ(at, Vec3d(0, 0, 0));
  EXPECT_EQ(scene::scene_hash(scene), scene::scene_hash(load(random)));
  EXPECT_NE(scene::scene_hash(scene), scene::scene_hash(load(random, {.seed = 4})));
  EXPECT_THAT(fault("", {.seed = 4}), HasSubstr("seed"));

  const auto walk = places(load("configurations = {walk = 400, step = 0.01}\n"), 2);
  double longest = 0, sum = 0;
  for (std::size_t i = 1; i < walk.size(); ++i) {
    const double step = std::abs(walk[i].z() - walk[i - 1].z());
    longest = std::max(longest, step);
    sum += step;
    EXPECT_GE(walk[i].z(), 0);
    EXPECT_LE(walk[i].z(), 1);
  }
  EXPECT_LE(longest, 0.01 + 1e-15);
  EXPECT_GT(longest, 0.009);
  EXPECT_GT(sum, 1);
}

// A planning scene and a request as benchmark sets have them.
const char* const problem_scene = R"(robot_state:
  multi_dof_joint_state:
    transforms: [{translation: [0, 0, 5], rotation: [0, 0, 0, 1]}]
allowed_collision_matrix:
  entry_names: [boom, lift, can]
  entry_values:
    - [false, false, true]
    - [false, false, false]
    - [true, false, false]
world:
  collision_objects:
    - id: can
      primitives:
        - {type: cylinder, dimensions: [0.4, 0.1]}
      primitive_poses:
        - position: [1, 0, 5]
          orientation: [0, 0.7071067811865476, 0, 0.7071067811865476]
    - id: table
      header: {frame_id: foot}
      pose: {position: {x: 0, y: 0, z: 0}, orientation: {x: 0, y: 0, z: 0, w: 2}}
      primitives: [{type: 1, dimensions: [1, 2, 3]}, {type: sphere, dimensions: [0.5]}]
      primitive_poses: [{position: [0, 0, 1]}, {position: [0, 1, 0]}]
      meshes:
        - vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0], {x: 0, y: 0, z: 1}]
          triangles: [{vertex_indices: [0, 2, 1]}, {vertex_indices: [0, 1, 3]}, {vertex_indices: [1, 2, 3]}, {vertex_indices: [2, 0, 3]}]
      mesh_poses: [{position: [3, 0, 0]}]
)";
const char* const problem_request = R"(start_state:
  joint_state: {name: [turn, rise], position: [0, 0.5]}
goal_constraints:
  - joint_constraints: [{joint_name: turn, position: 1.5}]
)";

TEST_F(RobotScenes, ReadProblemsOfMotionPlanning) {
  folder_.write("problem.yaml", problem_scene);
  folder_.write("request.yaml", problem_request);
  const scene::Scene scene =
      load("obstacles = \"problem.yaml\"\nconfigurations = {file = \"request.yaml\", steps = 3}\n");
  EXPECT_EQ(scene.frames, 4);
  ASSERT_THAT(scene.names,
              testing::ElementsAre("foot", "boom", "lift", "can", "table", "table", "table"));
  EXPECT_EQ(scene.bodies[0].pose.translation, Vec3d(0, 0, 5));
  const auto boom = places(scene, 1);
  EXPECT_LT((boom[3] - Vec3d(std::cos(1.5), std::sin(1.5), 5)).norm(), 1e-15);
  EXPECT_LT((boom[1] - Vec3d(std::cos(0.5), std::sin(0.5), 5)).norm(), 1e-15);
  const scene::Body& can = scene.bodies[3];
  EXPECT_EQ(scene.shapes[can.shape].half_length, 0.2);
  EXPECT_EQ(scene.shapes[can.shape].radius, 0.1);
  EXPECT_LT((can.pose.rotation.col(2) - Vec3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_FALSE(can.moving);
  EXPECT_EQ(scene.bodies[4].pose.translation, Vec3d(0, 0, 6));
  EXPECT_EQ(scene.shapes[scene.bodies[4].shape].half_extents, Vec3d(0.5, 1, 1.5));
  EXPECT_EQ(scene.bodies[6].pose.translation, Vec3d(3, 0, 5));
  EXPECT_NE(scene.concave_of(scene.bodies[6].shape), nullptr);

  const scene::PairFilter& filter = scene.filter;
  EXPECT_FALSE(filter.asks({0, 1})) << "joined";
  EXPECT_TRUE(filter.asks({1, 2}));
  EXPECT_FALSE(filter.asks({1, 3})) << "allowed";
  EXPECT_TRUE(filter.asks({2, 3}));
  EXPECT_FALSE(filter.asks({3, 4})) << "the world against itself";
}

TEST_F(RobotScenes, WarnOfKeysOfProblemsThatAreNearlyKnown) {
  const auto warning_of = [&](const std::string& old, const std::string& now) {
    std::string text = problem_scene;
    text.replace(text.find(old), old.size(), now);
    folder_.write("problem.yaml", text);
    testing::internal::CaptureStderr();
    load("obstacles = \"problem.yaml\"\nconfigurations = {random = 1}\n");
    return folder_.without_path(testing::internal::GetCapturedStderr());
  };
  EXPECT_EQ(warning_of("world:", "world:"), "");
  EXPECT_EQ(warning_of("robot_state:", "comment: none\nrobot_state:"), "") << "of somebody's own";
  EXPECT_THAT(warning_of("collision_objects:", "collision_object:"),
              HasSubstr(": warning: the key \"collision_object\" is ignored; perhaps "
                        "\"collision_objects\" was meant\n"));
  EXPECT_THAT(warning_of("orientation: [0, 0.7", "orientaton: [0, 0.7"),
              HasSubstr("perhaps \"orientation\" was meant"));
  EXPECT_THAT(warning_of("frame_id:", "frameid:"), HasSubstr("perhaps \"frame_id\" was meant"));
}

TEST_F(RobotScenes, RefuseMacros) {
  EXPECT_THAT(
      input_fault([&] { scene::load_scene(folder_.write("crane.urdf.xacro", crane_urdf)); }),
      HasSubstr("expected an expanded file: `xacro FILE > robot.urdf`"));
}

TEST_F(RobotScenes, RefuseMalformedProblems) {
  const auto fault_of = [&](std::string text, const std::string& old, const std::string& now) {
    const auto at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    const bool is_request = text.starts_with("start_state");
    text.replace(at, old.size(), now);
    folder_.write("problem.yaml", is_request ? problem_scene : text);
    folder_.write("request.yaml", is_request ? text : problem_request);
    return fault("obstacles = \"problem.yaml\"\nconfigurations = \"request.yaml\"\n");
  };
  EXPECT_THAT(fault_of(problem_scene, "dimensions: [0.4, 0.1]", "dimensions: [0.4]"),
              HasSubstr("problem.yaml:14: found 1 dimensions of a cylinder; expected 2"));
  EXPECT_THAT(fault_of(problem_scene, "frame_id: foot", "frame_id: boom"),
              HasSubstr("frame_id \"boom\"; expected world or a link that is fixed"));
  EXPECT_THAT(fault_of(problem_scene, "type: cylinder", "type: torus"), HasSubstr("\"torus\""));
  EXPECT_THAT(fault_of(problem_scene, "0.4, 0.1", "0.4, .nan"), HasSubstr("finite number"));
  EXPECT_THAT(fault_of(problem_scene, "- [true, false, false]", "- [true, false]"),
              HasSubstr("2 values; expected 3"));
  EXPECT_THAT(
      fault_of(problem_scene, "[1, 2, 3]}, {vertex_indices: [2", "[1, 2, 3]}, {vertex_indices: [9"),
      HasSubstr("expected an integer from 0 to 3"));
  EXPECT_THAT(fault_of(problem_scene, "[{position: [0, 0, 1]}, ", "["),
              HasSubstr("2 primitives and 1 primitive_poses"));
  EXPECT_THAT(fault_of(problem_scene, "[1, 0, 5]", "[1, 0, 5"), HasSubstr("malformed YAML"));
  EXPECT_THAT(fault_of(problem_scene, problem_scene, ""),
              HasSubstr("problem.yaml: found nothing; expected a planning scene in YAML: a map"));
  EXPECT_THAT(fault_of(problem_scene, problem_scene, "- world\n"), HasSubstr("found a list"));
  EXPECT_THAT(fault_of(problem_scene, problem_scene, "hello: 1\n"),
              HasSubstr("problem.yaml:1: no key of a planning scene; expected some of world, "
                        "robot_state, allowed_collision_matrix"));
  EXPECT_THAT(fault_of(problem_scene, problem_scene, problem_request),
              HasSubstr("no key of a planning scene"));
  EXPECT_THAT(fault_of(problem_request, "joint_name: turn", "joint_name: tilt"),
              HasSubstr("request.yaml:4: the robot has no joint \"tilt\""));
  EXPECT_THAT(fault_of(problem_request, "[0, 0.5]", "[0]"), HasSubstr("2 names and 1 positions"));
}

TEST_F(RobotScenes, StandAmongOtherBodies) {
  const std::string wall =
      "[[body]]\nname = \"wall\"\nmoving = false\nshape = {type = \"box\", half_extents = [1, 1, "
      "1]}\n"
      "[[body]]\nname = \"ball\"\nshape = {type = \"sphere\", radius = 1}\nvelocity = [3, 0, 0]\n";
  const scene::Scene scene = load(
      "time_step = 1\nconfigurations = {random = 3}\nignore = [[\"wall\", \"boom\"]]\n" + wall);
  EXPECT_THAT(scene.names, testing::ElementsAre("foot", "boom", "lift", "wall", "ball"));
  EXPECT_EQ(places(scene, 4)[2], Vec3d(6, 0, 0));
  EXPECT_FALSE(scene.filter.asks({1, 3}));
  EXPECT_TRUE(scene.filter.asks({2, 3}));
  EXPECT_TRUE(scene.filter.asks({3, 4}));
  EXPECT_THAT(fault("ignore = [[\"wall\", \"boom\"]]\n"),
              HasSubstr("no body has the name \"wall\""));

  const scene::Scene many = load("generator = \"uniform\"\ncount = 50\nmoving = 0\n" + wall);
  ASSERT_EQ(many.bodies.size(), 55U);
  EXPECT_EQ(many.frames, 1);
  EXPECT_FALSE(many.filter.asks({10, 11}));
  EXPECT_TRUE(many.filter.asks({1, 11}));
  EXPECT_TRUE(load("fixed_pairs = true\n" + wall).filter.rests.empty());
}

// Each mutation is refused with the file's name, or is a scene.
TEST_F(RobotScenes, SurviveMutatedFiles) {
  const std::string scene =
      "import = \"crane.urdf\"\nobstacles = \"problem.yaml\"\nconfigurations = \"request.yaml\"\n";
  folder_.write("scene.toml", scene);
  const std::string srdf =
      "<robot name=\"crane\"><disable_collisions link1=\"boom\" link2=\"lift\"/>"
      "<group_state name=\"up\" group=\"all\"><joint name=\"rise\" "
      "value=\"1\"/></group_state></robot>";
  const std::map<std::string, std::string> originals = {{"crane.urdf", crane_urdf},
                                                        {"crane.srdf", srdf},
                                                        {"problem.yaml", problem_scene},
                                                        {"request.yaml", problem_request}};
  const std::string alphabet = "<>/\"'=:{}[],-.# \n\t&*!|%09aex\x80\xff";
  base::Random random(11);
  for (const auto& [name, text] : originals) {
    for (const auto& [other, content] : originals) folder_.write(other, content);
    int refused = 0, read = 0;
    for (int round = 0; round < 500; ++round) {
      std::string mutated = text;
      for (std::uint64_t k = 0, count = 1 + random.below(3); k < count; ++k) {
        const std::size_t at = random.below(mutated.size());
        const char letter = alphabet[random.below(alphabet.size())];
        switch (random.below(4)) {
          case 0: mutated[at] = letter; break;
          case 1: mutated.insert(at, 1, letter); break;
          case 2: mutated.erase(at, 1 + random.below(8)); break;
          default: mutated.insert(at, mutated.substr(random.below(mutated.size()), 20)); break;
        }
      }
      folder_.write(name, mutated);
      const std::string fault =
          input_fault([&] { scene::load_scene(folder_.path() / "scene.toml"); });
      ++(fault.empty() ? read : refused);
      if (!fault.empty()) {
        EXPECT_THAT(fault, HasSubstr(folder_.path().string())) << mutated;
      }
    }
    EXPECT_GT(refused, 50) << name;
    EXPECT_GT(read, 5) << name;
  }
}

TEST_F(RobotScenes, StandBesideOtherFiles) {
  folder_.write(
      "cell.toml",
      "ignore = [[\"door\", \"door\"]]\n"
      "[[body]]\nname = \"door\"\nshape = {type = \"sphere\", radius = 1}\nvelocity = [1, 0, 0]\n"
      "[[body]]\nname = \"door\"\nshape = {type = \"sphere\", radius = 1}\n");
  const auto load_both = [&](const std::string& imports, const std::string& rest) {
    return scene::load_scene(folder_.write(
        "scene.toml", "import = " + imports + "\nconfigurations = {random = 3}\n" + rest));
  };
  const scene::Scene scene = load_both("[\"crane.urdf\", \"cell.toml\"]", "time_step = 1\n");
  EXPECT_THAT(scene.names, testing::ElementsAre("foot", "boom", "lift", "door", "door"));
  EXPECT_EQ(places(scene, 3)[2], Vec3d(2, 0, 0));
  EXPECT_FALSE(scene.filter.asks({3, 4}));
  EXPECT_TRUE(scene.filter.asks({2, 4}));
  const scene::Scene behind = load_both("[\"cell.toml\", \"crane.urdf\"]", "moving = false\n");
  EXPECT_THAT(behind.tracks.bodies, testing::ElementsAre(2, 3, 4));
  EXPECT_FALSE(behind.bodies[0].moving);
  EXPECT_TRUE(behind.bodies[3].moving);
  EXPECT_EQ(places(behind, 3)[1], places(scene, 1)[1]);
  EXPECT_FALSE(behind.filter.asks({2, 3})) << "joined";
  EXPECT_THAT(input_fault([&] { load_both("[\"crane.urdf\", \"crane.urdf\"]", ""); }),
              HasSubstr("a second robot"));
}

TEST_F(RobotScenes, HoldMoreThanARobot) {
  // A file that imports itself ends.
  folder_.write("self.toml",
                "import = \"self.toml\"\n[[body]]\nshape = {type = \"sphere\", radius = 1}\n");
  EXPECT_THAT(input_fault([&] { scene::load_scene(folder_.path() / "self.toml"); }),
              HasSubstr("perhaps by itself"));
  // The frames are the robot's, also beside more of them.
  folder_.write("long.toml", "frames = 30\ngenerator = \"uniform\"\ncount = 4\n");
  folder_.write("churn.toml", "generator = \"uniform\"\ncount = 40\nchurn = 0.5\n");
  const auto load_with = [&](const std::string& other) {
    return scene::load_scene(folder_.write(
        "scene.toml",
        "import = [\"" + other + "\", \"crane.urdf\"]\nconfigurations = {random = 5}\n"));
  };
  EXPECT_EQ(load_with("long.toml").frames, 5);
  EXPECT_THAT(input_fault([&] { load_with("churn.toml"); }),
              HasSubstr("expected bodies that stay"));
  // Fixed pairs are left out whatever comes first.
  folder_.write("fixed.toml",
                "moving = false\n[[body]]\nshape = {type = \"sphere\", radius = 1}\n"
                "[[body]]\nshape = {type = \"sphere\", radius = 1}\n");
  EXPECT_FALSE(load_with("fixed.toml").filter.asks({0, 1}));
  EXPECT_TRUE(load_with("fixed.toml").filter.asks({0, 3}));
  // A seed may be the generator's.
  const std::string beside = "generator = \"uniform\"\ncount = 4\n";
  EXPECT_NE(scene::scene_hash(load(beside, {.seed = 2})),
            scene::scene_hash(load(beside, {.seed = 3})));
}

TEST_F(RobotScenes, RefuseWhatHasNoEffect) {
  folder_.write("path.csv", "turn\n0\n");
  EXPECT_THAT(fault("held = [\"turn\"]\nconfigurations = \"path.csv\"\n"),
              HasSubstr("expected none"));
  EXPECT_THAT(fault("configurations = {file = \"path.csv\", steps = 3}\n"), HasSubstr("steps"));
  EXPECT_THAT(fault("configurations = {walk = 3, step = 0.1}\njoints = {rise = 7}\n"),
              HasSubstr("rise = 7, where a walk begins; expected 0 to 1"));
  EXPECT_THAT(fault("joints = {rise = 1e30}\n"), HasSubstr("rise"));
  folder_.write("path.csv", "rise\n1e10\n");
  EXPECT_THAT(fault("configurations = \"path.csv\"\n"), HasSubstr("expected a number from"));
  const auto with = [&](const std::string& rest) {
    folder_.write("problem.yaml", std::string(problem_scene) + rest);
    return fault("obstacles = \"problem.yaml\"\n");
  };
  EXPECT_EQ(with("link_padding: [{link_name: boom, padding: 0}]\n"), "");
  EXPECT_THAT(with("link_padding: [{link_name: boom, padding: 0.1}]\n"), HasSubstr("found 0.1"));
  EXPECT_THAT(with("link_scale: [{link_name: boom, scale: 1.1}]\n"), HasSubstr("found 1.1"));
}

TEST_F(RobotScenes, TurnContinuousJointsTheShorterWay) {
  std::string urdf = crane_urdf;
  urdf.replace(urdf.find("revolute"), 8, "continuous");
  folder_.write("crane.urdf", urdf);
  std::string request = problem_request;
  request.replace(request.find("position: [0,"), 13, "position: [3,");
  request.replace(request.find("position: 1.5"), 13, "position: -3.0");
  folder_.write("request.yaml", request);
  const auto boom = places(load("configurations = {file = \"request.yaml\", steps = 2}\n"), 1);
  EXPECT_LT((boom[1] - Vec3d(-1, 0, 0)).norm(), 1e-14);
  EXPECT_LT((boom[2] - Vec3d(std::cos(-3.0), std::sin(-3.0), 0)).norm(), 1e-14);
}

TEST(RobotDatasets, AreWhatTheyWere) {
  const std::map<std::string, std::string> hashes = {{"arm", "eae3eb4cd22c770d"},
                                                     {"walker", "792afd2a66f12234"}};
  for (const auto& [name, hash] : hashes) {
    const scene::Scene scene = scene::load_scene(std::filesystem::path(project_folder) /
                                                 "datasets/robots" / (name + ".toml"));
    EXPECT_EQ(scene::scene_hash(scene), hash) << name;
  }
}

}  // namespace
}  // namespace touchstone
