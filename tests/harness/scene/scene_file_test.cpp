#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "harness/base/error.h"
#include "harness/scene/box_frames.h"
#include "harness/scene/player.h"
#include "harness/scene/scene.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class SceneFile : public testing::Test {
 protected:
  scene::Scene load(const std::string& content, const scene::SceneOverrides& overrides = {}) {
    return scene::load_scene(folder_.write("scene.toml", content), overrides);
  }
  // The message, or nothing where there is no fault.
  std::string fault(const std::string& content, const scene::SceneOverrides& overrides = {}) {
    return input_fault([&] { load(content, overrides); });
  }
  std::string at(int line) const {
    return (folder_.path() / "scene.toml").string() + ":" + std::to_string(line) + ": ";
  }

  TemporaryFolder folder_;
};

constexpr const char* ball = "[[body]]\nshape = {type = \"sphere\", radius = 1}\n";

TEST_F(SceneFile, ReadsListedBodies) {
  const scene::Scene scene = load(
      "name = \"three\"\n"
      "frames = 4\n"
      "time_step = 0.5\n"
      "[shapes.ball]\n"
      "type = \"sphere\"\n"
      "radius = 2\n"
      "[[body]]\n"
      "shape = \"ball\"\n"
      "translation = [1, 2.5, -3]\n"
      "velocity = [1, 0, 0]\n"
      "[[body]]\n"
      "shape = \"ball\"\n"
      "moving = false\n"
      "[[body]]\n"
      "shape = {type = \"halfspace\", normal = [0, 0, 2], offset = 1}\n");
  EXPECT_EQ(scene.name, "three");
  EXPECT_EQ(scene.frames, 4);
  EXPECT_EQ(scene.motion.time_step, 0.5);
  ASSERT_EQ(scene.bodies.size(), 3u);
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_EQ(scene.bodies[0].shape, scene.bodies[1].shape);
  EXPECT_EQ(scene.bodies[0].pose.translation, Vec3d(1, 2.5, -3));
  EXPECT_EQ(scene.bodies[0].velocity, Vec3d(1, 0, 0));
  EXPECT_TRUE(scene.bodies[0].moving);
  EXPECT_FALSE(scene.bodies[1].moving);
  EXPECT_FALSE(scene.bodies[2].moving) << "a half-space stays unless it is told to move";
  EXPECT_EQ(scene.shapes[1].normal, Vec3d(0, 0, 2));
}

TEST_F(SceneFile, NameAndFramesHaveDefaults) {
  const scene::Scene scene = load(ball);
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.frames, 1);
  EXPECT_EQ(scene.motion.kind, scene::MotionKind::inertial);
}

TEST_F(SceneFile, ReadsEveryShape) {
  const scene::Scene scene = load(
      "body = [\n"
      "{shape = {type = \"sphere\", radius = 0}},\n"
      "{shape = {type = \"capsule\", radius = 1, half_length = 2}},\n"
      "{shape = {type = \"box\", half_extents = [1, 0, 3]}},\n"
      "{shape = {type = \"cylinder\", radius = 1, half_length = 2}},\n"
      "{shape = {type = \"cone\", radius = 1, half_length = 2}},\n"
      "{shape = {type = \"ellipsoid\", radii = [1, 2, 3]}},\n"
      "{shape = {type = \"hull\", vertices = [[0, 0, 0], [1, 0, 0]]}},\n"
      "{shape = {type = \"halfspace\", normal = [1, 0, 0], offset = -1}},\n"
      "]\n");
  ASSERT_EQ(scene.shapes.size(), all_shape_kinds.size());
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    EXPECT_EQ(scene.shapes[i].kind, all_shape_kinds[i]);
  }
  EXPECT_EQ(scene.shapes[2].half_extents, Vec3d(1, 0, 3));
  EXPECT_EQ(scene.shapes[5].radii, Vec3d(1, 2, 3));
  EXPECT_EQ(scene.shapes[6].hull->vertices.size(), 2u);
}

