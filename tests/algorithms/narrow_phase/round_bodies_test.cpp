// Cylinders, cones and ellipsoids: `smooth` by Newton's method on the normal, and `gjk-lanes`. No
// silent error against the oracle on pairs that are hard, and depths and distances to 1e-12 where the
// method proves them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/hard_pairs.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::round_bodies_test {
namespace {

using namespace test;

constexpr std::array round_kinds{ShapeKind::sphere, ShapeKind::capsule, ShapeKind::cylinder,
                                 ShapeKind::cone, ShapeKind::ellipsoid};

bool is_curved(ShapeKind kind) {
  return kind == ShapeKind::cylinder || kind == ShapeKind::cone || kind == ShapeKind::ellipsoid;
}

// All pairs with a curved body; for lanes also those with boxes and hulls.
std::vector<Kinds> curved_pairs(bool with_polytopes) {
  std::vector<Kinds> pairs;
  for (const ShapeKind a : all_shape_kinds) {
    for (const ShapeKind b : all_shape_kinds) {
      if (a > b || b == ShapeKind::halfspace || !(is_curved(a) || is_curved(b))) continue;
      const bool both_round =
          std::ranges::count(round_kinds, a) + std::ranges::count(round_kinds, b) == 2;
      if (both_round || with_polytopes) pairs.push_back({a, b});
    }
  }
  return pairs;
}

std::string label(Kinds kinds, Sort sort, Precision scalar, Task task) {
  return std::string(to_string(kinds.a)) + "-" + std::string(to_string(kinds.b)) + " sort " +
         std::to_string(static_cast<int>(sort)) + " " + std::string(to_string(scalar)) + " " +
         std::string(to_string(task));
}

double reach_of(const Shape& shape) {
  if (shape.kind == ShapeKind::box) return shape.half_extents.norm();
  if (shape.kind == ShapeKind::ellipsoid) return shape.radii.maxCoeff();
  if (shape.kind != ShapeKind::hull) return shape.radius + shape.half_length;
  double reach = 0;
  for (const Vec3d& v : shape.hull->vertices) reach = std::max(reach, v.norm());
  return reach;
}

double pair_size(const Pairs& pairs, std::size_t i) {
  const std::uint32_t a = pairs.first[i], b = pairs.second[i];
  double size = (pairs.poses[b].translation - pairs.poses[a].translation).norm();
  for (const std::uint32_t body : {a, b}) {
    size += reach_of(pairs.shapes[body]) * std::max(1.0, pairs.poses[body].rotation.norm());
  }
  return size;
}

std::vector<oracle::Measure> measured(const Pairs& pairs) {
  oracle::Oracle oracle;
  std::vector<oracle::Measure> truths;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::uint32_t a = pairs.first[i], b = pairs.second[i];
    const oracle::Solid solid_a(pairs.shapes[a]), solid_b(pairs.shapes[b]);
    truths.push_back(oracle.measure({solid_a, pairs.poses[a]}, {solid_b, pairs.poses[b]}));
  }
  return truths;
}

double distance_from(const Pairs& pairs, std::uint32_t body, const Vec3d& point) {
  oracle::Oracle oracle;
  Shape dot;
  const oracle::Solid spot(dot), solid(pairs.shapes[body]);
  return oracle.measure({spot, Pose{Mat3d::Identity(), point}}, {solid, pairs.poses[body]})
      .middle();
}

// Compares one outcome with the truth. `error` is the greatest of a distance.
void expect_right(const Pairs& pairs, std::size_t i, const oracle::Measure& truth, Task task,
                  const Outcome& o, double error, double epsilon) {
  if (o.answer == Answer::touching) {
    ASSERT_LE(o.lower, truth.upper);
    ASSERT_GE(o.upper, truth.lower);
    return;
  }
  ASSERT_TRUE(truth.answer == Answer::unknown || o.answer == truth.answer);
  ASSERT_TRUE(o.answer != Answer::separated || truth.upper > 0);
  ASSERT_TRUE(o.answer != Answer::overlapping || truth.lower <= 0);
  const Answer asked = task == Task::distance ? Answer::separated : Answer::overlapping;
  if (o.answer != asked || task == Task::intersect) {
    ASSERT_TRUE(std::isnan(o.distance) && std::isnan(o.witness_a.x()));
    return;
  }
  ASSERT_NEAR(o.distance, truth.middle(), error + truth.upper - truth.lower);
  ASSERT_LE(o.lower, truth.upper);
  ASSERT_GE(o.upper, truth.lower);
  ASSERT_NEAR(o.normal.norm(), 1, 16 * epsilon);
  // A point that is off by the square root of an error in distance is no error of a distance.
  const double place = 0x1p-50 * pairs.poses[pairs.first[i]].translation.norm() +
                       100 * epsilon * pair_size(pairs, i) + error;
  ASSERT_LE(distance_from(pairs, pairs.first[i], o.witness_a), place);
  ASSERT_LE(distance_from(pairs, pairs.second[i], o.witness_b), place);
}

