#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "harness/base/error.h"
#include "harness/scene/player.h"
#include "harness/scene/scene.h"
#include "tests/harness/scene/scene_text.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

std::filesystem::path dataset(const std::string& name) {
  return std::filesystem::path(touchstone::project_folder) / "datasets" / (name + ".toml");
}

double mean_overlaps(std::span<const Aabb> boxes) {
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) pairs += overlap(boxes[i], boxes[j]);
  }
  return 2.0 * static_cast<double>(pairs) / static_cast<double>(boxes.size());
}

// The hashes of these scenes, equal on every platform.
TEST(Generators, DatasetsAreWhatTheyWere) {
  const std::map<std::string, std::string> golden = {
      {"uniform", "62069946ce163b47"},
      {"clustered", "12ede422aac410a1"},
      {"mixed", "15d631b7e6dd62ae"},
      {"city", "0070e1cedec151e8"},
      {"stack", "9b8d653c4a32b2ae"},
      {"ground", "cd43a137bfc3aef8"},
      {"brownian", "5df53fc484098e3b"},
      {"free_fall", "f31a3e80f5455641"},
      {"rotating_gravity", "a02e74b6eb64068f"},
  };
  for (const auto& [name, hash] : golden) {
    const scene::Scene scene = scene::load_scene(dataset(name), {.count = 200, .frames = 5});
    EXPECT_EQ(scene.size(), 200u) << name;
    EXPECT_EQ(scene.name, name);
    EXPECT_EQ(scene::scene_hash(scene), hash) << name;
  }
}

// The test skips data sets whose data must be fetched first; they say how.
TEST(Generators, EveryDatasetLoadsAsItStands) {
  for (const auto& entry : std::filesystem::directory_iterator(dataset("x").parent_path())) {
    if (entry.path().extension() != ".toml") continue;
    try {
      const scene::Scene scene = scene::load_scene(entry.path());
      EXPECT_GT(scene.size(), 0u) << entry.path();
    } catch (const base::InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("To get it: "));
    }
  }
}

TEST(Generators, ShapesDatasetHasEveryKind) {
  const scene::Scene scene = scene::load_scene(dataset("shapes"));
  for (const ShapeKind kind : all_shape_kinds) {
    EXPECT_TRUE(std::any_of(scene.shapes.begin(), scene.shapes.end(), [kind](const Shape& shape) {
      return shape.kind == kind;
    })) << to_string(kind);
  }
}

TEST(Generators, TheSeedDecides) {
  for (const std::string name :
       {"uniform", "clustered", "mixed", "city", "ground", "brownian", "rotating_gravity"}) {
    const auto hash = [&](int seed) {
      return scene::scene_hash(load_text("count = 50\ngenerator = \"" + name +
                                         "\"\nseed = " + std::to_string(seed) + "\n"));
    };
    EXPECT_EQ(hash(1), hash(1)) << name;
    EXPECT_NE(hash(1), hash(2)) << name;
  }
}

struct Asked {
  const char* options;
  double overlaps;
  std::size_t first;  // bodies before this one do not count
};

class Overlaps : public testing::TestWithParam<Asked> {};

// The mean over a few seeds, so that chance does not decide.
TEST_P(Overlaps, AreAboutWhatWasAsked) {
  const Asked& asked = GetParam();
  double sum = 0;
  constexpr int seeds = 3;
  for (int seed = 1; seed <= seeds; ++seed) {
    const scene::Scene scene =
        load_text("count = 1000\nframes = 1\nseed = " + std::to_string(seed) +
                  "\noverlaps = " + std::to_string(asked.overlaps) + "\n" + asked.options);
    const scene::ScenePlayer player(scene, scene::BoxKind::tight);
    sum += mean_overlaps(player.boxes().subspan(asked.first)) / seeds;
  }
  EXPECT_NEAR(sum / asked.overlaps, 1, 0.25) << asked.options;
}

INSTANTIATE_TEST_SUITE_P(
    Arrangements, Overlaps,
    testing::Values(
        Asked{"generator = \"uniform\"\n", 0.5, 0}, Asked{"generator = \"uniform\"\n", 5, 0},
        Asked{"generator = \"uniform\"\n", 200, 0},
        Asked{"generator = \"uniform\"\nshapes = [\"cone\", \"hull\", \"capsule\"]\n", 5, 0},
        Asked{"generator = \"clustered\"\n", 5, 0},
        Asked{"generator = \"clustered\"\nclusters = 3\nspread = 0.3\n", 50, 0},
        Asked{"generator = \"mixed\"\n", 5, 0}, Asked{"generator = \"ground\"\n", 2, 1},
        Asked{"generator = \"ground\"\nlayer = 20\n", 10, 1},
        Asked{"generator = \"brownian\"\n", 1, 0}, Asked{"generator = \"free_fall\"\n", 10, 0}));

TEST(Generators, DensityIsBroadmarks) {
  const scene::Scene scene = load_text("generator = \"brownian\"\ncount = 1000\ndensity = 0.125\n");
  EXPECT_NEAR(scene.motion.wall_max.x() - scene.motion.wall_min.x(), 20, 1e-3);
  for (const scene::Body& body : scene.bodies) {
    EXPECT_LE(body.pose.translation.norm(), 9);
    EXPECT_LE(body.velocity.norm(), 15 * (1 + 1e-3));
    EXPECT_EQ(scene.shapes[body.shape].half_extents, Vec3d(0.5, 0.5, 0.5));
  }
  EXPECT_NEAR(
      load_text("generator = \"free_fall\"\ncount = 1000\ndensity = 0.125\n").motion.acceleration,
      1.962, 1e-3);
  const scene::Motion turning =
      load_text("generator = \"rotating_gravity\"\ncount = 1000\ndensity = 0.125\n").motion;
  EXPECT_NEAR(turning.acceleration, 7.848, 1e-2);
  EXPECT_EQ(turning.period, 6.2);
}

