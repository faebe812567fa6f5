// Tests the contract on every narrow phase, ours and the peers', in each scalar, task and pair of
// kinds that it offers.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/reproducible_math.h"
#include "tests/algorithms/narrow_phase/bodies.h"
#include "tests/algorithms/narrow_phase/brute_force.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::every_narrow_phase_test {
namespace {

using namespace test;

// One algorithm in one scalar.
struct Subject {
  const NarrowPhaseEntry* entry;
  Precision scalar;

  // Ours promise what they say; of a peer it is only asked that it lives and is mostly right.
  bool ours() const { return entry->info.origin != Origin::peer; }
  bool is_double() const { return scalar == Precision::float64; }
  // Those that stand as they were published: they know a ball as one more curved surface, and
  // their doubles end sooner. Such a query may give up, and says so.
  bool is_plain() const {
    const std::string& name = entry->info.name;
    return name.ends_with("-textbook") || name == "gjk-signed-volumes";
  }
  bool may_give_up(const Outcome& outcome) const {
    return is_plain() && outcome.status == Status::not_converged;
  }
  Outcome ask(Task task, const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
              Call call = Call::batch) const {
    return test::ask(*entry, settings_of(scalar), task, a, pose_a, b, pose_b, call);
  }
};

std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (!is_built(entry.info)) continue;
    for (const Precision scalar : entry.scalars) all.push_back({&entry, scalar});
  }
  return all;
}

class EveryNarrowPhase : public testing::TestWithParam<Subject> {};

std::vector<Shape> samples(ShapeKind kind) {
  Shape shape;
  shape.kind = kind;
  shape.radius = 0.4;
  shape.half_length = 0.6;
  shape.half_extents = Vec3d(0.5, 0.7, 0.9);
  shape.radii = Vec3d(0.5, 0.7, 0.9);
  shape.normal = Vec3d(1, -2, 2);
  shape.offset = 0.75;
  if (kind == ShapeKind::hull) {
    return {box_as_hull(0.5, 0.7, 0.9), tetrahedron(), octahedron(), icosahedron()};
  }
  return {shape};
}

// A point strictly inside, half of the way to the surface along `direction` (world).
Vec3d point_within(const Shape& shape, const Pose& pose, const Vec3d& direction) {
  if (shape.kind == ShapeKind::halfspace) {
    const Vec3d outward = (pose.rotation * shape.normal).normalized();
    return support(shape, pose, direction) - 0.5 * outward;
  }
  return (pose.translation + support(shape, pose, direction)) / 2;
}

// The distance of the point from the body along a few directions only, so it is never too great.
double outside(const Shape& shape, const Pose& pose, const Vec3d& point) {
  if (shape.kind == ShapeKind::halfspace) {
    const Vec3d outward = (pose.rotation * shape.normal).normalized();
    return outward.dot(point - support(shape, pose, outward));
  }
  Random random(1);
  double worst = -1;
  for (int k = 0; k < 200; ++k) {
    const Vec3d d = random_direction(random);
    worst = std::max(worst, d.dot(point - support(shape, pose, d)));
  }
  return worst;
}

void expect_nothing_but_the_answer(const Outcome& outcome) {
  EXPECT_TRUE(std::isnan(outcome.distance) && std::isnan(outcome.lower) &&
              std::isnan(outcome.upper));
  EXPECT_TRUE(std::isnan(outcome.normal.x()) && std::isnan(outcome.witness_a.x()) &&
              std::isnan(outcome.witness_b.x()));
}

// Apart by 0.5 along `u`, closest at p (on a) and q (on b).
void expect_apart(const Subject& subject, Task task, const Outcome& outcome, const Vec3d& u,
                  const Vec3d& p, const Vec3d& q) {
  EXPECT_EQ(outcome.answer, Answer::separated);
  EXPECT_EQ(outcome.status, Status::ok);
  if (!asks_distance(task)) return expect_nothing_but_the_answer(outcome);
  const double tolerance = subject.is_double() ? 1e-6 : 1e-4;
  EXPECT_NEAR(outcome.distance, 0.5, tolerance);
  EXPECT_NEAR(outcome.normal.norm(), 1, 1e-6);
  // Points move as the root of what a distance is off by.
  const double coarse = std::sqrt(tolerance) * 4;
  EXPECT_LE((outcome.normal - u).norm(), coarse);
  EXPECT_LE((outcome.witness_a - p).norm(), coarse);
  EXPECT_LE((outcome.witness_b - q).norm(), coarse);
  EXPECT_LE((outcome.witness_b - outcome.witness_a - outcome.distance * outcome.normal).norm(),
            tolerance * 10);
  if (!std::isnan(outcome.lower)) {
    EXPECT_LE(outcome.lower, 0.5 + 1e-5);
  }
  if (!std::isnan(outcome.upper)) {
    EXPECT_GE(outcome.upper, 0.5 - 1e-5);
  }
}