// A cone's tip tells its axis and its sense.
TEST_F(SceneFile, FoldsTheAxisIntoTheRotationExactly) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const scene::Scene scene =
        load("[[body]]\nshape = {type = \"cone\", radius = 1, half_length = 2, axis = \"" + name +
             "\"}\nrotation = [0, -1, 0, 1, 0, 0, 0, 0, 1]\n");
    Mat3d turn;
    turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    const Vec3d tip = scene.bodies[0].pose.rotation * Vec3d(0, 0, 2);
    EXPECT_EQ(tip, turn * (2 * Vec3d::Unit(axis))) << name;
    EXPECT_EQ(scene.bodies[0].pose.rotation.determinant(), 1) << name;
  }
}

TEST_F(SceneFile, NormalisesQuaternions) {
  for (const std::string size : {"1", "1e-200", "1e200"}) {
    const scene::Scene scene =
        load(std::string(ball) + "quaternion_wxyz = [" + size + ", 0, 0, " + size + "]\n");
    const Vec3d turned = scene.bodies[0].pose.rotation * Vec3d(1, 0, 0);
    EXPECT_EQ(turned, Vec3d(0, 1, 0)) << size;
  }
}

TEST_F(SceneFile, MeshesAreHullsAndShared) {
  folder_.write("block.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0.1 0.1 0.1\nf 1 2 3\nf 1 2 4\nf 1 5 4\n");
  const scene::Scene scene = load(
      "body = [\n"
      "{mesh = \"block.obj\"},\n"
      "{mesh = \"block.obj\", translation = [5, 0, 0]},\n"
      "{mesh = \"./block.obj\", scale = 2},\n"
      "{mesh = \"block.obj\", scale = [1, 2, 3]},\n"
      "]\n");
  ASSERT_EQ(scene.shapes.size(), 3u);
  EXPECT_EQ(scene.bodies[0].shape, scene.bodies[1].shape);
  EXPECT_EQ(scene.shapes[0].hull->vertices.size(), 4u) << "the inner point is left out";
  double tallest = 0;
  for (const Vec3d& v : scene.shapes[2].hull->vertices) tallest = std::max(tallest, v.z());
  EXPECT_EQ(tallest, 3);
  EXPECT_THAT(fault("[[body]]\n\nmesh = \"none.obj\"\n"), StartsWith(at(3)));
}

TEST_F(SceneFile, PolytopesTakeThePlaceOfPrimitives) {
  const scene::Scene scene = load(
      "polytope = 1\n"
      "body = [{shape = {type = \"sphere\", radius = 1}},\n"
      "{shape = {type = \"halfspace\", normal = [0, 0, 1], offset = 0}}]\n");
  ASSERT_EQ(scene.shapes[0].kind, ShapeKind::hull);
  EXPECT_EQ(scene.shapes[0].hull->vertices.size(), 42u);
  EXPECT_EQ(scene.shapes[1].kind, ShapeKind::halfspace);
}

TEST_F(SceneFile, ImportsRecordings) {
  scene::BoxRecording recording{"s", "t", {{0, 0, 0}, {4, 4, 4}}, {}};
  for (float f = 0; f < 3; ++f) {
    recording.frames.push_back({{{f, 0, 0}, {f + 1, 1, 1}}, {{2, 2, 2}, {3, 3, 3}}});
  }
  scene::write_aabbs(recording, folder_.path() / "r.aabbs");
  EXPECT_EQ(scene::load_scene(folder_.path() / "r.aabbs").recording, recording.frames);
  EXPECT_EQ(scene::load_scene(folder_.path() / "r.aabbs").name, "r");
  const std::string imported = "import = \"r.aabbs\"\nframes = 2\n";
  EXPECT_EQ(load(imported).recording.size(), 2u);
  EXPECT_EQ(load(imported, {.frames = 3}).recording.size(), 3u);
  EXPECT_THAT(fault(imported, {.frames = 4}), HasSubstr("expected 1 to 3"));
  EXPECT_THAT(fault("import = \"r.aabbs\"\n\nframes = 4\n"), StartsWith(at(3)));
  EXPECT_THAT(fault("import = \"r.aabbs\"\nmotion = \"inertial\"\n"),
              AllOf(StartsWith(at(2)), HasSubstr("unknown key motion")));
  EXPECT_THAT(fault(imported, {.count = 5}), HasSubstr("count"));
  EXPECT_THAT(fault(imported, {.seed = 5}), HasSubstr("seed"));
}