TEST(Generators, ExactlyTheAskedShareMoves) {
  for (const std::string share : {"0", "0.25", "0.5", "1"}) {
    for (const std::string name : {"uniform", "ground", "stack", "city"}) {
      const scene::Scene scene = load_text("count = 81\nwalls = true\ngenerator = \"" + name +
                                           "\"\nmoving = " + share + "\n");
      const auto moving = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                        [](const scene::Body& body) { return body.moving; });
      const double of = name == "ground" || name == "city" ? 80 : 81;
      EXPECT_EQ(moving, static_cast<long>(std::floor(of * std::stod(share) + 0.5))) << name;
      scene::ScenePlayer player(scene, scene::BoxKind::tight);
      ASSERT_TRUE(player.next());
      EXPECT_EQ(player.change().moved.size(), static_cast<std::size_t>(moving)) << name << share;
    }
  }
}

TEST(Generators, MixedSizesCoverThreeMagnitudes) {
  const scene::Scene scene =
      load_text("generator = \"mixed\"\ncount = 2000\ndistinct = 2000\nshapes = [\"sphere\"]\n");
  ASSERT_EQ(scene.shapes.size(), 2000u);
  int in_decade[3] = {};
  for (const Shape& shape : scene.shapes) {
    const double size = 2 * shape.radius;
    ASSERT_GE(size, 0.01);
    ASSERT_LE(size, 10);
    ++in_decade[size < 0.1 ? 0 : size < 1 ? 1 : 2];
  }
  for (const int bodies : in_decade) EXPECT_NEAR(bodies, 667, 120);
}

TEST(Generators, MixFollowsTheWeights) {
  const scene::Scene scene = load_text(
      "generator = \"uniform\"\ncount = 4000\ndistinct = 4000\n"
      "shapes = [{type = \"box\", weight = 3}, {type = \"sphere\", radius = 0.5}]\n");
  const auto spheres = std::count_if(
      scene.bodies.begin(), scene.bodies.end(),
      [&](const scene::Body& b) { return scene.shapes[b.shape].kind == ShapeKind::sphere; });
  EXPECT_NEAR(static_cast<double>(spheres), 1000, 120);
  for (const Shape& shape : scene.shapes) {
    if (shape.kind != ShapeKind::sphere) continue;
    EXPECT_EQ(shape.radius, 0.5);
  }
}

TEST(Generators, SizesAndAspectAreKept) {
  const scene::Scene scene = load_text(
      "generator = \"uniform\"\ncount = 500\nsize = [1, 2]\naspect = 0.25\n"
      "shapes = [\"box\", \"ellipsoid\"]\n");
  for (const Shape& shape : scene.shapes) {
    const Vec3d half = shape.kind == ShapeKind::box ? shape.half_extents : shape.radii;
    EXPECT_GE(half.maxCoeff(), 0.5);
    EXPECT_LE(half.maxCoeff(), 1);
    EXPECT_GE(half.minCoeff(), 0.25 * half.maxCoeff());
  }
}

TEST(Generators, StacksTouchFaceToFace) {
  const scene::Scene scene =
      load_text("generator = \"stack\"\ncount = 30\nheight = 10\nmoving = 0\n");
  for (std::size_t i = 0; i + 1 < scene.bodies.size(); ++i) {
    if (i % 10 == 9) continue;
    const Vec3d step = scene.bodies[i + 1].pose.translation - scene.bodies[i].pose.translation;
    EXPECT_EQ(step, Vec3d(0, 0, 1));
  }
  const scene::ScenePlayer player(scene, scene::BoxKind::tight);
  EXPECT_EQ(mean_overlaps(player.boxes()), 2 * 27.0 / 30);
}

TEST(Generators, ACityStandsOnTheGround) {
  const scene::Scene scene = load_text("generator = \"city\"\ncount = 101\n");
  ASSERT_EQ(scene.shapes[scene.bodies[0].shape].kind, ShapeKind::halfspace);
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
    const scene::Body& body = scene.bodies[i];
    EXPECT_EQ(body.pose.translation.z(), scene.shapes[body.shape].half_extents.z());
  }
  const scene::ScenePlayer player(scene, scene::BoxKind::tight);
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
    EXPECT_TRUE(overlap(player.boxes()[0], player.boxes()[i]));
  }
}

TEST(Generators, OneBodyIsAScene) {
  for (const std::string name : {"uniform", "clustered", "mixed", "city", "stack", "ground",
                                 "brownian", "free_fall", "rotating_gravity"}) {
    const scene::Scene scene = load_text("generator = \"" + name + "\"\ncount = 1\n");
    ASSERT_EQ(scene.size(), 1u) << name;
    scene::ScenePlayer player(scene, scene::BoxKind::loose);
    while (player.next()) {
    }
    EXPECT_EQ(player.frame(), 9) << name;
  }
}

}  // namespace
}  // namespace touchstone