void expect_overlap(const Subject& subject, Task task, const Outcome& outcome, const Shape& a,
                    const Pose& pose_a, const Shape& b, const Pose& pose_b, double most) {
  EXPECT_EQ(outcome.answer, Answer::overlapping);
  EXPECT_EQ(outcome.status, Status::ok);
  if (!asks_depth(task)) return expect_nothing_but_the_answer(outcome);
  EXPECT_NEAR(outcome.normal.norm(), 1, 1e-6);
  EXPECT_LT(outcome.distance, 0);
  if (subject.entry->traits.approximate) return;
  const double tolerance = subject.is_double() ? 1e-5 : 1e-3;
  // Moved by the depth along the normal, the bodies are apart: b's lowest is a's highest.
  if (b.kind != ShapeKind::halfspace) {
    const double high = support(a, pose_a, outcome.normal).dot(outcome.normal);
    const double low = support(b, pose_b, -outcome.normal).dot(outcome.normal);
    EXPECT_NEAR(low - high, outcome.distance, tolerance);
  }
  // An upper bound of the depth, such as a portal's, may be more than the overlap along one axis.
  if (outcome.upper - outcome.lower <= tolerance) {
    EXPECT_GE(outcome.distance, -most - tolerance);
  }
  if (std::isnan(outcome.witness_a.x())) return;
  EXPECT_LE((outcome.witness_a - outcome.witness_b + outcome.distance * outcome.normal).norm(),
            std::sqrt(tolerance));
  EXPECT_LE(outside(a, pose_a, outcome.witness_a), tolerance);
  EXPECT_LE(outside(b, pose_b, outcome.witness_b), tolerance);
}

TEST_P(EveryNarrowPhase, AnswersEasyPairs) {
  const Subject& subject = GetParam();
  int asked = 0, right = 0;
  for (const ShapeKind kind_a : all_shape_kinds) {
    if (kind_a == ShapeKind::halfspace) continue;
    for (const ShapeKind kind_b : all_shape_kinds) {
      if (kind_b < kind_a) continue;
      for (const Task task : all_tasks) {
        if (!offers(*subject.entry, kind_a, kind_b, task)) continue;
        Random random(static_cast<std::uint64_t>(kind_a) * 8 + static_cast<std::uint64_t>(kind_b));
        for (const Shape& a : samples(kind_a)) {
          for (const Shape& b : samples(kind_b)) {
            for (int k = 0; k < 6; ++k) {
              SCOPED_TRACE(std::string(to_string(kind_a)) + "-" + std::string(to_string(kind_b)) +
                           " " + std::string(to_string(task)) + " " + std::to_string(k));
              const Pose pose_a{random_rotation(random), Vec3d(1, 2, 3) * (k % 3)};
              Pose pose_b{random_rotation(random), Vec3d::Zero()};
              Vec3d u = random_direction(random);
              if (b.kind == ShapeKind::halfspace) u = -(pose_b.rotation * b.normal).normalized();
              const Vec3d p = support(a, pose_a, u);
              const auto meet = [&](const Vec3d& on_a, const Vec3d& on_b) {
                Pose moved = pose_b;
                moved.translation = on_a - on_b;
                return moved;
              };
              const Pose apart = meet(p + 0.5 * u, support(b, pose_b, -u));
              const Pose common = meet(point_within(a, pose_a, u), point_within(b, pose_b, -u));
              const Outcome of_apart = subject.ask(task, a, pose_a, b, apart);
              const Outcome of_common = subject.ask(task, a, pose_a, b, common);
              asked += 2;
              right += of_apart.answer == Answer::separated ? 1 : 0;
              right += of_common.answer == Answer::overlapping ? 1 : 0;
              if (!subject.ours()) continue;
              // A face of each may lie between them without being a face normal of either.
              if (!subject.entry->traits.approximate || of_apart.answer == Answer::separated) {
                expect_apart(subject, task, of_apart, u, p, p + 0.5 * u);
              }
              const double most = b.kind == ShapeKind::halfspace
                                      ? u.dot(p - support(b, common, u))
                                      : u.dot(p - support(b, common, -u));
              if (subject.may_give_up(of_common)) continue;
              expect_overlap(subject, task, of_common, a, pose_a, b, common, most);
              if (HasFailure()) return;
            }
          }
        }
      }
    }
  }
  if (!subject.ours() && subject.entry->info.known_defect.empty()) {
    EXPECT_GE(right, asked * 9 / 10);
  }
  if (right < asked) std::printf("%d of %d answers right\n", right, asked);
}