// `shapes` is the generator's list, or the table of what bodies name.
TEST_F(SceneFile, ListsBodiesBesideAGeneratorWithShapes) {
  const scene::Scene scene = load(
      "generator = \"uniform\"\ncount = 20\nshapes = [\"sphere\", {type = \"hull\", points = "
      "9}]\n[[body]]\nshape = {type = \"box\", half_extents = [1, 2, 3]}\n");
  ASSERT_EQ(scene.bodies.size(), 21u);
  EXPECT_EQ(scene.shapes[scene.bodies[0].shape].kind, ShapeKind::box);
  EXPECT_NE(scene.shapes[scene.bodies[20].shape].kind, ShapeKind::box);
}

TEST_F(SceneFile, OverridesReplaceWhatTheFileSays) {
  const std::string generated = "generator = \"uniform\"\ncount = 20\nseed = 3\nframes = 2\n";
  EXPECT_EQ(load(generated, {.count = 50}).bodies.size(), 50u);
  EXPECT_EQ(load(generated, {.frames = 7}).frames, 7);
  EXPECT_NE(scene::scene_hash(load(generated, {.seed = 4})), scene::scene_hash(load(generated)));
  EXPECT_EQ(scene::scene_hash(load(generated, {.seed = 3})), scene::scene_hash(load(generated)));
  EXPECT_NE(fault(generated, {.count = 0}), "");
  EXPECT_NE(fault(generated, {.count = -2}), "");
  EXPECT_NE(fault(generated, {.frames = 0}), "");
  EXPECT_NE(fault(ball, {.count = 2}), "");
  EXPECT_NE(fault(ball, {.seed = 2}), "");
  EXPECT_EQ(load(ball, {.frames = 9}).frames, 9);
  EXPECT_EQ(fault("motion = \"brownian\"\n" + std::string(ball), {.seed = 2}), "");
}

struct Fault {
  const char* content;
  int line;
  const char* says;
};

class SceneFault : public SceneFile, public testing::WithParamInterface<Fault> {};

TEST_P(SceneFault, NamesFileLineAndWhatWasExpected) {
  const Fault& expected = GetParam();
  EXPECT_THAT(fault(expected.content),
              AllOf(StartsWith(at(expected.line)), HasSubstr(expected.says), HasSubstr("expected")))
      << expected.content;
}

INSTANTIATE_TEST_SUITE_P(
    Toml, SceneFault,
    testing::Values(
        Fault{"a = 1\nb = = 2\n", 2, "TOML"},  //
        Fault{"a = 1\n\na = 2\n", 3, "TOML"},  //
        Fault{"frames = 2\n", 1, "generator"},
        Fault{"\ngenerator = \"pairs\"\n[[body]]\nshape = {type = \"sphere\", radius = 1}\n", 2,
              "expected it alone"},
        Fault{"generator = \"uniform\"\ncuont = 3\n", 2, "unknown key cuont; expected one of"},
        Fault{"frames = 2\ngenerator = \"unifrom\"\n", 2,
              "found \"unifrom\"; expected one of uniform, clustered, mixed, city, "
              "stack, ground, terrain, chain, "
              "brownian, free_fall, rotating_gravity"},
        Fault{"generator = 3\n", 1, "found 3; expected one of"},
        Fault{"import = \"x.json\"\n", 1, "no file"}, Fault{"import = 1\n", 1, "texts"}));

