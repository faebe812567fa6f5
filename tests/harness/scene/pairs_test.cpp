#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/oracle/oracle.h"
#include "harness/scene/player.h"
#include "harness/scene/scene.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

scene::Scene load_pairs(const std::string& content, const scene::SceneOverrides& overrides = {}) {
  const TemporaryFolder folder;
  return scene::load_scene(folder.write("scene.toml", "generator = \"pairs\"\n" + content),
                           overrides);
}

oracle::Enclosure exact_distance(const scene::Scene& scene, const IndexPair& pair) {
  const scene::Body& a = scene.bodies[pair.a];
  const scene::Body& b = scene.bodies[pair.b];
  const oracle::Solid solid_a(scene.shapes[a.shape]), solid_b(scene.shapes[b.shape]);
  oracle::Oracle oracle;
  const auto found = oracle.measure({solid_a, a.pose}, {solid_b, b.pose});
  return {found.lower, found.upper};
}

TEST(Pairs, GapsAreExactForEveryKind) {
  const double gaps[] = {1e-4, 0.01, 0.5, 20};
  for (const char* kind : {"sphere", "box", "capsule", "cylinder", "cone", "ellipsoid", "hull"}) {
    const scene::Scene scene =
        load_pairs(std::string("count = 48\ngaps = [1e-4, 0.01, 0.5, 20]\nshapes = [\"") + kind +
                   "\", \"box\"]\n");
    ASSERT_EQ(scene.pairs.size(), 24u) << kind;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      EXPECT_EQ(scene.pairs[i], (IndexPair{static_cast<std::uint32_t>(2 * i),
                                           static_cast<std::uint32_t>(2 * i + 1)}));
      const oracle::Enclosure distance = exact_distance(scene, scene.pairs[i]);
      // The margin is the rounding of coordinates of some hundred metres.
      EXPECT_NEAR(distance.lower, gaps[i % 4], 1e-12) << kind << " " << i;
      EXPECT_NEAR(distance.upper, gaps[i % 4], 1e-12) << kind << " " << i;
    }
  }
}

TEST(Pairs, DepthsAreAtMostWhatIsAsked) {
  const scene::Scene scene =
      load_pairs("count = 200\ngaps = [-0.001, -0.05]\nshapes = [\"ellipsoid\"]\n");
  int overlapping = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const double depth = i % 2 == 0 ? 0.001 : 0.05;
    const oracle::Enclosure distance = exact_distance(scene, scene.pairs[i]);
    EXPECT_GE(distance.upper, -depth * (1 + 1e-9)) << i;
    overlapping += distance.upper < 0;
  }
  EXPECT_EQ(overlapping, 100);
}

TEST(Pairs, SettledOnesAreAsFarApartOrAsDeepAsAsked) {
  for (const double gap : {0.1, 1e-3, -1e-3, -0.1}) {
    const scene::Scene scene = load_pairs(
        "count = 60\nshapes = [\"sphere\", \"box\", \"capsule\", \"hull\"]\nsize = [0.5, 1.0]\n"
        "aspect = 0.5\nplacement = \"settled\"\n",
        {.gap = gap});
    ASSERT_EQ(scene.pairs.size(), 30u);
    for (const IndexPair& pair : scene.pairs) {
      const oracle::Enclosure distance = exact_distance(scene, pair);
      EXPECT_NEAR(distance.lower, gap, 2e-6 * std::abs(gap));
      EXPECT_NEAR(distance.upper, gap, 2e-6 * std::abs(gap));
    }
  }
}