void expect_same(const Outcome& outcome, const Outcome& other, double tolerance) {
  EXPECT_EQ(outcome.answer, other.answer);
  EXPECT_EQ(outcome.status, other.status);
  EXPECT_EQ(std::isnan(outcome.distance), std::isnan(other.distance));
  EXPECT_EQ(std::isnan(outcome.normal.x()), std::isnan(other.normal.x()));
  EXPECT_EQ(std::isnan(outcome.witness_a.x()), std::isnan(other.witness_a.x()));
  if (std::isnan(outcome.distance) || std::isnan(other.distance)) return;
  EXPECT_NEAR(outcome.distance, other.distance, tolerance);
}

TEST_P(EveryNarrowPhase, AnswersOnePairAloneAsInABatch) {
  const Subject& subject = GetParam();
  const double tolerance = subject.is_double() ? 1e-6 : 1e-3;
  int separated = 0, overlapping = 0;
  for (const ShapeKind kind_a : all_shape_kinds) {
    for (const ShapeKind kind_b : all_shape_kinds) {
      if (kind_b < kind_a) continue;
      for (const Task task : all_tasks) {
        if (!offers(*subject.entry, kind_a, kind_b, task)) continue;
        Random random(static_cast<std::uint64_t>(kind_a) * 8 + static_cast<std::uint64_t>(kind_b));
        const Shape a = samples(kind_a).front(), b = samples(kind_b).back();
        for (int k = 0; k < 12; ++k) {
          SCOPED_TRACE(std::string(to_string(kind_a)) + "-" + std::string(to_string(kind_b)) + " " +
                       std::string(to_string(task)) + " " + std::to_string(k));
          const Pose pose_a{random_rotation(random), random_direction(random)};
          const Pose pose_b{random_rotation(random),
                            pose_a.translation + k * 0.25 * random_direction(random)};
          const Outcome outcome = subject.ask(task, a, pose_a, b, pose_b);
          separated += outcome.answer == Answer::separated;
          overlapping += outcome.answer == Answer::overlapping;
          expect_same(subject.ask(task, a, pose_a, b, pose_b, Call::alone), outcome, tolerance);
        }
      }
    }
  }
  EXPECT_GT(separated, 4);
  EXPECT_GT(overlapping, 4);
}

// Same centre and orientation, and one far inside of the other.
TEST_P(EveryNarrowPhase, AnswersContainment) {
  const Subject& subject = GetParam();
  Random random(3);
  for (const ShapeKind kind : all_shape_kinds) {
    if (kind == ShapeKind::halfspace) continue;
    for (const Task task : all_tasks) {
      if (!offers(*subject.entry, kind, kind, task)) continue;
      for (const Shape& shape : samples(kind)) {
        SCOPED_TRACE(std::string(to_string(kind)) + " " + std::string(to_string(task)));
        Shape small = shape;
        small.radius *= 0.1;
        small.half_length *= 0.1;
        small.half_extents *= 0.1;
        small.radii *= 0.1;
        if (kind == ShapeKind::hull) {
          auto copy = std::make_shared<Hull>(*shape.hull);
          for (Vec3d& v : copy->vertices) v *= 0.1;
          small.hull = copy;
        }
        const Pose pose{random_rotation(random), Vec3d(3, 4, 5)};
        Pose beside = pose;
        beside.translation += Vec3d(0.01, 0.02, -0.01);
        for (const auto& [other, pose_b] :
             {std::pair{shape, pose}, {small, pose}, {small, beside}}) {
          const Outcome outcome = subject.ask(task, shape, pose, other, pose_b);
          if (!subject.ours()) continue;
          EXPECT_EQ(outcome.answer, Answer::overlapping);
          if (subject.may_give_up(outcome)) continue;
          // The depth of a smooth body in itself has a circle or more of equal ways out; an
          // algorithm may say that it found none to its tolerance.
          const bool smooth = kind == ShapeKind::cylinder || kind == ShapeKind::cone ||
                              kind == ShapeKind::ellipsoid;
          if (!asks_depth(task) || !smooth || outcome.status != Status::not_converged) {
            EXPECT_EQ(outcome.status, Status::ok);
          }
          const bool is_rough = subject.is_plain() && subject.entry->traits.depth_is_bound;
          if (asks_depth(task) && kind == ShapeKind::sphere && !is_rough) {
            const double tolerance = subject.is_double() ? 1e-6 : 1e-4;
            const double between = (pose_b.translation - pose.translation).norm();
            EXPECT_NEAR(outcome.distance, -(shape.radius + other.radius - between), tolerance);
          }
        }
      }
    }
  }
}

