// Casts in lanes: a batch has the answers that its pairs have one by one, whatever lane they are in.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "tests/algorithms/cast/linear_cast.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using namespace reference;

struct MovingBatch {
  std::vector<Shape> shapes;
  std::vector<std::uint32_t> shape_of, first, second;
  std::vector<Pose> poses;
  std::vector<Motion> motions;

  void add(const MovingPairCase& c) {
    for (const bool is_b : {false, true}) {
      (is_b ? second : first).push_back(static_cast<std::uint32_t>(poses.size()));
      shape_of.push_back(static_cast<std::uint32_t>(shapes.size()));
      shapes.push_back(is_b ? c.b : c.a);
      poses.push_back(is_b ? c.pose_b : c.pose_a);
      motions.push_back(is_b ? c.motion_b : c.motion_a);
    }
  }
  std::vector<CastOutcome> solve(Cast& cast) const {
    std::vector<CastOutcome> outcomes(first.size());
    cast.bind(shapes);
    cast.solve({shapes[0].kind, shapes[1].kind, {first, second, shape_of, poses}, motions},
               outcomes);
    return outcomes;
  }
};

bool is_same(double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; }

struct LanesOf {
  const char *lanes, *plain;
  ShapeKind a, b;
};

TEST(CastLanes, AgreeWithOnePairAtATime) {
  Random random(51);
  int hits = 0, misses = 0, asked = 0;
  using enum ShapeKind;
  for (const auto& [lanes_name, plain_name, a, b] :
       {LanesOf{"gjk-ray-cast-lanes", "gjk-ray-cast", sphere, sphere},
        {"gjk-ray-cast-lanes", "gjk-ray-cast", sphere, capsule},
        {"gjk-ray-cast-lanes", "gjk-ray-cast", capsule, capsule},
        {"gjk-ray-cast-lanes", "gjk-ray-cast", box, box},
        {"mpr-ray-cast-lanes", "mpr-ray-cast", hull, hull},
        {"mpr-ray-cast-lanes", "mpr-ray-cast", box, hull}}) {
    const CastEntry &lanes = *registry::find<CastEntry>(lanes_name),
                    &plain = *registry::find<CastEntry>(plain_name);
    MovingBatch batch;
    std::vector<MovingPairCase> cases;
    for (int i = 0; i < drawn(301, 61); ++i) {
      const ContactFeature feature = features[static_cast<std::size_t>(random.below(3))];
      const double path = std::pow(10, random.uniform(-2, 3));
      // Misses, grazes, overlaps at the start and hits in one batch, of all sizes.
      MovingPairCase c = i % 3 == 0 ? meeting(a, b, feature, random.uniform(0, 1), path, random)
                         : i % 3 == 1
                             ? passing(a, b, feature, random.uniform(-0.2, 0.2), path, random)
                             : passing(a, b, feature, i % 2 == 0 ? 1e-13 : 2, path, random);
      if (a == ShapeKind::box && i % 5 == 0) {
        // Edges that are parallel, exactly and nearly.
        c.pose_a.rotation = Mat3d::Identity();
        c.pose_b.rotation =
            Eigen::AngleAxisd(i % 2 == 0 ? 0 : std::pow(10, random.uniform(-17, -4)),
                              Vec3d::UnitZ())
                .toRotationMatrix();
      }
      c = scaled(c, std::ldexp(1, random.below(41) - 20));
      cases.push_back(c);
      batch.add(c);
    }
    const std::vector<CastOutcome> together = batch.solve(*lanes.make({}));
    for (const Isa level : isa_levels()) {
      limit_isa(level);
      const std::vector<CastOutcome> at_level = batch.solve(*lanes.make({}));
      for (std::size_t i = 0; i < cases.size(); ++i) {
        EXPECT_TRUE(is_same(together[i].lower, at_level[i].lower)) << i << to_string(level);
        EXPECT_TRUE(is_same(together[i].upper, at_level[i].upper)) << i << to_string(level);
      }
    }
    limit_isa(isa_of_machine());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      ++asked;
      const CastOutcome alone = solve(lanes, cases[i]);
      EXPECT_EQ(together[i].answer, alone.answer) << i;
      EXPECT_TRUE(is_same(together[i].lower, alone.lower)) << i;
      EXPECT_TRUE(is_same(together[i].upper, alone.upper)) << i;
      const CastOutcome other = solve(plain, cases[i]);
      const CastOutcome exact = solve(*registry::find<CastEntry>("exact"), cases[i]);
      if (exact.answer == CastAnswer::hit) {
        ++hits;
        ASSERT_EQ(alone.answer, CastAnswer::hit) << i << ' ' << cases[i].what;
        EXPECT_LE(alone.lower, exact.upper) << i;
        EXPECT_FALSE(alone.upper < exact.lower) << i;
        // What is proven to be so by one pair at a time is in lanes.
        EXPECT_TRUE(std::isnan(other.upper) || !std::isnan(alone.upper)) << i;
      } else if (exact.answer == CastAnswer::miss) {
        ++misses;
        // A graze that is within the tolerance may be a hit.
        EXPECT_TRUE(alone.answer == CastAnswer::miss || other.answer == CastAnswer::hit) << i;
        EXPECT_TRUE(std::isnan(alone.upper)) << i;
      }
    }
  }
  EXPECT_GE(hits, asked / 4);
  EXPECT_GE(misses, asked / 4);
}

}  // namespace
}  // namespace touchstone
