// Bodies that turn on their way to a half-space, as in every tumble to the ground, against the enclosure of the oracle.
#include <gtest/gtest.h>

#include "tests/algorithms/cast/linear_cast.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using reference::Random;

const std::vector<Shape>& bodies() {
  static const std::vector<Shape> all = {
      reference::make_sphere(0.5),
      reference::make_capsule(0.2, 0.5),
      reference::make_box(0.3, 0.4, 0.5),
      reference::make_cylinder(0.3, 0.4),
      reference::make_cone(0.3, 0.4),
      reference::make_ellipsoid(0.2, 0.4, 0.6),
      reference::make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 0.7}})};
  return all;
}

CastOutcome solve(const char* name, const Shape& body, const Pose& pose, const Motion& motion,
                  const Motion& of_ground) {
  const CastEntry* entry = registry::find<CastEntry>(name);
  const auto cast = entry->make({.tolerance = 1e-7});
  const std::array<Shape, 2> shapes = {body, reference::make_halfspace({0, 0.6, 0.8}, 0.1)};
  cast->bind(shapes);
  const std::array<std::uint32_t, 1> first = {0}, second = {1};
  const std::array<std::uint32_t, 2> shape_of = {0, 1};
  const std::array<Pose, 2> poses = {pose, Pose{}};
  const std::array<Motion, 2> motions = {motion, of_ground};
  CastOutcome outcome;
  cast->solve({body.kind, ShapeKind::halfspace, {first, second, shape_of, poses}, motions},
              {&outcome, 1});
  return outcome;
}

class TurningHalfspace : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, TurningHalfspace,
                         testing::Values("rigid-advancement", "conservative-advancement",
                                         "bilateral-advancement"),
                         [](const auto& param) {
                           std::string name = param.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST_P(TurningHalfspace, TumblesAreAnsweredAsByTheOracle) {
  const std::string name = GetParam();
  Random random(7);
  int hits = 0, misses = 0;
  for (const Shape& body : bodies()) {
    for (int i = 0; i < drawn(12, 4); ++i) {
      const Pose pose = {random.rotation(), Vec3d(0, 1.2, 1.6) + random.vector(0.2)};
      const Motion motion = {random.vector(2) - Vec3d(0, 0.5, 0.5),
                             random.vector(i % 3 == 0 ? 20 : 3)};
      const Motion of_ground = {random.vector(0.2), Vec3d::Zero()};
      const CastOutcome found = solve(name.c_str(), body, pose, motion, of_ground);
      const CastOutcome truth = solve("exact", body, pose, motion, of_ground);
      ASSERT_EQ(found.status, Status::ok);
      ASSERT_EQ(truth.status, Status::ok);
      EXPECT_EQ(found.answer, truth.answer);
      if (found.answer != CastAnswer::hit) {
        ++misses;
        continue;
      }
      ++hits;
      EXPECT_LE(found.lower, truth.upper);
      EXPECT_GE(found.upper, truth.lower);
      EXPECT_NEAR(found.toi, truth.toi, 1e-5);
      EXPECT_NEAR(std::abs(found.normal.dot(Vec3d(0, 0.6, 0.8))), 1, 1e-12);
      EXPECT_TRUE(found.point.allFinite());
    }
  }
  EXPECT_GT(hits, drawn(20, 7));
  EXPECT_GT(misses, drawn(8, 3));
}

TEST_P(TurningHalfspace, ContactAtTheStartIsAHitAndATurningGroundIsRefused) {
  const std::string name = GetParam();
  const Shape box = reference::make_box(1, 1, 1);
  const Motion turning = {Vec3d::Zero(), {0.3, 0, 0}};
  const Pose inside = {Mat3d::Identity(), {0, 0.2, 0.4}};
  for (const std::string& by : {name, std::string("exact")}) {
    const CastOutcome start = solve(by.c_str(), box, inside, turning, {});
    EXPECT_EQ(start.answer, CastAnswer::hit);
    EXPECT_EQ(start.toi, 0);
    EXPECT_EQ(solve(by.c_str(), box, inside, {}, turning).status, Status::unsupported);
  }
}

}  // namespace
}  // namespace touchstone