INSTANTIATE_TEST_SUITE_P(
    Generators, SceneFault,
    testing::Values(
        Fault{"generator = \"uniform\"\ncount = 0\n", 2, "found 0; expected a whole number from 1"},
        Fault{"generator = \"uniform\"\ncount = 1.5\n", 2, "a whole number"},
        Fault{"generator = \"uniform\"\ncount = \"many\"\n", 2, "found \"many\""},
        Fault{"generator = \"uniform\"\nframes = 0\n", 2, "found 0"},
        Fault{"generator = \"uniform\"\nseed = -1\n", 2, "found -1"},
        Fault{"generator = \"uniform\"\ntime_step = 0\n", 2, "time_step"},
        Fault{"generator = \"uniform\"\ntime_step = nan\n", 2, "found nan"},
        Fault{"generator = \"uniform\"\nmoving = 1.5\n", 2, "from 0 to 1"},
        Fault{"generator = \"uniform\"\nspeed = -1\n", 2, ">= 0"},
        Fault{"generator = \"uniform\"\nspeed = inf\n", 2, "found inf"},
        Fault{"generator = \"uniform\"\nsize = [2, 1]\n", 2, "min <= max"},
        Fault{"generator = \"uniform\"\nsize = 0\n", 2, "> 0"},
        Fault{"generator = \"uniform\"\nsize = [1, 2, 3]\n", 2, "array of 2"},
        Fault{"generator = \"uniform\"\naspect = 2\n", 2, "to 1"},
        Fault{"generator = \"uniform\"\ncount = 10\noverlaps = 9\n", 3, "cannot have so many"},
        Fault{"generator = \"uniform\"\noverlaps = 1\ndensity = 1\n", 2, "one of the two"},
        Fault{"generator = \"uniform\"\nshapes = []\n", 2, "at least one"},
        Fault{"generator = \"uniform\"\nshapes = [\"bax\"]\n", 2,
              "found \"bax\"; expected one of sphere, capsule, box"},
        Fault{"generator = \"uniform\"\nshapes = [\"box\",\n\"halfspace\"]\n", 3, "halfspace"},
        Fault{"generator = \"uniform\"\nshapes = [{type = \"sphere\", radius = -1}]\n", 2,
              "found -1; expected a number >= 0"},
        Fault{"generator = \"uniform\"\nshapes = [{type = \"sphere\", weight = 0}]\n", 2, "weight"},
        Fault{"generator = \"uniform\"\nshapes = [{type = \"sphere\", points = 9}]\n", 2,
              "unknown key points"},
        Fault{"generator = \"uniform\"\nmotion = \"still\"\n", 2,
              "inertial, brownian, free_fall, rotating_gravity"},
        Fault{"generator = \"uniform\"\nacceleration = 1\n", 2, "unknown key acceleration"},
        Fault{"generator = \"city\"\noverlaps = 1\n", 2, "unknown key overlaps"},
        Fault{"generator = \"ground\"\ndensity = 1\n", 2, "unknown key density"},
        Fault{"generator = \"stack\"\nheight = 0\n", 2, "height"},
        Fault{"generator = \"clustered\"\nclusters = 0\n", 2, "clusters"},
        Fault{"generator = \"uniform\"\npolytope = 6\n", 2, "from 0 to 5"}));