Shape random_polytope(Random& random, ShapeKind kind) {
  if (kind == ShapeKind::hull) return random_hull(random, 4 + static_cast<int>(random() % 8));
  return box(uniform(random, 0.2, 1), uniform(random, 0.2, 1), uniform(random, 0.2, 1));
}

// Boxes and hulls at random, against the brute force; the bodies in either order.
TEST_P(EveryNarrowPhase, AgreesWithTheBruteForce) {
  const Subject& subject = GetParam();
  Random random(4);
  const double margin = subject.is_double() ? 1e-9 : 1e-4;
  for (const auto& [kind_a, kind_b] : {std::pair{ShapeKind::box, ShapeKind::box},
                                       {ShapeKind::box, ShapeKind::hull},
                                       {ShapeKind::hull, ShapeKind::hull}}) {
    int asked = 0, common = 0, wrong = 0, gave_up = 0;
    for (int k = 0; k < drawn(160, 60); ++k) {
      const Shape a = random_polytope(random, kind_a), b = random_polytope(random, kind_b);
      const Pose pose_a{random_rotation(random), random_direction(random)};
      const Pose pose_b{random_rotation(random),
                        pose_a.translation + random_vector(random, 0.5, 2.2)};
      const double truth = brute_force::signed_distance(a, pose_a, b, pose_b);
      for (const Task task : all_tasks) {
        if (!offers(*subject.entry, kind_a, kind_b, task)) continue;
        SCOPED_TRACE(std::string(to_string(kind_a)) + "-" + std::string(to_string(kind_b)) + " " +
                     std::string(to_string(task)) + " " + std::to_string(k));
        const Outcome outcome = subject.ask(task, a, pose_a, b, pose_b);
        const Outcome swapped = subject.ask(task, b, pose_b, a, pose_a);
        ++asked;
        common += truth < 0 ? 1 : 0;
        const bool right = outcome.answer == (truth > 0 ? Answer::separated : Answer::overlapping);
        wrong += right ? 0 : 1;
        if (!subject.ours()) continue;
        if (outcome.status != Status::ok) {
          ++gave_up;
          continue;
        }
        if (subject.entry->traits.approximate && outcome.answer == Answer::overlapping) {
          if (!std::isnan(outcome.distance)) {
            EXPECT_LE(outcome.lower, truth + margin);
          }
          continue;
        }
        if (std::abs(truth) > margin) {
          EXPECT_TRUE(right) << truth;
        }
        if (swapped.status == Status::ok) {
          EXPECT_EQ(swapped.answer, outcome.answer);
        }
        if (std::isnan(outcome.distance)) continue;
        EXPECT_NEAR(outcome.normal.norm(), 1, 1e-6);
        EXPECT_LE(outcome.lower, truth + margin);
        if (!std::isnan(outcome.upper)) {
          EXPECT_GE(outcome.upper, truth - margin);
        }
        EXPECT_LE(outcome.distance, truth + margin);
        // The distance is the truth if the bounds are tight, or if there is only one answer.
        if (truth > 0 || outcome.upper - outcome.lower <= margin) {
          EXPECT_NEAR(outcome.distance, truth, margin);
          if (swapped.status == Status::ok) {
            EXPECT_NEAR(outcome.distance, swapped.distance, margin);
            // The shortest way of a shallow pair is one only; of a deep one there may be two.
            if (truth > 0) {
              EXPECT_LE((outcome.normal + swapped.normal).norm(), 1e-2);
            }
          }
        }
        if (std::isnan(outcome.witness_a.x())) continue;
        EXPECT_LE(
            (outcome.witness_b - outcome.witness_a - outcome.distance * outcome.normal).norm(),
            std::sqrt(margin));
        EXPECT_LE(brute_force::outside(a, pose_a, outcome.witness_a), margin);
        EXPECT_LE(brute_force::outside(b, pose_b, outcome.witness_b), margin);
      }
      if (HasFailure()) return;
    }
    EXPECT_LE(common, asked * 4 / 5);
    EXPECT_GE(common, asked / 5);
    EXPECT_LE(gave_up, asked / 50);
    if (!subject.ours() && subject.entry->info.known_defect.empty()) {
      EXPECT_LE(wrong, asked / 10);
    }
  }
}

