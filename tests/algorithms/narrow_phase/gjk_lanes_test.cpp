// GJK in vector lanes: batches of every length and all levels of vector instructions alike, and no
// silent error against the exact oracle on input that is hard.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/narrow_phase/gjk_lanes/lane_gjk.h"
#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/hard_pairs.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::gjk_lanes_test {
namespace {

using namespace test;

// Hulls of at most sixteen vertices are turned into the lanes; of the others some are scanned.
constexpr std::array<Kinds, 12> kind_pairs = {{{ShapeKind::sphere, ShapeKind::sphere},
                                               {ShapeKind::sphere, ShapeKind::capsule},
                                               {ShapeKind::sphere, ShapeKind::box},
                                               {ShapeKind::sphere, ShapeKind::hull},
                                               {ShapeKind::capsule, ShapeKind::capsule},
                                               {ShapeKind::capsule, ShapeKind::box},
                                               {ShapeKind::capsule, ShapeKind::hull},
                                               {ShapeKind::box, ShapeKind::box},
                                               {ShapeKind::box, ShapeKind::hull},
                                               {ShapeKind::hull, ShapeKind::hull},
                                               {ShapeKind::capsule, ShapeKind::hull, 60},
                                               {ShapeKind::hull, ShapeKind::hull, 60}}};

const NarrowPhaseEntry& entry() { return *registry::find<NarrowPhaseEntry>("gjk-lanes"); }

std::string name(Kinds kinds, Precision scalar, Task task, Sort sort) {
  return std::string(to_string(kinds.a)) + "-" + std::string(to_string(kinds.b)) + " of " +
         std::to_string(kinds.hull_points) + " " + std::string(to_string(scalar)) + " " +
         std::string(to_string(task)) + " sort " + std::to_string(static_cast<int>(sort));
}

TEST(GjkLanes, AnswerBatchesOfEveryLengthAlike) {
  for (const Kinds kinds :
       {Kinds{ShapeKind::capsule, ShapeKind::box}, Kinds{ShapeKind::hull, ShapeKind::hull},
        Kinds{ShapeKind::hull, ShapeKind::hull, 60}}) {
    const Pairs pairs = hard_pairs(11, kinds, Sort::plain, drawn(500, 120));
    for (const Precision scalar : scalars) {
      for (const Task task : all_tasks) {
        const std::vector<Outcome> whole = solve(entry(), scalar, task, pairs, pairs.size());
        for (const std::size_t size : {1u, 7u, 8u, 9u, 100u}) {
          expect_same(whole, solve(entry(), scalar, task, pairs, size), std::to_string(size));
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

TEST(GjkLanes, TakeAnEmptyBatch) {
  const Pairs pairs = hard_pairs(12, {ShapeKind::box, ShapeKind::box}, Sort::plain, 2);
  const auto algorithm = entry().make(settings_of(Precision::float64));
  algorithm->bind(pairs.shapes);
  algorithm->solve(Task::distance, pairs.batch(0, 0), {});
}

TEST(GjkLanes, HaveTheSameBitsAtEveryLevel) {
  for (const Kinds kinds : kind_pairs) {
    for (const Sort sort : all_sorts) {
      const Pairs pairs = hard_pairs(13, kinds, sort, drawn(100, 20));
      for (const Precision scalar : scalars) {
        // Below AVX2, doubles are not for the lanes.
        const Isa lowest = scalar == Precision::float32 ? Isa::baseline : Isa::avx2;
        for (const Task task : all_tasks) {
          limit_isa(lowest);
          const std::vector<Outcome> low = solve(entry(), scalar, task, pairs, pairs.size());
          for (const Isa level : {Isa::avx2, Isa::avx512}) {
            limit_isa(level);
            expect_same(low, solve(entry(), scalar, task, pairs, pairs.size()),
                        name(kinds, scalar, task, sort) + " " + std::string(to_string(level)));
          }
          limit_isa(isa_of_machine());
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

double size_of(const Pairs& pairs, std::size_t i) {
  double size = 0;
  for (const std::uint32_t body : {pairs.first[i], pairs.second[i]}) {
    const Shape& shape = pairs.shapes[body];
    double reach = 0;
    switch (shape.kind) {
      case ShapeKind::sphere: reach = shape.radius; break;
      case ShapeKind::capsule: reach = shape.radius + shape.half_length; break;
      case ShapeKind::box: reach = shape.half_extents.norm(); break;
      default:
        for (const Vec3d& v : shape.hull->vertices) reach = std::max(reach, v.norm());
    }
    size += reach * std::max(1.0, pairs.poses[body].rotation.norm());
  }
  const Vec3d offset =
      pairs.poses[pairs.second[i]].translation - pairs.poses[pairs.first[i]].translation;
  return size + offset.norm();
}

// The point is on the body, as far as `most` allows.
void expect_on(oracle::Oracle& oracle, const Pairs& pairs, std::uint32_t body, const Vec3d& point,
               double most) {
  Shape dot;  // a point
  const oracle::Solid spot(dot), solid(pairs.shapes[body]);
  const oracle::Measure off =
      oracle.measure({spot, Pose{Mat3d::Identity(), point}}, {solid, pairs.poses[body]});
  EXPECT_LE(off.middle(), most);
}

TEST(GjkLanes, HoldNoSilentErrorAgainstTheOracle) {
  const NarrowPhaseEntry& gjk = *registry::find<NarrowPhaseEntry>("gjk");
  oracle::Oracle oracle;
  for (const Kinds kinds : kind_pairs) {
    for (const Sort sort : all_sorts) {
      const Pairs pairs = hard_pairs(14, kinds, sort, drawn(150, 40));
      std::vector<oracle::Measure> truths;
      std::size_t common = 0;
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const std::uint32_t a = pairs.first[i], b = pairs.second[i];
        const oracle::Solid solid_a(pairs.shapes[a]), solid_b(pairs.shapes[b]);
        truths.push_back(oracle.measure({solid_a, pairs.poses[a]}, {solid_b, pairs.poses[b]}));
        common += truths.back().answer == Answer::overlapping ? 1u : 0u;
      }
      EXPECT_GT(common, pairs.size() / 15) << name(kinds, scalars[0], all_tasks[0], sort);
      EXPECT_LT(common, pairs.size() * 5 / 6) << name(kinds, scalars[0], all_tasks[0], sort);
      for (const Precision scalar : scalars) {
        const double epsilon = scalar == Precision::float32 ? 0x1p-23 : 0x1p-52;
        for (const Task task : all_tasks) {
          const std::vector<Outcome> outcomes = solve(entry(), scalar, task, pairs, pairs.size());
          const std::vector<Outcome> one_by_one = solve(gjk, scalar, task, pairs, pairs.size());
          for (std::size_t i = 0; i < pairs.size(); ++i) {
            const oracle::Measure& truth = truths[i];
            const Outcome& o = outcomes[i];
            const double size = size_of(pairs, i);
            SCOPED_TRACE(name(kinds, scalar, task, sort) + " pair " + std::to_string(i) +
                         " truth " + std::to_string(truth.middle() / size / epsilon) +
                         " epsilons of the size");
            if (o.status != Status::ok) {
              // No pair is given up that can be answered one by one.
              ASSERT_NE(one_by_one[i].status, Status::ok);
              if (task == Task::intersect && sort != Sort::skewed) {
                ASSERT_LE(std::abs(truth.middle()), 1000 * epsilon * size);
              }
              continue;
            }
            if (o.answer == Answer::touching) {
              ASSERT_LE(o.lower, truth.upper);
              ASSERT_GE(o.upper, truth.lower);
              continue;
            }
            ASSERT_EQ(o.answer, truth.answer);
            if (!asks_for_number(task, o.answer)) {
              ASSERT_TRUE(std::isnan(o.distance) && std::isnan(o.witness_a.x()));
              continue;
            }
            const double error = 100 * epsilon * size;
            const double place = 0x1p-50 * (pairs.poses[pairs.first[i]].translation.norm() + size);
            ASSERT_NEAR(o.distance, truth.middle(), error);
            ASSERT_LE(o.lower, truth.upper);
            ASSERT_GE(o.upper, truth.lower);
            ASSERT_NEAR(o.normal.norm(), 1, 16 * epsilon);
            // Faces that are nearly parallel share a wide region, up to rounding, and the nearest
            // face may be a sliver at its rim: then the points are only on their bodies.
            const bool alike =
                sort == Sort::parallel || sort == Sort::stacked || sort == Sort::skewed;
            if (o.answer == Answer::separated || !alike) {
              ASSERT_LE((o.witness_b - o.witness_a - o.distance * o.normal).norm(),
                        10 * error + place);
            }
            expect_on(oracle, pairs, pairs.first[i], o.witness_a, error + place);
            expect_on(oracle, pairs, pairs.second[i], o.witness_b, error + place);
            if (HasFailure()) return;
          }
        }
      }
    }
  }
}

// The lanes themselves: pairs are answered there, and not one by one.
template <class Scalar>
void expect_few_left() {
  for (const Kinds kinds : kind_pairs) {
    for (const Sort sort : {Sort::plain, Sort::scaled, Sort::remote}) {
      Random random(15);
      Pairs pairs;
      const double scale = sort == Sort::scaled ? 1e-5 : 1, far = sort == Sort::remote ? 1e6 : 0;
      for (int k = 0; k < 400; ++k) {
        const auto draw = [&](ShapeKind kind) {
          Shape shape = random_shape(random, kind, false, kinds.hull_points);
          shape.radius *= scale;
          shape.half_length *= scale;
          shape.half_extents *= scale;
          return shape;
        };
        if (sort == Sort::scaled && kinds.b == ShapeKind::hull) continue;
        const Shape a = draw(kinds.a), b = draw(kinds.b);
        const Pose pose_a{random_rotation(random), far * random_direction(random)};
        const Pose pose_b{random_rotation(random),
                          pose_a.translation + scale * random_vector(random, 0.3, 2.2)};
        pairs.add(a, pose_a, b, pose_b);
      }
      if (pairs.size() == 0) continue;
      const auto shapes = make_support_shapes<Scalar>(pairs.shapes);
      GjkLanes<Scalar> lanes;
      lanes.bind(pairs.shapes, shapes);
      std::vector<Outcome> outcomes(pairs.size());
      std::vector<std::uint32_t> places(pairs.size()), left(pairs.size());
      std::iota(places.begin(), places.end(), 0u);
      for (const Task task : {Task::intersect, Task::distance, Task::penetration}) {
        const std::size_t count =
            lanes.solve(kinds.a, kinds.b, {pairs.first, pairs.second, pairs.shape_of, pairs.poses},
                        {.task = task,
                         .tolerance = 16 * std::numeric_limits<Scalar>::epsilon(),
                         .most_iterations = 128,
                         .most_expansions = 256},
                        places, outcomes, left.data());
        EXPECT_LE(count, pairs.size() / 20)
            << name(kinds, Precision::float64, task, sort) << " of " << sizeof(Scalar) << " bytes";
        const auto common = std::ranges::count(outcomes, Answer::overlapping, &Outcome::answer);
        EXPECT_GT(common, 40);
        EXPECT_LT(common, 360);
      }
    }
  }
}

TEST(GjkLanes, LeaveFewPairs) {
  expect_few_left<float>();
  if (isa_of_machine() != Isa::baseline) expect_few_left<double>();
}

// Hulls far from their own origin, among others of few vertices and of many.
TEST(GjkLanes, AnswerWhatDoesNotFit) {
  Random random(16);
  oracle::Oracle oracle;
  Pairs pairs;
  std::array<int, 2> count{};
  for (int k = 0; k < 200; ++k) {
    const auto draw = [&] {
      std::vector<Vec3d> points(random() % 3 == 0 ? 40 : 10);
      const Vec3d aside = random() % 3 == 0 ? Vec3d(100 * random_direction(random)) : Vec3d::Zero();
      for (Vec3d& point : points) point = aside + random_direction(random);
      return std::pair{bare_hull(std::move(points), 3), aside};
    };
    const auto [a, aside_a] = draw();
    const auto [b, aside_b] = draw();
    const Mat3d turn_a = random_rotation(random), turn_b = random_rotation(random);
    pairs.add(a, {turn_a, -(turn_a * aside_a)}, b,
              {turn_b, random_vector(random, 1, 2.2) - turn_b * aside_b});
  }
  for (const Precision scalar : scalars) {
    const std::vector<Outcome> outcomes =
        solve(entry(), scalar, Task::distance, pairs, pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const std::uint32_t a = pairs.first[i], b = pairs.second[i];
      const oracle::Solid solid_a(pairs.shapes[a]), solid_b(pairs.shapes[b]);
      const oracle::Measure truth =
          oracle.measure({solid_a, pairs.poses[a]}, {solid_b, pairs.poses[b]});
      if (outcomes[i].status != Status::ok) continue;
      ASSERT_EQ(outcomes[i].answer, truth.answer);
      ++count[truth.answer == Answer::overlapping ? 1 : 0];
      if (truth.answer == Answer::overlapping) continue;
      ASSERT_NEAR(outcomes[i].distance, truth.middle(),
                  scalar == Precision::float32 ? 1e-4 : 1e-12);
    }
  }
  EXPECT_GT(count[0], 50);
  EXPECT_GT(count[1], 50);
}

}  // namespace
}  // namespace touchstone::gjk_lanes_test