INSTANTIATE_TEST_SUITE_P(
    Bodies, SceneFault,
    testing::Values(
        Fault{"frames = 1\nbody = []\n", 2, "at least one"}, Fault{"body = 3\n", 1, "[[body]]"},
        Fault{"body = [3]\n", 1, "a table"},
        Fault{"frames = 1\n\n[[body]]\ntranslation = [0, 0, 0]\n", 3, "shape: missing"},
        Fault{"[[body]]\nshape = {type = \"sphere\"}\n", 2, "radius: missing"},
        Fault{"[[body]]\nshape = {type = \"sphere\", radius = -1}\n", 2, "found -1"},
        Fault{"[[body]]\nshape = {type = \"sphere\", radius = nan}\n", 2, "found nan"},
        Fault{"[[body]]\nshape = {type = \"sphere\", radius = 1, half_length = 2}\n", 2,
              "unknown key half_length"},
        Fault{"[[body]]\nshape = {type = \"ball\", radius = 1}\n", 2, "found \"ball\""},
        Fault{"[[body]]\nshape = {type = \"cone\", radius = 1, half_length = 1, axis = \"w\"}\n", 2,
              "one of x, y, z"},
        Fault{"[[body]]\nshape = {type = \"hull\", vertices = []}\n", 2, "at least one point"},
        Fault{"[[body]]\nshape = {type = \"hull\", vertices = [[0, 0]]}\n", 2, "3 numbers"},
        Fault{"[[body]]\nshape = {type = \"halfspace\", normal = [0, 0, 0], offset = 0}\n", 2,
              "not zero"},
        Fault{"[shapes.ball]\ntype = \"sphere\"\nradius = 1\n[[body]]\nshape = \"bal\"\n", 5,
              "expected one of the names in [shapes]: ball"},
        Fault{"[shapes.ball]\ntype = \"sphere\"\nradius = 1\nlength = 1\n[[body]]\nshape = "
              "\"ball\"\n",
              4, "unknown key length"},
        Fault{"[[body]]\nshape = {type = \"sphere\", radius = 1}\ntranslation = [0, 0]\n", 3,
              "array of 3"},
        Fault{"[[body]]\nshape = {type = \"sphere\", radius = 1}\ntranslation = [0, 0, inf]\n", 3,
              "found inf"},
        Fault{"[[body]]\nshape = {type = \"sphere\", radius = 1}\nrotation = [1, 0, 0]\n", 3,
              "array of 9"},
        Fault{"[[body]]\nshape = {type = \"sphere\", radius = 1}\nrotation = [2, 0, 0, 0, 1, 0, 0, "
              "0, 1]\n",
              3, "orthonormal"},
        Fault{"[[body]]\nshape = {type = \"sphere\", radius = 1}\nquaternion_wxyz = [0, 0, 0, 0]\n",
              3, "not zero"},
        Fault{"[[body]]\nshape = {type = \"sphere\", radius = 1}\nquaternion_wxyz = [1, 0, 0, "
              "0]\nrotation = [1, 0, 0, 0, 1, 0, 0, 0, 1]\n",
              3, "one of the two"},
        Fault{"[[body]]\nshape = {type = \"sphere\", radius = 1}\nmoving = 1\n", 3,
              "true or false"},
        Fault{"[[body]]\nshape = {type = \"sphere\", radius = 1}\n[[body]]\nshape = {type = "
              "\"sphere\", radius = 1e39}\n",
              3, "in float"},
        Fault{"wall_min = [0, 0, 0]\nwall_max = [1, -1, 1]\n[[body]]\nshape = {type = \"sphere\", "
              "radius = 1}\n",
              2, "min <= max"},
        Fault{"wall_min = [0, 0, 0]\n[[body]]\nshape = {type = \"sphere\", radius = 1}\n", 1,
              "wall_max: missing"},
        Fault{"wall_min = [0, 0, 0]\nwall_max = [1, 1, 1]\n[[body]]\nshape = {type = \"sphere\", "
              "radius = 1}\ntranslation = [0, 2, 0]\n",
              3, "between the walls"}));

TEST_F(SceneFile, FilesOfOtherKindsAreRefused) {
  EXPECT_THROW(scene::load_scene(folder_.path() / "none.toml"), base::InputError);
  EXPECT_THROW(scene::load_scene(folder_.path()), base::InputError);
  EXPECT_THROW(scene::load_scene(folder_.write("scene.xml", "<a/>")), base::InputError);
}

}  // namespace
}  // namespace touchstone