void hold_no_silent_error(const NarrowPhaseEntry& entry, const std::vector<Kinds>& kind_pairs,
                          std::uint64_t seed, int count) {
  const NarrowPhaseEntry& gjk = *registry::find<NarrowPhaseEntry>("gjk");
  for (const Kinds kinds : kind_pairs) {
    for (const Sort sort : all_sorts) {
      const Pairs pairs = hard_pairs(seed, kinds, sort, static_cast<std::size_t>(count));
      const std::vector<oracle::Measure> truths = measured(pairs);
      const auto common = std::ranges::count_if(truths, [](const auto& t) { return t.upper < 0; });
      EXPECT_GT(common, count / 20) << label(kinds, sort, scalars[0], all_tasks[0]);
      EXPECT_LT(common, count * 9 / 10) << label(kinds, sort, scalars[0], all_tasks[0]);
      for (const Precision scalar : entry.scalars) {
        const double epsilon = scalar == Precision::float32 ? 0x1p-23 : 0x1p-52;
        const double tolerance = scalar == Precision::float32 ? 2e-5 : 2e-10;
        for (const Task task : {Task::intersect, Task::distance, Task::penetration}) {
          const std::vector<Outcome> outcomes = solve(entry, scalar, task, pairs, pairs.size());
          const std::vector<Outcome> one_by_one = solve(gjk, scalar, task, pairs, pairs.size());
          for (std::size_t i = 0; i < pairs.size(); ++i) {
            SCOPED_TRACE(label(kinds, sort, scalar, task) + " pair " + std::to_string(i));
            if (outcomes[i].status != Status::ok) {
              // No pair is given up that can be answered one by one.
              ASSERT_NE(one_by_one[i].status, Status::ok);
              continue;
            }
            expect_right(pairs, i, truths[i], task, outcomes[i], tolerance * pair_size(pairs, i),
                         epsilon);
            if (testing::Test::HasFatalFailure()) return;
          }
        }
      }
    }
  }
}

TEST(RoundBodies, InLanesHoldNoSilentError) {
  hold_no_silent_error(*registry::find<NarrowPhaseEntry>("gjk-lanes"), curved_pairs(true), 31,
                       drawn(20, 20));
}

TEST(RoundBodies, BySmoothNormalsHoldNoSilentError) {
  hold_no_silent_error(*registry::find<NarrowPhaseEntry>("smooth"), curved_pairs(false), 32,
                       drawn(24, 20));
}

TEST(RoundBodies, AreAnsweredInLanesAlikeInEveryBatchAndAtEveryLevel) {
  const NarrowPhaseEntry& lanes = *registry::find<NarrowPhaseEntry>("gjk-lanes");
  for (const Kinds kinds : {Kinds{ShapeKind::cylinder, ShapeKind::cone},
                            Kinds{ShapeKind::ellipsoid, ShapeKind::hull}}) {
    const Pairs pairs = hard_pairs(33, kinds, Sort::plain, drawn(200, 40));
    for (const Precision scalar : scalars) {
      for (const Task task : {Task::intersect, Task::distance, Task::penetration}) {
        const std::vector<Outcome> whole = solve(lanes, scalar, task, pairs, pairs.size());
        for (const std::size_t size : {1u, 9u, 100u}) {
          expect_same(whole, solve(lanes, scalar, task, pairs, size), std::to_string(size));
        }
        limit_isa(Isa::avx2);
        expect_same(whole, solve(lanes, scalar, task, pairs, pairs.size()), "avx2");
        limit_isa(isa_of_machine());
        if (HasFatalFailure()) return;
      }
    }
  }
}

