#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "algorithms/registry.h"

namespace touchstone {
namespace {

constexpr std::array bullet_names = {"bullet-gjk-epa", "bullet-box-box", "bullet-sat",
                                     "bullet-mpr"};

Shape round(ShapeKind kind, double radius, double half_length = 0) {
  Shape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.half_length = half_length;
  return shape;
}
Shape box(const Vec3d& half) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.half_extents = half;
  return shape;
}
Shape ellipsoid(const Vec3d& radii) {
  Shape shape;
  shape.kind = ShapeKind::ellipsoid;
  shape.radii = radii;
  return shape;
}
Shape hull(std::vector<Vec3d> points, int dimension = 3) {
  auto h = std::make_shared<Hull>();
  h->vertices = std::move(points);
  h->dimension = dimension;
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = h;
  return shape;
}
constexpr double prism_reach = 1.5, prism_half_height = 1;

// A hexagonal prism along z, its vertices moved by `at`.
Shape hexagonal_prism(const Vec3d& at = Vec3d::Zero()) {
  std::vector<Vec3d> points;
  for (int corner = 0; corner < 6; ++corner) {
    const double angle = corner * std::numbers::pi / 3;
    for (const double z : {-prism_half_height, prism_half_height}) {
      points.push_back(at + Vec3d(prism_reach * std::cos(angle), prism_reach * std::sin(angle), z));
    }
  }
  return hull(points);
}

// One of each kind but the half-space. Each meets the z axis at its lowest and highest points.
std::vector<Shape> bounded_shapes() {
  return {round(ShapeKind::sphere, 1),
          round(ShapeKind::capsule, 0.5, 1),
          box({1, 2, 1.5}),
          round(ShapeKind::cylinder, 1.5, 1.25),
          round(ShapeKind::cone, 1.5, 1),
          ellipsoid({1, 1.5, 1.25}),
          hexagonal_prism()};
}

// Half of the extent in z.
double half_height(const Shape& s) {
  switch (s.kind) {
    case ShapeKind::sphere: return s.radius;
    case ShapeKind::capsule: return s.half_length + s.radius;
    case ShapeKind::box: return s.half_extents.z();
    case ShapeKind::ellipsoid: return s.radii.z();
    case ShapeKind::hull: return prism_half_height;
    default: return s.half_length;
  }
}

// How far a point is outside, at most (0 inside).
double outside(const Shape& s, const Pose& pose, const Vec3d& world) {
  const Vec3d p = pose.rotation.transpose() * (world - pose.translation);
  const double across = std::hypot(p.x(), p.y());
  switch (s.kind) {
    case ShapeKind::sphere: return std::max(0.0, p.norm() - s.radius);
    case ShapeKind::capsule: {
      const double z = std::clamp(p.z(), -s.half_length, s.half_length);
      return std::max(0.0, (p - Vec3d(0, 0, z)).norm() - s.radius);
    }
    case ShapeKind::box: return (p.cwiseAbs() - s.half_extents).cwiseMax(0).maxCoeff();
    case ShapeKind::cylinder:
      return std::max({0.0, across - s.radius, std::abs(p.z()) - s.half_length});
    case ShapeKind::cone: {
      const double at_height = s.radius * (s.half_length - p.z()) / (2 * s.half_length);
      return std::max({0.0, across - at_height, std::abs(p.z()) - s.half_length});
    }
    case ShapeKind::ellipsoid:
      return std::max(0.0, p.cwiseQuotient(s.radii).norm() - 1) * s.radii.maxCoeff();
    case ShapeKind::hull: {
      double most = std::max(0.0, std::abs(p.z()) - prism_half_height);
      for (int side = 0; side < 6; ++side) {
        const double angle = (side + 0.5) * std::numbers::pi / 3;
        most = std::max(most, p.x() * std::cos(angle) + p.y() * std::sin(angle) -
                                  prism_reach * std::cos(std::numbers::pi / 6));
      }
      return most;
    }
    case ShapeKind::halfspace: break;
  }
  return 0;
}

bool is_flat_sided(const Shape& s) { return s.kind == ShapeKind::box || s.kind == ShapeKind::hull; }

struct Pair {
  Shape a, b;
  Pose at_a, at_b;
};

Outcome ask(const NarrowPhaseEntry& entry, Precision scalar, Task task, Pair pair,
            std::optional<int> max_iterations = {}) {
  NarrowPhaseSettings settings;
  settings.scalar = scalar;
  settings.max_iterations = max_iterations;
  if (pair.a.kind > pair.b.kind) {
    std::swap(pair.a, pair.b);
    std::swap(pair.at_a, pair.at_b);
  }
  const std::vector<Shape> shapes = {pair.a, pair.b};
  const std::vector<Pose> poses = {pair.at_a, pair.at_b};
  const std::vector<std::uint32_t> first = {0}, second = {1}, shape_of = {0, 1};
  const auto algorithm = entry.make(settings);
  algorithm->bind(shapes);
  std::vector<Outcome> outcomes(1);
  algorithm->solve(task, {pair.a.kind, pair.b.kind, {first, second, shape_of, poses}}, outcomes);
  return outcomes[0];
}

// b above a on a's z axis, the gap between them `gap`, both moved by a rigid motion.
Pair stacked(const Shape& a, const Shape& b, double gap, const Pose& motion) {
  const double height = half_height(a) + half_height(b) + gap;
  return {a, b, motion, {motion.rotation, motion(Vec3d(0, 0, height))}};
}

std::vector<Pose> motions() {
  const Mat3d turn = (Eigen::AngleAxisd(0.7, Vec3d(1, 2, -1).normalized()) *
                      Eigen::AngleAxisd(2.1, Vec3d(0, 1, 3).normalized()))
                         .toRotationMatrix();
  return {Pose{}, {turn, Vec3d(10, -20, 5)}, {turn.transpose(), Vec3d(3e6, 1e6, -2e6)}};
}

using Build = std::tuple<const char*, Precision>;  // an algorithm in one of Bullet's builds

class BulletNarrowPhaseTest : public testing::TestWithParam<Build> {
 protected:
  void SetUp() override {
    entry_ = registry::find<NarrowPhaseEntry>(std::get<0>(GetParam()));
    ASSERT_NE(entry_, nullptr);
    if (!is_built(entry_->info)) GTEST_SKIP() << entry_->info.reason;
    if (!offers(*entry_, scalar_)) GTEST_SKIP() << entry_->info.lacking;
  }
  const NarrowPhaseEntry* entry_ = nullptr;
  const Precision scalar_ = std::get<1>(GetParam());
};

std::string build_name(const testing::TestParamInfo<Build>& build) {
  std::string name = std::get<0>(build.param);
  std::ranges::replace(name, '-', '_');
  return name + "_" + std::string(to_string(std::get<1>(build.param)));
}

TEST_P(BulletNarrowPhaseTest, AnswersEasyPairsOfEveryKind) {
  const bool surface_points = entry_->info.name != "bullet-mpr";
  int asked = 0;
  for (const Shape& a : bounded_shapes()) {
    for (const Shape& b : bounded_shapes()) {
      for (const Pose& motion : motions()) {
        for (const double gap : {2.0, 0.125, -0.125}) {
          const Pair pair = stacked(a, b, gap, motion);
          const bool in_order = a.kind <= b.kind;
          const Vec3d up = motion.rotation.col(2) * (in_order ? 1 : -1);
          const double far = 1e-9 * motion.translation.norm();
          for (const Task task : {Task::intersect, Task::distance, Task::penetration}) {
            if (!offers(*entry_, a.kind, b.kind, task)) continue;
            SCOPED_TRACE(std::string(to_string(a.kind)) + " under " +
                         std::string(to_string(b.kind)) + ", " + std::string(to_string(task)) +
                         ", gap " + std::to_string(gap) + ", at " +
                         std::to_string(motion.translation.x()));
            ++asked;
            const Outcome outcome = ask(*entry_, scalar_, task, pair);
            EXPECT_EQ(outcome.answer, gap > 0 ? Answer::separated : Answer::overlapping);
            EXPECT_TRUE(outcome.status == Status::ok || outcome.status == Status::not_reported);
            const bool numbers =
                (task == Task::distance && gap > 0) || (task == Task::penetration && gap < 0);
            EXPECT_EQ(std::isfinite(outcome.distance), numbers);
            if (!numbers) continue;
            // Bullet's EPA fails where two such ends meet in the same orientation.
            const bool epa_fails = entry_->info.name == "bullet-gjk-epa" && gap < 0 &&
                                   a.kind == b.kind && motion.rotation.isIdentity();
            if (epa_fails) {
              EXPECT_NE(outcome.status, Status::ok);
              continue;
            }
            EXPECT_NEAR(outcome.distance, gap, 5e-3);
            EXPECT_GT(outcome.normal.dot(up), 0.995);
            EXPECT_NEAR(outcome.normal.norm(), 1, 1e-5);
            const Vec3d between = outcome.witness_b - outcome.witness_a;
            EXPECT_LT((between - outcome.distance * outcome.normal).norm(), 1e-5 + far);
            if (!surface_points) continue;
            // In double, the rounding of a far motion has SAT take the point of two edges here.
            const bool flat_sided = a.kind != b.kind && is_flat_sided(a) && is_flat_sided(b);
            if (entry_->info.name == "bullet-sat" && flat_sided && far > 1e-6) continue;
            const Vec3d& on_a = in_order ? outcome.witness_a : outcome.witness_b;
            const Vec3d& on_b = in_order ? outcome.witness_b : outcome.witness_a;
            EXPECT_LT(outside(a, pair.at_a, on_a), 5e-3 + far);
            EXPECT_LT(outside(b, pair.at_b, on_b), 5e-3 + far);
          }
        }
      }
    }
  }
  EXPECT_GT(asked, 10);
}

// The signed distance of two boxes as far as a separating axis tells it: exact where they overlap,
// of the right sign otherwise.
double along_axes(const Pair& pair) {
  std::vector<Vec3d> axes;
  for (int i = 0; i < 3; ++i) {
    axes.push_back(pair.at_a.rotation.col(i));
    axes.push_back(pair.at_b.rotation.col(i));
    for (int j = 0; j < 3; ++j) {
      const Vec3d cross = pair.at_a.rotation.col(i).cross(pair.at_b.rotation.col(j));
      if (cross.norm() > 1e-6) axes.push_back(cross.normalized());
    }
  }
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3d& axis : axes) {
    const double reach =
        (pair.at_a.rotation.transpose() * axis).cwiseAbs().dot(pair.a.half_extents) +
        (pair.at_b.rotation.transpose() * axis).cwiseAbs().dot(pair.b.half_extents);
    const double between = (pair.at_b.translation - pair.at_a.translation).dot(axis);
    most = std::max(most, std::abs(between) - reach);
  }
  return most;
}