TEST(Pairs, BodiesThatRestAreAtContact) {
  for (const std::string placement : {"stacked", "turned", "tumbled", "wall", "floor"}) {
    for (const std::string shapes : {"\"box\"", "\"box\", {type = \"hull\", points = 8}"}) {
      if (placement == "wall" && shapes.size() > 6) continue;
      const std::string content =
          "count = 80\nshapes = [" + shapes + "]\nplacement = \"" + placement + "\"\n";
      SCOPED_TRACE(content);
      const scene::Scene scene = load_pairs(content, {.gap = 0}),
                         lifted = load_pairs(content, {.gap = 0.25});
      ASSERT_EQ(scene.pairs.size(), 40u);
      int exact = 0;
      for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
        const oracle::Enclosure distance = exact_distance(scene, scene.pairs[i]);
        EXPECT_NEAR(distance.lower, 0, 1e-13);
        exact += distance.lower == 0 && distance.upper == 0;
        EXPECT_NEAR(exact_distance(lifted, lifted.pairs[i]).lower, 0.25, 1e-12);
      }
      const bool level = placement == "stacked" || placement == "wall";
      if (level && shapes.size() < 6) {
        EXPECT_EQ(exact, 40);
      }
    }
  }
  EXPECT_THAT(input_fault([&] { load_pairs("shapes = [\"cone\"]\nplacement = \"wall\"\n"); }),
              testing::HasSubstr("expected only these"));
}

TEST(Pairs, AGapFromOutsideReplacesThoseOfTheFileAndIsInTheName) {
  const std::string content = "count = 20\ngaps = [0.5, 20]\n";
  const scene::Scene near = load_pairs(content, {.gap = 0.25}),
                     deep = load_pairs(content, {.gap = -0.01});
  EXPECT_EQ(load_pairs(content).name, "scene");
  EXPECT_EQ(near.name, "scene gap 0.25");
  EXPECT_EQ(deep.name, "scene depth 0.01");
  for (const IndexPair& pair : near.pairs) {
    EXPECT_NEAR(exact_distance(near, pair).lower, 0.25, 1e-12);
  }
  EXPECT_NE(scene::scene_hash(near), scene::scene_hash(deep));
}

TEST(Pairs, ListedPairsAreOfTheSceneAndItsHash) {
  const scene::Scene scene = load_pairs("count = 20\n");
  EXPECT_EQ(scene.frames, 1);
  scene::Scene other = scene;
  other.pairs.pop_back();
  EXPECT_NE(scene::scene_hash(scene), scene::scene_hash(other));
  EXPECT_EQ(scene::scene_hash(scene), scene::scene_hash(load_pairs("count = 20\n")));
  EXPECT_NE(scene::scene_hash(scene), scene::scene_hash(load_pairs("count = 20\n", {.seed = 9})));
}

