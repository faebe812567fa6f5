// The closed forms in vector lanes: batches of every length, the same bits at every level of vector
// instructions, and no silent error against the exact oracle on input that is hard.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/batch/box_pair_lanes.h"
#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/hard_pairs.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::pair_lanes_test {
namespace {

using namespace test;

constexpr std::array<Kinds, 7> kind_pairs = {{{ShapeKind::sphere, ShapeKind::sphere},
                                              {ShapeKind::sphere, ShapeKind::capsule},
                                              {ShapeKind::sphere, ShapeKind::box},
                                              {ShapeKind::sphere, ShapeKind::cylinder},
                                              {ShapeKind::sphere, ShapeKind::cone},
                                              {ShapeKind::capsule, ShapeKind::capsule},
                                              {ShapeKind::box, ShapeKind::box}}};

TEST(PairLanes, AnswerBatchesOfEveryLengthAlike) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("closed-form");
  for (const Kinds kinds : kind_pairs) {
    const Pairs pairs = hard_pairs(1, kinds, Sort::plain, 66);
    for (const Precision scalar : scalars) {
      for (const Task task : entry.tasks) {
        if (!offers(entry, kinds.a, kinds.b, task)) continue;
        const std::vector<Outcome> single = solve(entry, scalar, task, pairs, 1);
        for (const std::size_t size : {2u, 7u, 8u, 9u, 16u, 17u, 33u, 66u}) {
          expect_same(single, solve(entry, scalar, task, pairs, size), std::to_string(size));
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

TEST(PairLanes, HaveTheSameBitsAtEveryLevel) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("closed-form");
  for (const Kinds kinds : kind_pairs) {
    for (const Sort sort : all_sorts) {
      const Pairs pairs = hard_pairs(2, kinds, sort, drawn(120, 30));
      for (const Precision scalar : scalars) {
        for (const Task task : entry.tasks) {
          if (!offers(entry, kinds.a, kinds.b, task)) continue;
          limit_isa(Isa::baseline);
          const std::vector<Outcome> baseline = solve(entry, scalar, task, pairs, pairs.size());
          for (const Isa level : isa_levels()) {
            limit_isa(level);
            expect_same(baseline, solve(entry, scalar, task, pairs, pairs.size()),
                        std::string(to_string(level)));
            if (HasFatalFailure()) break;
          }
          limit_isa(isa_of_machine());
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

// The squares of such columns vanish: what is left of them bounds nothing.
TEST(PairLanes, AreNotMisledByMatricesThatShrinkNearlyToNothing) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("closed-form");
  Shape box;
  box.kind = ShapeKind::box;
  box.half_extents = Vec3d::Constant(1e11);
  for (const double scale : {1e-162, 2e-23, 1e-7, 1.}) {
    Pose pose_a, pose_b;
    pose_a.rotation = pose_b.rotation = scale * Mat3d::Identity();
    pose_b.translation = {scale * 1e11, 0, 0};
    Pairs pairs;
    for (int i = 0; i < 20; ++i) pairs.add(box, pose_a, box, pose_b);
    for (const Precision scalar : scalars) {
      for (const Outcome& outcome : solve(entry, scalar, Task::intersect, pairs, pairs.size())) {
        EXPECT_FALSE(outcome.status == Status::ok && outcome.answer != Answer::overlapping)
            << scale;
      }
    }
  }
}

// Seen from the centre of a, in the axes of the world.
double reach(const Shape& shape, const Pose& pose) {
  const double round = shape.kind == ShapeKind::box ? 0 : shape.radius;
  const double straight = shape.kind == ShapeKind::box      ? shape.half_extents.norm()
                          : shape.kind == ShapeKind::sphere ? 0
                                                            : shape.half_length;
  return round + straight * pose.rotation.norm();
}

// The places of those pairs of boxes that the lanes leave to be asked one by one.
std::set<std::size_t> boxes_left(Precision scalar, Task task, const Pairs& pairs) {
  if (pairs.shapes[0].kind != ShapeKind::box) return {};
  std::vector<Outcome> outcomes(pairs.size());
  std::vector<std::uint32_t> left(pairs.size());
  const auto ask = [&](auto lanes) {
    lanes.bind(pairs.shapes);
    return lanes.solve({pairs.first, pairs.second, pairs.shape_of, pairs.poses}, task, outcomes,
                       left.data());
  };
  if (task == Task::signed_distance) {
    std::set<std::size_t> either = boxes_left(scalar, Task::distance, pairs);
    either.merge(boxes_left(scalar, Task::penetration, pairs));
    return either;
  }
  const std::size_t count =
      scalar == Precision::float32 ? ask(BoxPairLanes<float>()) : ask(BoxPairLanes<double>());
  return {left.begin(), left.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(PairLanes, HoldNoSilentErrorAgainstTheOracle) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("closed-form");
  oracle::Oracle oracle;
  for (const Kinds kinds : kind_pairs) {
    for (const Sort sort : all_sorts) {
      const Pairs pairs = hard_pairs(3, kinds, sort, drawn(240, 60));
      std::vector<oracle::Solid> solids;
      for (const Shape& shape : pairs.shapes) solids.emplace_back(shape);
      std::vector<oracle::Measure> truths;
      std::size_t common = 0;
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const std::uint32_t a = pairs.first[i], b = pairs.second[i];
        truths.push_back(oracle.measure({solids[a], pairs.poses[a]}, {solids[b], pairs.poses[b]}));
        common += truths.back().answer == Answer::overlapping ? 1u : 0u;
      }
      EXPECT_GT(common, pairs.size() / 5);
      EXPECT_LT(common, pairs.size() * 4 / 5);
      for (const Precision scalar : scalars) {
        const double epsilon = scalar == Precision::float32 ? 0x1p-23 : 0x1p-52;
        for (const Task task : entry.tasks) {
          if (!offers(entry, kinds.a, kinds.b, task)) continue;
          const std::vector<Outcome> outcomes = solve(entry, scalar, task, pairs, pairs.size());
          const std::set<std::size_t> left = boxes_left(scalar, task, pairs);
          std::size_t given_up = 0;
          for (std::size_t i = 0; i < pairs.size(); ++i) {
            const std::uint32_t a = pairs.first[i], b = pairs.second[i];
            const Pose &pose_a = pairs.poses[a], &pose_b = pairs.poses[b];
            const oracle::Measure& truth = truths[i];
            const Outcome& o = outcomes[i];
            const double size = reach(pairs.shapes[a], pose_a) + reach(pairs.shapes[b], pose_b) +
                                (pose_b.translation - pose_a.translation).norm();
            SCOPED_TRACE(std::string(to_string(kinds.a)) + "-" + std::string(to_string(kinds.b)) +
                         " " + std::string(to_string(scalar)) + " " + std::string(to_string(task)) +
                         " sort " + std::to_string(static_cast<int>(sort)) + " pair " +
                         std::to_string(i) + " truth " +
                         std::to_string(truth.middle() / size / epsilon) + " epsilons of " +
                         std::to_string(size));
            if (o.status != Status::ok) {
              // GJK may know the answer, and not the number.
              if (o.answer != Answer::unknown) {
                ASSERT_EQ(o.answer, truth.answer);
              }
              given_up += std::abs(truth.middle()) > 200 * epsilon * size ? 1u : 0u;
            } else if (o.answer == Answer::touching) {
              ASSERT_LE(o.lower, truth.upper);
              ASSERT_GE(o.upper, truth.lower);
            } else {
              ASSERT_EQ(o.answer, truth.answer);
            }
            if (std::isnan(o.distance) || o.status != Status::ok) continue;
            // The rounding of the world's coordinates.
            const double place = 0x1p-50 * (pose_a.translation.norm() + size);
            // A sphere's distance to a skewed box is known between bounds.
            const double error = (200 * epsilon + (sort == Sort::skewed ? 1e-9 : 0)) * size;
            ASSERT_LE(o.lower, truth.upper);
            if (!std::isnan(o.upper)) {
              ASSERT_GE(o.upper, truth.lower);
              ASSERT_LE(o.upper - o.lower, 2 * error);
            }
            // That of a curved body is enclosed.
            ASSERT_NEAR(o.distance, truth.middle(), error + (truth.upper - truth.lower));
            // The points of what hardly touches are those of features that meet within the error.
            if (std::abs(truth.middle()) < 5 * error) continue;
            ASSERT_NEAR(o.normal.norm(), 1, 16 * epsilon);
            // Asked one by one, boxes that are almost parallel have points that are farther off.
            if (left.contains(i)) continue;
            ASSERT_LE((o.witness_b - o.witness_a - o.distance * o.normal).norm(), error + place);
            for (const auto& [body, point] : {std::pair{a, o.witness_a}, {b, o.witness_b}}) {
              Shape dot;  // a point
              const oracle::Solid spot(dot);
              const oracle::Measure off = oracle.measure({spot, Pose{Mat3d::Identity(), point}},
                                                         {solids[body], pairs.poses[body]});
              ASSERT_LE(off.middle(), error + place);
            }
          }
          // A matrix that is not a rotation may be reported as out of range.
          EXPECT_LE(given_up, sort == Sort::skewed ? pairs.size() / 2 : 0)
              << to_string(scalar) << " sort " << static_cast<int>(sort);
        }
      }
    }
  }
}

// The lanes themselves: pairs are answered there, and not one by one.
template <class Scalar>
void expect_few_left() {
  for (const Sort sort : {Sort::plain, Sort::stacked, Sort::scaled, Sort::remote}) {
    Random random(4);
    Pairs pairs;
    for (int k = 0; k < 500; ++k) {
      const Shape a = random_shape(random, ShapeKind::box, false);
      const bool stacked = sort == Sort::stacked;
      const Pose pose_a{random_rotation(random), random_direction(random)};
      const Pose pose_b{stacked ? pose_a.rotation : random_rotation(random),
                        pose_a.translation +
                            uniform(random, 0.2, 1.6) * (stacked ? Vec3d(pose_a.rotation.col(k % 3))
                                                                 : random_direction(random))};
      pairs.add(a, pose_a, random_shape(random, ShapeKind::box, false), pose_b);
    }
    BoxPairLanes<Scalar> lanes;
    lanes.bind(pairs.shapes);
    std::vector<Outcome> outcomes(pairs.size());
    std::vector<std::uint32_t> left(pairs.size());
    for (const Task task : {Task::intersect, Task::penetration, Task::distance}) {
      EXPECT_LE(lanes.solve({pairs.first, pairs.second, pairs.shape_of, pairs.poses}, task,
                            outcomes, left.data()),
                pairs.size() / 100)
          << static_cast<int>(sort) << " " << to_string(task);
      const auto common = std::ranges::count(outcomes, Answer::overlapping, &Outcome::answer);
      EXPECT_GT(common, 100);
      EXPECT_LT(common, 450);
    }
  }
}

TEST(PairLanes, LeaveFewPairsOfBoxes) {
  expect_few_left<float>();
  expect_few_left<double>();
}

// How two boxes rest on each other.
enum class Rest { stacked, turned, tumbled, wall, tumbled_wall, far, flat, scaled };
constexpr std::array all_rests{Rest::stacked,      Rest::turned, Rest::tumbled, Rest::wall,
                               Rest::tumbled_wall, Rest::far,    Rest::flat,    Rest::scaled};

// Sides are multiples of 1/64, so that faces meet to the last digit where nothing is turned.
Shape grid_box(Random& random) {
  Shape shape;
  shape.kind = ShapeKind::box;
  for (double& half : shape.half_extents) half = (16 + static_cast<double>(random() % 48)) / 64;
  return shape;
}

// Adds boxes that touch at a face, an edge or a corner, moved apart by `gap` along the first axis on
// which they touch.
void add_resting(Random& random, Rest rest, double gap, Pairs& pairs) {
  Shape a = grid_box(random), b = grid_box(random);
  if (rest == Rest::flat) b.half_extents[2] = 0;
  // A power of two, from 3e-8 to 3e7, by which all lengths are multiplied.
  const double scale =
      rest == Rest::scaled ? std::ldexp(1.0, static_cast<int>(random() % 50) - 25) : 1;
  const bool wall = rest == Rest::wall || rest == Rest::tumbled_wall;
  const auto touched = wall ? 1 + random() % 7 : 4;
  Vec3d offset;
  bool first = true;
  for (int k = 0; k < 3; ++k) {
    const bool touches = (touched >> k & 1) != 0;
    offset[k] = (static_cast<double>(random() % 33) - 16) / 64;
    if (!touches) continue;
    offset[k] =
        (random() % 2 == 0 ? 1 : -1) * (a.half_extents[k] + b.half_extents[k] + (first ? gap : 0));
    first = false;
  }
  Pose pose_a, pose_b;
  pose_a.translation = {static_cast<double>(random() % 640) / 64, 3, 0};
  if (rest == Rest::far) pose_a.translation = 16 * random_direction(random);
  pose_b.translation = pose_a.translation + offset;
  for (Shape* shape : {&a, &b}) shape->half_extents *= scale;
  for (Pose* pose : {&pose_a, &pose_b}) pose->translation *= scale;
  if (rest == Rest::turned) {
    pose_a.rotation = turn(uniform(random, 0, 6), Vec3d::UnitZ());
    pose_b.rotation = turn(uniform(random, 0, 6), Vec3d::UnitZ());
  }
  if (rest == Rest::tumbled || rest == Rest::tumbled_wall) {
    const Mat3d common = random_rotation(random);
    for (Pose* pose : {&pose_a, &pose_b}) {
      pose->rotation = common;
      pose->translation = common * pose->translation;
    }
  }
  pairs.add(a, pose_a, b, pose_b);
}

std::vector<Outcome> solve_each(const NarrowPhaseEntry& entry, Precision scalar, Task task,
                                const Pairs& pairs) {
  const auto algorithm = entry.make(settings_of(scalar));
  algorithm->bind(pairs.shapes);
  std::vector<Outcome> outcomes(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    algorithm->solve_alone(task, pairs.batch(0, pairs.size()), i, outcomes[i]);
  }
  return outcomes;
}

// Boxes at contact, and beside it by some units of the last place: no answer is wrong, bounds hold
// and are narrow, and one by one as in lanes.
TEST(PairLanes, JudgeBoxesThatRest) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("closed-form");
  Random random(7);
  oracle::Oracle oracle;
  for (const Rest rest : all_rests) {
    for (const Precision scalar : scalars) {
      const double epsilon = scalar == Precision::float32 ? 0x1p-23 : 0x1p-52;
      Pairs pairs;
      std::vector<oracle::Measure> truths;
      for (std::size_t k = 0; k < drawn(240, 60); ++k) {
        const double off = k % 3 == 0 ? 0 : epsilon * uniform(random, -64, 64);
        add_resting(random, rest, off, pairs);
        const oracle::Solid a(pairs.shapes[2 * k]), b(pairs.shapes[2 * k + 1]);
        truths.push_back(oracle.measure({a, pairs.poses[2 * k]}, {b, pairs.poses[2 * k + 1]}));
      }
      for (const Task task : entry.tasks) {
        SCOPED_TRACE(std::to_string(static_cast<int>(rest)) + " " + std::string(to_string(scalar)) +
                     " " + std::string(to_string(task)));
        if (task != Task::signed_distance) {
          EXPECT_LE(boxes_left(scalar, task, pairs).size(), pairs.size() / 4);
        }
        for (const bool alone : {false, true}) {
          const std::vector<Outcome> outcomes =
              alone ? solve_each(entry, scalar, task, pairs)
                    : solve(entry, scalar, task, pairs, pairs.size());
          std::size_t touching = 0, decided = 0;
          for (std::size_t i = 0; i < pairs.size(); ++i) {
            const Outcome& o = outcomes[i];
            const oracle::Measure& truth = truths[i];
            const double size = 2 * std::max(pairs.shapes[2 * i].half_extents.maxCoeff(),
                                             pairs.shapes[2 * i + 1].half_extents.maxCoeff());
            ASSERT_EQ(o.status, Status::ok) << i;
            const bool is_touching = o.answer == Answer::touching;
            ++(is_touching ? touching : decided);
            ASSERT_TRUE(is_touching || truth.answer == Answer::touching ||
                        o.answer == truth.answer);
            if (!is_touching && !asks_for_number(task, o.answer)) continue;
            ASSERT_LE(o.lower, truth.upper) << i;
            ASSERT_GE(o.upper, truth.lower) << i;
            ASSERT_LE(o.upper - o.lower, 260 * epsilon * size) << i;
            if (task == Task::intersect) continue;
            ASSERT_LE(o.lower, o.distance);
            ASSERT_GE(o.upper, o.distance);
            ASSERT_NEAR(o.normal.norm(), 1, 16 * epsilon);
            ASSERT_LE((o.witness_b - o.witness_a - o.distance * o.normal).norm(),
                      200 * epsilon * size + 0x1p-50 * pairs.poses[2 * i].translation.norm());
          }
          EXPECT_GT(touching, pairs.size() / 5);
          EXPECT_GT(decided, pairs.size() / 10);
        }
      }
    }
  }
}

// Hulls that rest: GJK ends at a face of the difference, with numbers, and no answer is wrong.
TEST(RestingHulls, EndAtAFace) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("gjk");
  Random random(8);
  oracle::Oracle oracle;
  for (const Rest rest : all_rests) {
    if (rest == Rest::scaled) continue;  // the limits below are in metres
    Pairs pairs;
    std::vector<oracle::Measure> truths;
    for (std::size_t k = 0; k < drawn(120, 30); ++k) {
      add_resting(random, rest, k % 2 == 0 ? 0 : 0x1p-52 * uniform(random, -64, 64), pairs);
      Shape& block = pairs.shapes.back();
      std::vector<Vec3d> corners;
      for (int c = 0; c < 8; ++c) {
        corners.push_back(block.half_extents.cwiseProduct(
            Vec3d((c & 1) != 0 ? 1 : -1, (c & 2) != 0 ? 1 : -1, (c & 4) != 0 ? 1 : -1)));
      }
      block = bare_hull(std::move(corners), 3);
      const oracle::Solid a(pairs.shapes[2 * k]), b(block);
      truths.push_back(oracle.measure({a, pairs.poses[2 * k]}, {b, pairs.poses[2 * k + 1]}));
    }
    for (const Task task : all_tasks) {
      const std::vector<Outcome> outcomes =
          solve(entry, Precision::float64, task, pairs, pairs.size());
      std::size_t touching = 0, at_once = 0, by_epa = 0;
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Outcome& o = outcomes[i];
        const oracle::Measure& truth = truths[i];
        SCOPED_TRACE(std::to_string(static_cast<int>(rest)) + " " + std::string(to_string(task)) +
                     " pair " + std::to_string(i));
        const bool is_touching = o.answer == Answer::touching;
        touching += is_touching ? 1u : 0u;
        at_once += is_touching && o.iterations <= 2 ? 1u : 0u;
        by_epa += is_touching && o.iterations > 12 ? 1u : 0u;
        ASSERT_TRUE(is_touching || truth.answer == Answer::touching || o.answer == truth.answer);
        if (!is_touching && !asks_for_number(task, o.answer)) continue;
        ASSERT_LE(o.lower, truth.upper);
        ASSERT_GE(o.upper, truth.lower);
        ASSERT_LE(o.upper - o.lower, 1.2e-13);
        if (task == Task::intersect) continue;
        ASSERT_NEAR(o.normal.norm(), 1, 1e-14);
        ASSERT_LE((o.witness_b - o.witness_a - o.distance * o.normal).norm(), 1e-13);
      }
      EXPECT_GT(touching, pairs.size() / 4);
      EXPECT_LT(touching, pairs.size());
      // By the face that the hull's centre is in front of, where a corner of the hull is on it.
      EXPECT_GT(at_once, 0) << static_cast<int>(rest);
      EXPECT_LT(by_epa, touching / 4);
    }
  }
}

// A box that its matrix flattens, mirrors or shears has no face with that normal: numbers that are given are numbers.
TEST(RestingHulls, OnABoxThatIsNoBox) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("gjk");
  Shape box;
  box.kind = ShapeKind::box;
  box.half_extents = {1, 1, 0.1};
  std::vector<Vec3d> corners;
  for (int c = 0; c < 8; ++c) {
    corners.push_back(
        {(c & 1) != 0 ? 0.5 : -0.5, (c & 2) != 0 ? 0.5 : -0.5, (c & 4) != 0 ? 1. : 0.});
  }
  const Shape cube = bare_hull(std::move(corners), 3);
  Mat3d sheared = Mat3d::Identity();
  sheared(0, 2) = 0.5;
  oracle::Oracle oracle;
  for (const Mat3d& matrix :
       {Mat3d(Vec3d(1, 1, 0).asDiagonal()), Mat3d(Vec3d(1, 1, 1e-200).asDiagonal()),
        Mat3d(Vec3d(1, -1, 1).asDiagonal()), Mat3d(Vec3d(1, 1, 2).asDiagonal()), sheared}) {
    const double top = 0.1 * matrix(2, 2);
    for (const double gap : {0., 1e-17, 1e-3, -1e-3}) {
      Pairs pairs;
      pairs.add(box, {matrix, Vec3d::Zero()}, cube, {Mat3d::Identity(), Vec3d(0.25, 0, top + gap)});
      const oracle::Solid a(box), b(cube);
      const oracle::Measure truth = oracle.measure({a, pairs.poses[0]}, {b, pairs.poses[1]});
      for (const Precision scalar : scalars) {
        for (const Task task : all_tasks) {
          const Outcome o = solve(entry, scalar, task, pairs, 1).front();
          SCOPED_TRACE(std::to_string(top) + " " + std::to_string(gap) + " " +
                       std::string(to_string(task)));
          if (o.status != Status::ok) continue;
          if (o.answer == Answer::touching) {
            EXPECT_LE(o.lower, truth.upper);
            EXPECT_GE(o.upper, truth.lower);
          } else {
            EXPECT_EQ(o.answer, truth.answer);
          }
          if (std::isnan(o.distance)) continue;
          EXPECT_NEAR(o.normal.norm(), 1, 1e-6);
        }
      }
    }
  }
}

}  // namespace
}  // namespace touchstone::pair_lanes_test