// Random pairs are proven to a part in 1e12, mostly.
TEST(RoundBodies, HaveExactDepthsAndDistances) {
  const NarrowPhaseEntry& smooth = *registry::find<NarrowPhaseEntry>("smooth");
  for (const Kinds kinds : curved_pairs(false)) {
    Random random(34);
    Pairs pairs;
    for (int k = 0; k < drawn(150, 30); ++k) {
      const Shape a = random_shape(random, kinds.a, false),
                  b = random_shape(random, kinds.b, false);
      const Pose pose_a{random_rotation(random), random_direction(random)};
      pairs.add(a, pose_a, b,
                {random_rotation(random), pose_a.translation + random_vector(random, 0.2, 2.5)});
    }
    const std::vector<oracle::Measure> truths = measured(pairs);
    for (const Task task : {Task::distance, Task::penetration}) {
      const std::vector<Outcome> outcomes =
          solve(smooth, Precision::float64, task, pairs, pairs.size());
      std::size_t count = 0, close = 0;
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Outcome& o = outcomes[i];
        if (o.status != Status::ok || std::isnan(o.distance)) continue;
        ++count;
        close += o.upper - o.lower < 4e-12 * pair_size(pairs, i) ? 1u : 0u;
        EXPECT_LE(o.lower, truths[i].upper);
        EXPECT_GE(o.upper, truths[i].lower);
      }
      EXPECT_GT(count, pairs.size() / 6) << label(kinds, Sort::plain, scalars[1], task);
      EXPECT_LT(count, pairs.size() * 5 / 6) << label(kinds, Sort::plain, scalars[1], task);
      if (task == Task::distance || (is_curved(kinds.a) && is_curved(kinds.b))) {
        EXPECT_GT(close, count * 9 / 10) << label(kinds, Sort::plain, scalars[1], task);
      }
    }
  }
}

Shape upright(ShapeKind kind, double radius, double half_length) {
  Shape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.half_length = half_length;
  shape.radii = Vec3d(radius, radius, half_length);
  return shape;
}

// Coaxial, flush and tip on cap, with depths and gaps that are known, at all scales, touching to
// 1e-12 of the size, and bodies without radius or length.
TEST(RoundBodies, StandOnEachOther) {
  const NarrowPhaseEntry& smooth = *registry::find<NarrowPhaseEntry>("smooth");
  const NarrowPhaseEntry& lanes = *registry::find<NarrowPhaseEntry>("gjk-lanes");
  Random random(35);
  int apart = 0, deep = 0;
  for (const double scale : {1e-6, 1.0, 1e6}) {
    for (const ShapeKind below :
         {ShapeKind::cylinder, ShapeKind::ellipsoid, ShapeKind::capsule, ShapeKind::cone}) {
      for (const ShapeKind above :
           {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid, ShapeKind::sphere}) {
        for (const double gap : {-1e-2, -1e-6, -1e-12, 0.0, 1e-12, 1e-6, 1e-2, 1.0}) {
          for (const bool turned : {false, true}) {
            for (const double radius : {0.0, 1.0}) {
              const Shape a = upright(below, radius * scale, scale);
              const Shape b = upright(above, 0.8 * scale,
                                      above == ShapeKind::sphere ? 0.8 * scale : 0.5 * scale);
              const double top = below == ShapeKind::capsule ? 1 + radius : 1;
              const double half = above == ShapeKind::sphere ? 0.8 : 0.5;
              Pose pose_a{turned ? random_rotation(random) : Mat3d::Identity(), Vec3d::Zero()};
              // A cone stands on its tip.
              Pose pose_b{pose_a.rotation * Vec3d(1, -1, -1).asDiagonal(),
                          pose_a.rotation * Vec3d(0, 0, scale * (top + half + gap))};
              for (const NarrowPhaseEntry* entry : {&smooth, &lanes}) {
                for (const Task task : {Task::intersect, Task::distance, Task::penetration}) {
                  const Outcome o =
                      ask(*entry, settings_of(Precision::float64), task, a, pose_a, b, pose_b);
                  SCOPED_TRACE(entry->info.name + " " + std::string(to_string(below)) + "-" +
                               std::string(to_string(above)) + " gap " +
                               std::to_string(gap * 1e12) + "e-12 radius " +
                               std::to_string(radius) + " " + std::string(to_string(task)) +
                               " scale " + std::to_string(scale));
                  if (o.status != Status::ok) continue;
                  const double error = 3e-10 * scale;
                  if (o.answer == Answer::separated) {
                    ++apart;
                    ASSERT_GT(gap, -1e-14);
                    if (task == Task::distance) {
                      ASSERT_NEAR(o.distance, gap * scale, error);
                    }
                  } else if (o.answer == Answer::overlapping) {
                    ++deep;
                    ASSERT_LT(gap, 1e-14);
                    // A body without radius has no depth but along its side.
                    if (task == Task::penetration && radius > 0) {
                      ASSERT_NEAR(o.distance, gap * scale, error);
                    }
                  } else {
                    ASSERT_LT(std::abs(gap), 1e-11);
                  }
                }
              }
            }
          }
        }
      }
    }
  }
  EXPECT_GT(apart, 1000);
  EXPECT_GT(deep, 500);
}

}  // namespace
}  // namespace touchstone::round_bodies_test