TEST(Pairs, RadiiAreDrawnFromANormalDistribution) {
  const scene::Scene scene = load_pairs(
      "count = 4000\ndistinct = 4000\n"
      "shapes = [{type = \"ellipsoid\", radii_normal = {mean = 0.1, deviation = 0.025}}]\n");
  double sum = 0, squares = 0;
  for (const Shape& shape : scene.shapes) {
    for (const double radius : shape.radii) {
      EXPECT_GE(radius, 0.005);
      sum += radius;
      squares += (radius - 0.1) * (radius - 0.1);
    }
  }
  EXPECT_NEAR(sum / 12'000, 0.1, 6 * 0.025 / std::sqrt(12'000));
  EXPECT_NEAR(std::sqrt(squares / 12'000), 0.025, 0.001);
}

TEST(Pairs, BadRequestsAreRefused) {
  using testing::HasSubstr;
  const auto refusal = [](const std::string& content) {
    return input_fault([&] { load_pairs(content); });
  };
  EXPECT_THAT(refusal("count = 7\n"), HasSubstr("expected an even one"));
  EXPECT_THAT(refusal("placement = \"near\"\n"), HasSubstr("placement"));
  // Spheres of half a metre are not that deep in each other.
  EXPECT_THAT(refusal("count = 2\nshapes = [\"sphere\"]\nsize = [0.5, 0.5]\ngaps = [-2]\n"
                      "placement = \"settled\"\n"),
              HasSubstr("no place found for bodies 0 and 1"));
  EXPECT_THAT(refusal("gaps = []\n"), HasSubstr("expected an array of signed distances"));
  EXPECT_THAT(refusal("gaps = [0.1, \"x\"]\n"), HasSubstr("expected an array of signed distances"));
  EXPECT_THAT(refusal("gaps = [nan]\n"), HasSubstr("expected an array of signed distances"));
  EXPECT_THAT(
      refusal("shapes = [{type = \"ellipsoid\", radii_normal = {mean = -1, deviation = 0}}]\n"),
      HasSubstr("mean"));
  EXPECT_THAT(refusal("shapes = [{type = \"box\", radii_normal = {mean = 1, deviation = 0}}]\n"),
              HasSubstr("radii_normal"));
  const TemporaryFolder folder;
  const auto without_gaps = [&](const std::string& other) {
    return input_fault([&] { scene::load_scene(folder.write("other.toml", other), {.gap = 0.1}); });
  };
  EXPECT_THAT(without_gaps("generator = \"uniform\"\n"), HasSubstr("a gap of 0.1 was asked for"));
  EXPECT_THAT(without_gaps("[[body]]\nshape = {type = \"sphere\", radius = 1}\n"),
              HasSubstr("a gap of 0.1 was asked for"));
}

TEST(Pairs, SwayingOnesStayAboutAsFarApart) {
  for (const double gap : {0.1, 1e-3, 1e-6, -1e-3, -0.1}) {
    const scene::Scene scene = load_pairs(
        "count = 40\nshapes = [\"box\", \"ellipsoid\", {type = \"hull\", points = 30}]\n"
        "placement = \"meeting\"\nsway = 0.2\nframes = 21\n",
        {.gap = gap});
    oracle::Oracle oracle;
    scene::ScenePlayer player(scene, scene::BoxKind::tight);
    std::vector<Pose> before(player.poses().begin(), player.poses().end());
    int near = 0, all = 0, on_its_side = 0, moved = 0;
    do {
      const bool middle = player.frame() == 10;
      for (const IndexPair& pair : scene.pairs) {
        const oracle::Solid a(scene.shapes[scene.bodies[pair.a].shape]),
            b(scene.shapes[scene.bodies[pair.b].shape]);
        const oracle::Measure found =
            oracle.measure({a, player.poses()[pair.a]}, {b, player.poses()[pair.b]});
        if (middle) {
          EXPECT_NEAR(found.middle(), gap, 2e-6 * std::abs(gap) + 1e-13);
        }
        ++all;
        near += std::abs(found.middle() - gap) <= 0.25 * std::abs(gap);
        on_its_side += (found.middle() > 0) == (gap > 0);
        moved += before[pair.a].rotation != player.poses()[pair.a].rotation &&
                 before[pair.b].translation != player.poses()[pair.b].translation;
      }
      before.assign(player.poses().begin(), player.poses().end());
    } while (player.next());
    EXPECT_GT(near, all * 3 / 4) << gap;
    EXPECT_GT(on_its_side, all * 9 / 10) << gap;
    EXPECT_EQ(moved, all / 21 * 20) << gap;
  }
}

TEST(Pairs, SwayIsRefusedWhereItMakesNoSense) {
  const auto fault = [](const std::string& keys) { return input_fault([&] { load_pairs(keys); }); };
  EXPECT_THAT(fault("count = 2\nsway = -0.1\n"), testing::HasSubstr("scene.toml:3: sway"));
  EXPECT_THAT(fault("count = 2\nsway = 0.1\nmotion = \"brownian\"\n"),
              testing::HasSubstr("motion"));
  EXPECT_THAT(fault("count = 2\nsway = 0.1\nframes = 3\nstep = 0.1\n"), testing::HasSubstr("step"));
  const scene::Scene still = load_pairs("count = 4\nframes = 5\n"),
                     swaying = load_pairs("count = 4\nsway = 0.1\n");
  for (const scene::Body& body : still.bodies) EXPECT_FALSE(body.moving);
  for (const scene::Body& body : swaying.bodies) EXPECT_FALSE(body.moving);  // of one frame
}

}  // namespace
}  // namespace touchstone