// One gap, from a tenth down to 1e-12, between two faces, two crossed edges, and a vertex and a
// face.
TEST_P(EveryNarrowPhase, ClimbsTheLadderOfGaps) {
  const Subject& subject = GetParam();
  Random random(5);
  const double margin = subject.is_double() ? 0.9e-12 : 2e-5;
  const auto turn = [](double angle, const Vec3d& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  const Mat3d on_edge_x = turn(M_PI / 4, Vec3d::UnitX()),
              on_edge_y = turn(M_PI / 4, Vec3d::UnitY());
  const Mat3d on_corner = base::rotation_between({1, 1, 1}, {0, 0, -1});
  const Mat3d face = Mat3d::Identity(), turned = turn(0.3, Vec3d::UnitZ());
  struct Rung {
    Mat3d a, b;
    const char* name;
  };
  for (const Rung& rung : {Rung{face, turned, "face-face"},
                           {on_edge_x, on_edge_y, "edge-edge"},
                           {face, on_corner, "vertex-face"}}) {
    for (const auto& [a, b] : {std::pair{box(0.5, 0.5, 0.5), box(0.5, 0.5, 0.5)},
                               {box(0.5, 0.5, 0.5), box_as_hull(0.5, 0.5, 0.5)},
                               {box_as_hull(0.5, 0.5, 0.5), box_as_hull(0.5, 0.5, 0.5)}}) {
      for (int step = 1; step <= 12; ++step) {
        for (const double sign : {1.0, -1.0}) {
          const Mat3d common = step % 3 == 0 ? Mat3d::Identity() : random_rotation(random);
          const Pose pose_a{common * rung.a, Vec3d(0.25, 0.5, -0.75)};
          Pose pose_b{common * rung.b, Vec3d::Zero()};
          const Vec3d up = common.col(2);
          const double apart = up.dot(support(a, pose_a, up) - support(b, pose_b, -up));
          // Off the middle, so that no symmetry helps.
          pose_b.translation =
              pose_a.translation + common * Vec3d(0.03, -0.02, 0) +
              (apart - up.dot(pose_a.translation) + sign * std::pow(10.0, -step)) * up;
          const double truth = brute_force::signed_distance(a, pose_a, b, pose_b);
          for (const Task task : all_tasks) {
            if (!offers(*subject.entry, a.kind, b.kind, task)) continue;
            const Outcome outcome = subject.ask(task, a, pose_a, b, pose_b);
            if (!subject.ours() || std::abs(truth) < margin) continue;
            SCOPED_TRACE(std::string(rung.name) + " " + std::string(to_string(a.kind)) + "-" +
                         std::string(to_string(b.kind)) + " " + std::string(to_string(task)) +
                         " gap " + std::to_string(sign) + "e-" + std::to_string(step));
            if (subject.entry->traits.approximate && truth > 0) continue;
            if (step > 6 && subject.may_give_up(outcome)) continue;
            EXPECT_EQ(outcome.answer, truth > 0 ? Answer::separated : Answer::overlapping);
            EXPECT_EQ(outcome.status, Status::ok);
            if (!std::isnan(outcome.distance) && !subject.entry->traits.approximate) {
              EXPECT_LE(outcome.lower, truth + margin);
              EXPECT_LE(outcome.distance, truth + (subject.is_double() ? 1e-9 : 2e-5));
            }
            if (HasFailure()) return;
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryNarrowPhase, testing::ValuesIn(subjects()),
                         [](const testing::TestParamInfo<Subject>& subject) {
                           std::string name = subject.param.entry->info.name + "_" +
                                              std::string(to_string(subject.param.scalar));
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace touchstone::every_narrow_phase_test
