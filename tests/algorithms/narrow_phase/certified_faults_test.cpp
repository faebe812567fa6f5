// Certified with planted faults: what GJK and EPA found is replaced by what they find for bodies
// that lie elsewhere, by less or more than rounding. Each stage proves what is so for the bodies as
// they lie, or nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/kernels/epa/expanding_polytope.h"
#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/narrow_phase/certified/distance_bounds.h"
#include "algorithms/narrow_phase/certified/double_bounds.h"
#include "algorithms/narrow_phase/certified/enclosure.h"
#include "algorithms/narrow_phase/certified/exact_contact.h"
#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/narrow_phase/bodies.h"

namespace touchstone::certified_faults_test {
namespace {

using namespace test;

// Two polytopes near contact, and where the stages before suppose the second.
struct Misplaced {
  Shape a, b;
  Pose pose_a, pose_b, supposed;
  oracle::Measure exact;
};

Misplaced misplaced(Random& random) {
  const auto any = [&] {
    return random() % 3 == 0 ? box(uniform(random, 0.5, 2), uniform(random, 0.5, 2), 1)
                             : random_hull(random, 6 + static_cast<int>(random() % 12));
  };
  Misplaced bodies{any(), any(), {random_rotation(random), random_direction(random)}, {}, {}, {}};
  bodies.pose_b = {random_rotation(random), random_direction(random)};
  const oracle::Solid a(bodies.a), b(bodies.b);
  oracle::Oracle oracle;
  const auto measure = [&] {
    return oracle.measure(oracle::Body(a, bodies.pose_a), oracle::Body(b, bodies.pose_b));
  };
  const oracle::Measure now = measure();
  const double wanted = (random() % 2 == 0 ? 1 : -1) * std::pow(10.0, uniform(random, -18, -0.5));
  bodies.pose_b.translation += (wanted - now.middle()) * now.normal.stableNormalized();
  bodies.exact = measure();
  bodies.supposed = bodies.pose_b;
  bodies.supposed.translation +=
      std::pow(10.0, uniform(random, -18, -0.5)) * random_direction(random);
  return bodies;
}

TEST(CertifiedFaults, GapsHoldWhateverGjkFound) {
  Random random(1);
  DistanceBounder bounder;
  int gaps = 0, open = 0;
  for (int i = 0; i < 2000; ++i) {
    const Misplaced bodies = misplaced(random);
    const BoundedShape a(bodies.a), b(bodies.b);
    SupportPair<double> supposed(a.support, bodies.pose_a, b.support, bodies.supposed);
    const SupportPair<double> pair(a.support, bodies.pose_a, b.support, bodies.pose_b);
    if (pair.unit() != supposed.unit()) continue;
    const GjkDistanceResult<double> found = gjk_distance(
        supposed, {.task = Task::distance, .tolerance = 1e-15, .most_iterations = 128});
    if (found.nearest.direction.isZero(0)) continue;
    const DistanceBounds gap = bounder.between(a, bodies.pose_a, b, bodies.pose_b, pair,
                                               found.simplex, -found.nearest.direction);
    ASSERT_LE(gap.lower, bodies.exact.upper) << i;
    ASSERT_GE(gap.upper, std::max(0.0, bodies.exact.lower)) << i;
    ++(gap.lower > 0 ? gaps : open);
  }
  EXPECT_GT(gaps, 100);
  EXPECT_GT(open, 100);
}

// GJK may have stopped anywhere, and left any weights.
TEST(CertifiedFaults, GapsInDoublesHoldWhereverGjkStopped) {
  Random random(6);
  int gaps = 0, close = 0, open = 0;
  for (int i = 0; i < 2000; ++i) {
    const Misplaced bodies = misplaced(random);
    const BoundedShape a(bodies.a), b(bodies.b);
    SupportPair<double> pair(a.support, bodies.pose_a, b.support, bodies.pose_b);
    const double tolerance = i % 3 == 0 ? 1e-15 : std::pow(10.0, uniform(random, -15, 0));
    GjkDistanceResult<double> found = gjk_distance(
        pair, {.task = Task::distance, .tolerance = tolerance, .most_iterations = 1 + i % 128});
    if (i % 4 == 0) {
      const std::array<double, 4> weights = {0, 1e-310, -1, std::pow(10.0, uniform(random, -9, 9))};
      for (double& weight : found.simplex.weights) weight = weights[random() % 4];
    }
    const DistanceBounds gap = between_in_doubles(pair, found);
    ASSERT_LE(gap.lower, bodies.exact.upper) << i;
    ASSERT_GE(gap.upper, bodies.exact.lower) << i;
    ++(gap.lower > 0 ? gaps : open);
    if (gap.upper - gap.lower < 2e-13) ++close;
  }
  EXPECT_GT(gaps, 300);
  EXPECT_GT(close, 150);
  EXPECT_GT(open, 300);
}

// EPA's surface may be any that encloses the origin, and the normal any.
TEST(CertifiedFaults, DepthsHoldWhereverEpaStopped) {
  Random random(5);
  ExpandingPolytope<double> polytope(64);
  DistanceBounder bounder;
  int depths = 0, close = 0, close_in_doubles = 0, refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const Misplaced bodies = misplaced(random);
    const BoundedShape a(bodies.a), b(bodies.b);
    SupportPair<double> pair(a.support, bodies.pose_a, b.support, bodies.pose_b);
    const GjkDistanceResult<double> found =
        gjk_distance(pair, {.task = Task::penetration, .tolerance = 1e-15, .most_iterations = 128});
    if (found.end != GjkDistanceResult<double>::End::contact) continue;
    const double tolerance = i % 3 == 0 ? pair.rounding : std::pow(10.0, uniform(random, -15, 0));
    const Expansion<double> depth = polytope.expand(pair, found.simplex, {.tolerance = tolerance});
    if (!depth.has_surface) continue;
    const Vec3d normal = i % 2 == 0 ? depth.normal : random_direction(random);
    const DistanceBounds bounds =
        bounder.inside(a, bodies.pose_a, b, bodies.pose_b, pair, polytope.surface(), normal);
    ASSERT_LE(bounds.lower, bodies.exact.upper) << i;
    ASSERT_GE(bounds.upper, bodies.exact.lower) << i;
    ++(bounds.upper < 0 ? depths : refused);
    if (bounds.upper - bounds.lower < 1e-15) ++close;
    const DistanceBounds in_doubles = inside_in_doubles(pair, polytope.surface(), depth.upper);
    ASSERT_LE(in_doubles.lower, bodies.exact.upper) << i;
    ASSERT_GE(in_doubles.upper, bodies.exact.lower) << i;
    if (in_doubles.upper - in_doubles.lower < 2e-13) ++close_in_doubles;
  }
  EXPECT_GT(depths, 333);
  EXPECT_GT(close, 166);
  EXPECT_GT(close_in_doubles, 166);
  EXPECT_GT(refused, 33);
}

TEST(CertifiedFaults, ExactVerdictsHoldWhateverThePlane) {
  Random random(2);
  ExactContactFinder finder;
  int proven = 0, unknown = 0;
  for (int i = 0; i < 2000; ++i) {
    const Misplaced bodies = misplaced(random);
    const PreparedShape a(bodies.a), b(bodies.b);
    SupportPair<double> pair(a.support(), bodies.pose_a, b.support(), bodies.pose_b);
    Simplex<double> simplex;  // any points, of which none need be of the difference
    simplex.size = static_cast<int>(random() % 5);
    for (int k = 0; k < simplex.size; ++k) {
      DifferencePoint<double>& point = simplex.points[static_cast<std::size_t>(k)];
      point = pair.support(random_direction(random));
      if (random() % 2 == 0) point.difference = random_direction(random);
    }
    const ContactGuess guess{random_direction(random), simplex};
    const Task task = all_tasks[static_cast<std::size_t>(i) % all_tasks.size()];
    const ExactContact found =
        finder.find({a, bodies.pose_a}, {b, bodies.pose_b}, guess, pair, task);
    ++(found.answer == Answer::unknown ? unknown : proven);
    if (found.answer == Answer::unknown) continue;
    ASSERT_EQ(found.answer, bodies.exact.answer) << i;
    ASSERT_LE(found.lower, bodies.exact.upper) << i;
    ASSERT_GE(found.upper, bodies.exact.lower) << i;
  }
  EXPECT_GT(proven, 1950);
  EXPECT_LT(unknown, 20);
}

TEST(CertifiedFaults, RoundedVerdictsHoldWhateverTheFeature) {
  Random random(3);
  ExactContactFinder finder;
  int proven = 0, unknown = 0;
  for (int i = 0; i < 4000; ++i) {
    Misplaced bodies = misplaced(random);
    if (!(bodies.exact.lower > 0)) continue;
    bodies.a = sphere(0);
    // The ball reaches the polytope, or misses it by rounding.
    const oracle::Solid core(bodies.a), other(bodies.b);
    oracle::Oracle oracle;
    const oracle::Measure apart =
        oracle.measure(oracle::Body(core, bodies.pose_a), oracle::Body(other, bodies.pose_b));
    if (!(apart.lower > 0)) continue;
    bodies.a.radius = apart.middle() + std::ldexp(static_cast<double>(random() % 5) - 2, -53);
    const PreparedShape a(bodies.a), b(bodies.b);
    const oracle::Measure exact =
        oracle.measure(oracle::Body(a.solid, bodies.pose_a), oracle::Body(b.solid, bodies.pose_b));
    SupportPair<double> pair(a.support(), bodies.pose_a, b.support(), bodies.pose_b);
    // The direction is right, the feature is any.
    Simplex<double> feature;
    feature.size = 1 + static_cast<int>(random() % 3);
    for (int k = 0; k < feature.size; ++k) {
      feature.points[static_cast<std::size_t>(k)] = pair.support(random_direction(random));
    }
    const ContactGuess guess{apart.normal.stableNormalized(), feature};
    const ExactContact found =
        finder.find({a, bodies.pose_a}, {b, bodies.pose_b}, guess, pair, Task::intersect);
    ++(found.answer == Answer::unknown ? unknown : proven);
    if (found.answer == Answer::unknown) continue;
    ASSERT_EQ(found.answer, exact.answer) << i;
  }
  EXPECT_GT(proven, 100);
  EXPECT_GT(unknown, 100);
}

TEST(CertifiedFaults, ATriangleThroughTheOriginIsNotBehindIt) {
  Random random(4);
  int behind = 0, doubtful = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3d p = random_direction(random), q = random_direction(random);
    const double height = std::pow(10.0, uniform(random, -18, -1));
    const Vec3d n = p.cross(q).normalized();
    const Vec3d r = uniform(random, -1, 1) * p + uniform(random, -1, 1) * q;
    for (const double side : {0.0, -1.0, 1.0}) {
      const bool found = is_surely_behind({p, q, Vec3d(r + side * height * n)});
      // The determinant has the sign of the side, and doubt is wider than 1e-16.
      EXPECT_FALSE(found && (side <= 0 || height < 1e-16));
      ++(found ? behind : doubtful);
    }
  }
  EXPECT_GT(behind, 1000);
  EXPECT_GT(doubtful, 1000);
}

}  // namespace
}  // namespace touchstone::certified_faults_test