class RandomPoses {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3d point(double reach) {
    return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
  }
  Pose pose(double reach) {
    const Eigen::Quaterniond turn(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
    return {turn.normalized().toRotationMatrix(), point(reach)};
  }

 private:
  std::mt19937_64 random_{7};
};

TEST_P(BulletNarrowPhaseTest, AgreesWithTheSeparatingAxesOfRandomBoxes) {
  RandomPoses random;
  int overlapping = 0, deep = 0, right_depth = 0;
  constexpr int pairs = 1000;
  for (int i = 0; i < pairs; ++i) {
    const Pair pair = {box(Vec3d::Constant(1.2) + random.point(0.8)),
                       box(Vec3d::Constant(1.2) + random.point(0.8)), random.pose(2.2),
                       random.pose(2.2)};
    const double truth = along_axes(pair);
    overlapping += truth < 0;
    if (std::abs(truth) < 2e-3) continue;
    const Answer answer = truth > 0 ? Answer::separated : Answer::overlapping;
    EXPECT_EQ(ask(*entry_, scalar_, Task::intersect, pair).answer, answer) << i;
    const Outcome outcome = ask(*entry_, scalar_, Task::penetration, pair);
    EXPECT_EQ(outcome.answer, answer) << i;
    if (truth < 0) {
      ++deep;
      right_depth += std::abs(outcome.distance - truth) < 1e-2;
    }
  }
  EXPECT_GT(overlapping, pairs * 3 / 10);
  EXPECT_LT(overlapping, pairs * 7 / 10);
  const std::string& name = entry_->info.name;
  if (name == "bullet-sat") {
    EXPECT_EQ(right_depth, deep);
  }
  if (name == "bullet-gjk-epa") {
    EXPECT_GT(right_depth, deep * 9 / 10);
  }
}

TEST_P(BulletNarrowPhaseTest, AgreesWithTheClosedFormOfRandomSpheresAndBoxes) {
  if (!offers(*entry_, ShapeKind::sphere, ShapeKind::box, Task::intersect)) return;
  RandomPoses random;
  int overlapping = 0;
  constexpr int pairs = 1000;
  for (int i = 0; i < pairs; ++i) {
    const Pair pair = {round(ShapeKind::sphere, random.between(0.1, 1)),
                       box(Vec3d::Constant(1) + random.point(0.9)), random.pose(1.1),
                       random.pose(1.1)};
    const Vec3d centre =
        pair.at_b.rotation.transpose() * (pair.at_a.translation - pair.at_b.translation);
    const Vec3d past = centre.cwiseAbs() - pair.b.half_extents;
    const double truth =
        (past.maxCoeff() > 0 ? past.cwiseMax(0).norm() : past.maxCoeff()) - pair.a.radius;
    overlapping += truth < 0;
    if (std::abs(truth) < 2e-3) continue;
    const Answer answer = truth > 0 ? Answer::separated : Answer::overlapping;
    EXPECT_EQ(ask(*entry_, scalar_, Task::intersect, pair).answer, answer) << i;
    if (truth > 0 && offers(*entry_, Task::distance)) {
      const Outcome outcome = ask(*entry_, scalar_, Task::distance, pair);
      EXPECT_EQ(outcome.answer, answer) << i;
      EXPECT_NEAR(outcome.distance, truth, 1e-3) << i;
      EXPECT_LT(outside(pair.a, pair.at_a, outcome.witness_a), 1e-3) << i;
      EXPECT_LT(outside(pair.b, pair.at_b, outcome.witness_b), 1e-3) << i;
    }
    if (truth < 0) {
      const Outcome outcome = ask(*entry_, scalar_, Task::penetration, pair);
      EXPECT_EQ(outcome.answer, answer) << i;
      // MPR gives an upper bound.
      if (entry_->info.name == "bullet-mpr") {
        EXPECT_LT(outcome.distance, truth + 1e-3) << i;
      }
    }
  }
  EXPECT_GT(overlapping, pairs * 3 / 10);
  EXPECT_LT(overlapping, pairs * 7 / 10);
}

TEST_P(BulletNarrowPhaseTest, CentresHullsFarFromTheirOrigin) {
  if (!offers(*entry_, ShapeKind::hull, ShapeKind::hull, Task::intersect)) return;
  const Vec3d at_a(1000, -300, 50), at_b(-70, 4000, 900);
  for (const double gap : {0.25, -0.25}) {
    Pair pair = stacked(hexagonal_prism(), hexagonal_prism(), gap, motions()[1]);
    pair.a = hexagonal_prism(at_a);
    pair.b = hexagonal_prism(at_b);
    pair.at_a.translation -= pair.at_a.rotation * at_a;
    pair.at_b.translation -= pair.at_b.rotation * at_b;
    EXPECT_EQ(ask(*entry_, scalar_, Task::intersect, pair).answer,
              gap > 0 ? Answer::separated : Answer::overlapping);
    const Outcome outcome = ask(*entry_, scalar_, Task::penetration, pair);
    if (gap < 0) {
      EXPECT_NEAR(outcome.distance, gap, 5e-3);
    }
  }
}

TEST_P(BulletNarrowPhaseTest, LeavesAloneWhatIsNotAsked) {
  const Pair pair = stacked(box({1, 1, 1}), box({1, 1, 1}), -0.5, motions()[1]);
  const std::vector<Shape> shapes = {pair.a, pair.b};
  const std::vector<Pose> poses = {pair.at_a, pair.at_b};
  const std::vector<std::uint32_t> first = {0, 1}, second = {1, 0}, shape_of = {0, 1};
  const auto algorithm = entry_->make({.scalar = scalar_});
  algorithm->bind(shapes);
  std::vector<Outcome> outcomes(2);
  outcomes[0].distance = 42;
  outcomes[0].normal = outcomes[0].witness_b = Vec3d(1, 2, 3);
  const PairBatch batch = {ShapeKind::box, ShapeKind::box, {first, second, shape_of, poses}};
  algorithm->solve(Task::intersect, batch, outcomes);
  EXPECT_EQ(outcomes[0].answer, Answer::overlapping);
  EXPECT_EQ(outcomes[1].answer, Answer::overlapping);
  EXPECT_EQ(outcomes[0].distance, 42);
  EXPECT_EQ(outcomes[0].normal, Vec3d(1, 2, 3));
  EXPECT_EQ(outcomes[0].witness_b, Vec3d(1, 2, 3));
  EXPECT_TRUE(std::isnan(outcomes[1].distance));
}

// No size, no volume, one centre, sizes far from 1: any answer may come, with a status, but one.
TEST_P(BulletNarrowPhaseTest, EndsOnDegenerateInput) {
  std::vector<Shape> shapes = bounded_shapes();
  for (const double size : {0.0, 1e-6, 1e6}) {
    shapes.push_back(round(ShapeKind::sphere, size));
    shapes.push_back(round(ShapeKind::capsule, size, size));
    shapes.push_back(round(ShapeKind::capsule, 0, size));
    shapes.push_back(box({size, size, 0}));
    shapes.push_back(box({size, size, size}));
    shapes.push_back(round(ShapeKind::cylinder, size, 0));
    shapes.push_back(round(ShapeKind::cone, 0, size));
    shapes.push_back(round(ShapeKind::cone, size, 0));
    shapes.push_back(ellipsoid({size, 0, size}));
  }
  shapes.push_back(hull({{1, 2, 3}}, 0));
  shapes.push_back(hull({{1, 2, 3}, {-1, 2, 3}}, 1));
  shapes.push_back(hull({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, 2));
  shapes.push_back(hull({{1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}}, 0));
  shapes.push_back(hull({{1, 0, 0}, {0, 1, 0}, {-1, 0, 1e-9}, {0, -1, 0}, {0, 0, 0}}));
  RandomPoses random;
  const Pose any = random.pose(0.5);
  int asked = 0;
  for (const Shape& a : shapes) {
    for (const Shape& b : shapes) {
      for (const Pose& at_b : {Pose{}, any, Pose{any.rotation, Vec3d(0, 0, 2)}}) {
        for (const Task task : {Task::intersect, Task::distance, Task::penetration}) {
          if (!offers(*entry_, a.kind, b.kind, task)) continue;
          ++asked;
          const Outcome outcome = ask(*entry_, scalar_, task, {a, b, Pose{}, at_b});
          EXPECT_NE(outcome.status, Status::unsupported);
          EXPECT_EQ(outcome.answer == Answer::unknown,
                    outcome.status == Status::degenerate || outcome.status == Status::not_converged)
              << to_string(outcome.answer) << " " << to_string(outcome.status);
        }
      }
    }
  }
  EXPECT_GT(asked, 50);
}

TEST(BulletNarrowPhase, SaysWhatItTakes) {
  for (const char* name : bullet_names) {
    const NarrowPhaseEntry* entry = registry::find<NarrowPhaseEntry>(name);
    ASSERT_NE(entry, nullptr) << name;
    EXPECT_TRUE(offers(*entry, Precision::float32));
    if (is_built(entry->info)) {
      EXPECT_EQ(offers(*entry, Precision::float64), entry->info.lacking.empty());
    }
    EXPECT_FALSE(offers(*entry, ShapeKind::sphere, ShapeKind::halfspace, Task::intersect));
    EXPECT_TRUE(offers(*entry, ShapeKind::box, ShapeKind::box, Task::penetration));
    EXPECT_EQ(is_built(entry->info), static_cast<bool>(entry->make));
  }
  EXPECT_FALSE(offers(*registry::find<NarrowPhaseEntry>("bullet-box-box"), ShapeKind::box,
                      ShapeKind::hull, Task::intersect));
  EXPECT_TRUE(offers(*registry::find<NarrowPhaseEntry>("bullet-sat"), ShapeKind::hull,
                     ShapeKind::box, Task::intersect));
}

TEST(BulletNarrowPhase, MprStopsAtTheCapItIsGiven) {
  const NarrowPhaseEntry* entry = registry::find<NarrowPhaseEntry>("bullet-mpr");
  ASSERT_NE(entry, nullptr);
  if (!is_built(entry->info)) GTEST_SKIP() << entry->info.reason;
  Pair pair = stacked(ellipsoid({1, 2, 3}), ellipsoid({3, 1, 2}), -1, motions()[1]);
  pair.at_b.translation += Vec3d(0.3, 0.2, 0.1);
  const Outcome capped = ask(*entry, Precision::float32, Task::penetration, pair, 2);
  EXPECT_EQ(capped.status, Status::not_converged);
  EXPECT_EQ(capped.answer, Answer::unknown);
  const Outcome free = ask(*entry, Precision::float32, Task::penetration, pair);
  EXPECT_EQ(free.answer, Answer::overlapping);
  EXPECT_GT(free.iterations, 2);
  EXPECT_EQ(free.support_calls, 2 * free.iterations);
}

INSTANTIATE_TEST_SUITE_P(Peers, BulletNarrowPhaseTest,
                         testing::Combine(testing::ValuesIn(bullet_names),
                                          testing::Values(Precision::float32, Precision::float64)),
                         build_name);

}  // namespace
}  // namespace touchstone
