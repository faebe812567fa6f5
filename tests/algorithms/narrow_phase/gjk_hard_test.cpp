// GJK and EPA where such algorithms break: round shapes against closed forms, degenerate bodies,
// coincident centres, containment, half-spaces, large hulls, iteration caps, collected cases.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/reproducible_math.h"
#include "tests/algorithms/narrow_phase/polytope_reference.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::gjk_hard_test {
namespace {

using namespace reference;
using testing::AnyOf;

std::unique_ptr<NarrowPhase> make_gjk(const NarrowPhaseSettings& settings = {}) {
  return registry::find<NarrowPhaseEntry>("gjk")->make(settings);
}

Body at(Shape shape, const Vec3d& place, const Mat3d& rotation = Mat3d::Identity()) {
  return {std::move(shape), {.rotation = rotation, .translation = place}};
}

Shape segment(double reach) { return make_hull({{0, 0, -reach}, {0, 0, reach}}); }
Shape point() { return make_hull({{0, 0, 0}}); }
Shape square(double reach) {
  return make_hull(
      {{reach, reach, 0}, {-reach, reach, 0}, {-reach, -reach, 0}, {reach, -reach, 0}});
}

TEST(GjkRound, SpheresAndCapsulesHaveTheirClosedForms) {
  const auto gjk = make_gjk();
  Random random(5);
  int apart = 0;
  int common = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto make = [&]() {
      const double radius = random.uniform(0, 1);
      return random.below(2) ? make_sphere(radius) : make_capsule(radius, random.uniform(0, 1));
    };
    const Body a = at(make(), random.vector(1), random.rotation());
    Body b = at(make(), random.vector(1), random.rotation());
    Vec3d normal;
    if (i % 2) {
      const auto thrown = static_cast<double>(signed_distance(a, b, normal));
      const double target = (i % 4 == 1 ? 1 : -1) * std::pow(10, random.uniform(-12, -1));
      b.pose.translation += (target - thrown) * normal;
    }
    const auto truth = static_cast<double>(signed_distance(a, b, normal));
    const double size = pair_size(a, b);
    if (std::abs(truth) < 1e-12 * size) continue;
    ++(truth > 0 ? apart : common);
    const Task task = truth > 0 ? Task::distance : Task::penetration;
    const Outcome outcome = query(*gjk, task, a, b);
    ASSERT_EQ(outcome.status, Status::ok) << i;
    ASSERT_EQ(outcome.answer, truth > 0 ? Answer::separated : Answer::overlapping) << i;
    EXPECT_NEAR(outcome.distance, truth, 1e-14 * size);
    EXPECT_LE(outside_by(a, outcome.witness_a), 1e-14 * size);
    EXPECT_LE(outside_by(b, outcome.witness_b), 1e-14 * size);
    EXPECT_EQ(query(*gjk, Task::intersect, a, b).answer, outcome.answer);
    EXPECT_LT(outcome.iterations, 10);
  }
  EXPECT_GT(apart, 400);
  EXPECT_GT(common, 400);
}

TEST(GjkRound, SphereAgainstBoxAndCylinder) {
  const auto gjk = make_gjk();
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const Shape shape = random.below(2) ? make_box(1, random.uniform(0, 1), 0.5)
                                        : make_cylinder(random.uniform(0.1, 1), 0.7);
    const Body other = at(shape, random.vector(1), random.rotation());
    Body sphere = at(make_sphere(random.uniform(0, 1)), random.vector(3));
    const double off = outside_by(other, sphere.pose.translation);
    if (off == 0) continue;  // the centre is inside: no closed form here
    const double truth = off - sphere.shape.radius;
    const Task task = truth > 0 ? Task::distance : Task::penetration;
    const Outcome outcome = query(*gjk, task, other, sphere);
    ASSERT_EQ(outcome.status, Status::ok);
    ASSERT_EQ(outcome.answer, truth > 0 ? Answer::separated : Answer::overlapping);
    EXPECT_NEAR(outcome.distance, truth, 1e-9);
  }
}

// GJK with EPA behind it, all that go through kernels/gjk/gjk_query. Under the sanitizers gjk-templated is not built.
std::vector<const NarrowPhaseEntry*> ours() {
  std::vector<const NarrowPhaseEntry*> entries;
  for (const char* name : {"gjk", "gjk-nesterov", "gjk-switched", "gjk-templated", "gjk-lanes"}) {
    const auto* entry = registry::find<NarrowPhaseEntry>(name);
    if (entry != nullptr && is_built(entry->info)) entries.push_back(entry);
  }
  return entries;
}

// Asks for the verdict and the signed distance in float. Each must hold for `truth`. Returns the
// verdict.
Answer ask_in_float(const NarrowPhaseEntry& entry, const Body& a, const Body& b, double truth) {
  const auto algorithm = entry.make({.scalar = Precision::float32});
  Answer verdict = Answer::unknown;
  for (const Task task : {Task::signed_distance, Task::intersect}) {
    const Outcome outcome = query(*algorithm, task, a, b);
    verdict = outcome.answer;
    SCOPED_TRACE(testing::Message() << entry.info.name << " " << to_string(task) << ", truly "
                                    << truth << ": " << to_string(outcome.answer));
    EXPECT_FALSE(outcome.answer == Answer::overlapping && truth > 0);
    EXPECT_FALSE(outcome.answer == Answer::separated && truth < 0);
    const bool bounded = outcome.status == Status::ok && !std::isnan(outcome.lower);
    if (task == Task::signed_distance || outcome.answer == Answer::touching) {
      EXPECT_TRUE(bounded || outcome.status != Status::ok);
    }
    if (bounded) {
      EXPECT_LE(outcome.lower, truth);
      EXPECT_GE(outcome.upper, truth);
    }
  }
  return verdict;
}

Mat3d matrix(std::initializer_list<double> rows) {
  Mat3d m;
  std::copy(rows.begin(), rows.end(), m.transpose().reshaped().begin());
  return m;
}

// A radius of about the rounding beside a smooth body: the simplex of GJK is within rounding of the
// origin, which may be on either side of it.
TEST(GjkRound, RadiiWithinRoundingMakeNoOverlap) {
  struct Case {
    Body a, b;
    double truth;
  };
  const Case cases[] = {
      {at(make_capsule(4e-7, 0.6), {0, 0, 0}),
       at(make_ellipsoid(0.603033, 0.420612, 0.19961), {0.248, 0.43365, 0},
          matrix({0.5159273841032186, 0.24039883852803587, 0.8222088133599524, 0.5076995723554767,
                  0.6872692085646589, -0.519521105624183, -0.6899710708156365, 0.6854702279408484,
                  0.23253061743401682})),
       8.723468626463867e-07},
      {at(make_capsule(6e-9, 0.955258656), {0, 0, 0}),
       at(make_ellipsoid(0.703143774, 0.888003935, 0.81148411),
          {0.128946111, -0.51996794, -1.48576569},
          matrix({0.27532946891740245, 0.43500005972823863, -0.8573031153460774, 0.9081187483023729,
                  0.17494127997709175, 0.38041541443757015, 0.31545843232887694,
                  -0.8832726060488946, -0.3468652200440421})),
       1.910275771333385e-06},
      {at(make_sphere(5e-7), {-0.2614, -0.06322, -0.237235}),
       at(make_ellipsoid(0.408929, 0.5671, 0.340527), {0, 0, 0},
          matrix({-0.31620709626269217, 0.05262471825727939, 0.9472294924153588, 0.5547710257111771,
                  -0.7996888531322437, 0.22962327235584176, 0.7695727264557165, 0.5981039852771243,
                  0.22367262123723664})),
       4.5047509363909095e-07}};
  for (const Case& c : cases) {
    for (const NarrowPhaseEntry* entry : ours()) ask_in_float(*entry, c.a, c.b, c.truth);
  }
}

// The same at random: a ball or a capsule at a known distance from a point of an ellipsoid, along
// the normal there.
TEST(GjkRound, TinyRadiiBesideEllipsoids) {
  Random random(17);
  std::map<Answer, int> answers;
  const std::vector<const NarrowPhaseEntry*> entries = ours();
  for (int i = 0; i < drawn(4000, 1000); ++i) {
    const Vec3d radii{random.uniform(0.2, 0.6), random.uniform(0.2, 0.6), random.uniform(0.2, 0.6)};
    const Body ellipsoid =
        at(make_ellipsoid(radii.x(), radii.y(), radii.z()), {0, 0, 0}, random.rotation());
    const Vec3d on_ball = random.rotation().col(0);
    const Vec3d place = ellipsoid.pose.rotation * radii.cwiseProduct(on_ball);
    const Vec3d normal = (ellipsoid.pose.rotation * on_ball.cwiseQuotient(radii)).normalized();
    const double radius = std::pow(10, random.uniform(-9, -6));
    const double truth = (i % 2 ? 1 : -1) * std::pow(10, random.uniform(-7, -4.5));
    Mat3d turned = random.rotation();
    turned.col(2) = normal.cross(turned.col(0)).normalized();  // along the ellipsoid
    turned.col(1) = turned.col(2).cross(normal);
    turned.col(0) = normal;
    const Body tiny = at(i % 4 < 2 ? make_sphere(radius) : make_capsule(radius, 0.1),
                         place + (radius + truth) * normal, turned);
    for (const NarrowPhaseEntry* entry : entries) {
      ++answers[ask_in_float(*entry, tiny, ellipsoid, truth)];
    }
    if (HasFailure()) FAIL() << i;
  }
  const int least = drawn(4000, 1000) / 8;
  EXPECT_GT(answers[Answer::separated], least);
  EXPECT_GT(answers[Answer::overlapping], least);
  EXPECT_GT(answers[Answer::touching], least);
}

// Bodies without a volume: what they answer must be right or be no claim.
TEST(GjkDegenerate, PointsSegmentsAndPolygons) {
  const auto gjk = make_gjk();
  const Mat3d across = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3d::UnitX()).toRotationMatrix();
  const std::vector<Shape> flat = {point(),
                                   segment(1),
                                   square(1),
                                   make_sphere(0),
                                   make_capsule(0, 1),
                                   make_box(0, 0, 0),
                                   make_box(0, 0, 1),
                                   make_box(1, 1, 0),
                                   make_cylinder(0, 1),
                                   make_cylinder(1, 0),
                                   make_cone(0, 1),
                                   make_ellipsoid(0, 0, 0),
                                   make_ellipsoid(1, 1, 0)};
  for (const Shape& a : flat) {
    for (const Shape& b : flat) {
      for (const Mat3d& rotation : {Mat3d(Mat3d::Identity()), across}) {
        const Outcome apart =
            query(*gjk, Task::distance, at(a, {0, 0, 0}), at(b, {0, 5, 0}, rotation));
        EXPECT_EQ(apart.status, Status::ok);
        EXPECT_EQ(apart.answer, Answer::separated);
        EXPECT_GE(apart.distance, 3 - 1e-9);
        EXPECT_LE(apart.distance, 5 + 1e-9);
        // Bodies at one place touch at most, or cross without a common volume.
        for (const Task task : all_tasks) {
          const Outcome same = query(*gjk, task, at(a, {1, 2, 3}), at(b, {1, 2, 3}, rotation));
          EXPECT_NE(same.answer, Answer::separated);
          if (asks_depth(task) && !std::isnan(same.distance)) {
            EXPECT_GE(same.distance, -1 - 1e-9);  // a square pierced by a segment is one deep
            EXPECT_LE(same.distance, 1e-12);
          }
        }
      }
    }
  }
}

TEST(GjkDegenerate, CoplanarPolygonsAreNoDepthDeep) {
  const auto gjk = make_gjk();
  const Mat3d rotation = Random(7).rotation();
  const Body a = at(square(1), {0, 0, 0}, rotation);
  const Body b = at(square(1), rotation * Vec3d{0.5, 0.25, 0}, rotation);
  const Outcome outcome = query(*gjk, Task::penetration, a, b);
  EXPECT_EQ(outcome.answer, Answer::touching);
  EXPECT_EQ(outcome.status, Status::ok);
  EXPECT_NEAR(outcome.distance, 0, 1e-14);
  EXPECT_NEAR(std::abs(outcome.normal.dot(rotation.col(2))), 1, 1e-12);
}

TEST(GjkDegenerate, CoincidentCentresAndIdenticalBodies) {
  const auto gjk = make_gjk();
  for (const Mat3d& rotation : {Mat3d(Mat3d::Identity()), Random(8).rotation()}) {
    const Vec3d place{3, -2, 1};
    for (const auto& [shape, depth] : std::vector<std::pair<Shape, double>>{
             {make_sphere(0.5), 1},
             {make_capsule(0.5, 2), 1},
             {make_box(0.5, 0.5, 0.5), 1},
             {make_box(0.5, 3, 2), 1},
             {make_hull({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}),
              2 / std::sqrt(3.)}}) {
      const Body body = at(shape, place, rotation);
      EXPECT_EQ(query(*gjk, Task::intersect, body, body).answer, Answer::overlapping);
      EXPECT_EQ(query(*gjk, Task::intersect, body, body).status, Status::ok);
      const Outcome outcome = query(*gjk, Task::penetration, body, body);
      EXPECT_EQ(outcome.status, Status::ok);
      EXPECT_NEAR(outcome.distance, -depth, 1e-14);
      EXPECT_NEAR((outcome.witness_a - outcome.witness_b - depth * outcome.normal).norm(), 0,
                  1e-13);
    }
    // Smooth ones may end at the cap, but not with another answer.
    for (const Shape& shape :
         {make_cylinder(1, 1), make_cone(1, 1), make_ellipsoid(1, 2, 3), make_ellipsoid(1, 1, 1)}) {
      const Body body = at(shape, place, rotation);
      const Outcome outcome = query(*gjk, Task::penetration, body, body);
      EXPECT_EQ(outcome.answer, Answer::overlapping);
      EXPECT_THAT(outcome.status, AnyOf(Status::ok, Status::not_converged));
      EXPECT_LE(outcome.lower, outcome.distance);
      EXPECT_GE(outcome.upper, outcome.distance);
    }
  }
}

TEST(GjkDegenerate, ContainedBodies) {
  const auto gjk = make_gjk();
  Random random(9);
  for (int i = 0; i < 100; ++i) {
    const Body box = at(make_box(3, 4, 5), random.vector(1), random.rotation());
    const Vec3d local{0, random.uniform(-1, 1), random.uniform(0, 2)};
    const Body ball = at(make_sphere(0.25), box.pose(local));
    const Outcome outcome = query(*gjk, Task::penetration, box, ball);
    EXPECT_EQ(outcome.status, Status::ok);
    const double least = std::min({3., 4 - std::abs(local.y()), 5 - std::abs(local.z())});
    EXPECT_NEAR(outcome.distance, -(least + 0.25), 1e-13);
  }
}

// Resting exactly on each other cannot be told from nearly so: the bounds say how nearly.
TEST(GjkDegenerate, TouchingHasBounds) {
  const auto gjk = make_gjk();
  const Body a = at(make_box(1, 1, 1), {0, 0, 0});
  const Body b = at(make_box(1, 1, 1), {0.5, 0.25, 2});
  for (const Task task : all_tasks) {
    const Outcome outcome = query(*gjk, task, a, b);
    EXPECT_EQ(outcome.answer, Answer::touching);
    EXPECT_EQ(outcome.status, Status::ok);
    EXPECT_LE(outcome.lower, 0);
    EXPECT_GE(outcome.upper, 0);
    EXPECT_LE(outcome.upper - outcome.lower, 1e-13);
    if (task == Task::intersect) continue;
    EXPECT_NEAR(outcome.distance, 0, 1e-14);
    EXPECT_NEAR(outcome.normal.z(), 1, 1e-12);
  }
}

TEST(GjkHalfspace, AgainstEveryKind) {
  const auto gjk = make_gjk();
  Random random(10);
  const std::vector<std::pair<Shape, double>> shapes = {
      {make_sphere(0.5), 0.5},
      {make_capsule(0.5, 1), 1.5},
      {make_box(1, 2, 3), 3},
      {make_cylinder(1, 2), 2},
      {make_cone(1, 2), 2},
      {make_ellipsoid(1, 2, 3), 3},
      {make_hull({{0, 0, 1}, {0, 0, -1}, {1, 0, 0}}), 1}};
  for (const double far : {0., 1e8}) {
    for (const auto& [shape, down] : shapes) {
      const Mat3d rotation = random.rotation();
      const Vec3d n = 3 * random.direction();
      const Vec3d up = (rotation * n).normalized();
      const Body ground = {make_halfspace(n, 6), {rotation, far * random.direction()}};
      // The body stands upright on the plane; its centre this high above.
      const Mat3d upright = base::rotation_between(Vec3d::UnitZ(), up);
      for (const double gap : {0.5, 1e-3, -1e-3, -10.}) {
        const Vec3d place = ground.pose.translation + (6 / n.norm() + gap + down) * up;
        const Body body = at(shape, place, upright);
        const Task task = gap > 0 ? Task::distance : Task::penetration;
        const double slack = far > 0 ? 1e-7 : 1e-13;
        for (const bool swapped : {false, true}) {
          const Outcome outcome =
              swapped ? query(*gjk, task, ground, body) : query(*gjk, task, body, ground);
          ASSERT_EQ(outcome.status, Status::ok);
          ASSERT_EQ(outcome.answer, gap > 0 ? Answer::separated : Answer::overlapping);
          EXPECT_NEAR(outcome.distance, gap, slack);
          EXPECT_NEAR(outcome.normal.dot(up), swapped ? 1 : -1, 1e-12);
          const Vec3d between = outcome.witness_b - outcome.witness_a;
          EXPECT_NEAR((between - outcome.distance * outcome.normal).norm(), 0, slack);
        }
      }
    }
  }
}

// Bodies that rest on level ground: rounding decides the side, and the bounds must know that.
TEST(GjkHalfspace, BodiesAtRestAreOnTheSideThatIsProven) {
  const auto gjk = make_gjk();
  Random random(11);
  std::map<Answer, int> seen;
  for (int i = 0; i < 6000; ++i) {
    Shape shape = i % 4 == 0   ? make_sphere(random.uniform(0.1, 2))
                  : i % 4 == 1 ? make_capsule(random.uniform(0.1, 1), random.uniform(0.1, 2))
                               : Shape{};
    if (i % 4 > 1) {
      // Some are scanned, some in floats first, some by a cube map; the origin may be outside.
      const int counts[] = {8, 32, 120, 300};
      const Vec3d shift = i % 3 == 0 ? Vec3d(0, 0, 0) : random.vector(3);
      std::vector<Vec3d> points;
      for (int k = 0; k < counts[i / 4 % 4]; ++k) points.push_back(random.direction() + shift);
      shape = make_hull(points);
    }
    const Mat3d turn = random.rotation();
    const auto row = [&](const Vec3d& x) {
      long double sum = 0;
      for (int k = 0; k < 3; ++k) sum += static_cast<long double>(turn(2, k)) * x[k];
      return sum;
    };
    long double lowest = 0;
    if (shape.kind == ShapeKind::hull) {
      lowest = std::numeric_limits<long double>::infinity();
      for (const Vec3d& x : shape.hull->vertices) lowest = std::min(lowest, row(x));
    } else {
      if (shape.kind == ShapeKind::capsule) lowest = -std::abs(row({0, 0, shape.half_length}));
      lowest -= shape.radius;
    }
    const double offset = random.uniform(-2, 2), angle = random.uniform(0, 6);
    Mat3d about_z = Mat3d::Identity();
    about_z.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle),
        std::cos(angle);
    const Body ground = {make_halfspace({0, 0, 1}, offset), {about_z, random.vector(5)}};
    const double gaps[] = {0, 1e-15, -1e-15, 3e-14, -3e-14, 1e-3, -1e-3};
    const long double level = static_cast<long double>(ground.pose.translation.z()) + offset;
    const Vec3d place{random.uniform(-9, 9), random.uniform(-9, 9),
                      static_cast<double>(level + gaps[i % 7] - lowest)};
    const long double height = static_cast<long double>(place.z()) + lowest - level;
    const Task task = i % 5 < 2 ? Task::distance : i % 5 < 4 ? Task::penetration : Task::intersect;
    const Outcome outcome = query(*gjk, task, at(shape, place, turn), ground);
    ++seen[outcome.answer];
    const long double error = 1e-17;  // of the long doubles here
    ASSERT_EQ(outcome.status, Status::ok) << i;
    ASSERT_FALSE(outcome.answer == Answer::separated && height < -error) << i;
    ASSERT_FALSE(outcome.answer == Answer::overlapping && height > error) << i;
    if (outcome.answer != Answer::touching && !asks_for_number(task, outcome.answer)) continue;
    ASSERT_LE(outcome.lower - error, height) << i;
    ASSERT_GE(outcome.upper + error, height) << i;
    ASSERT_LE(outcome.upper - outcome.lower, 1e-12) << i;
    if (task == Task::intersect) continue;
    ASSERT_NEAR(outcome.witness_b.z(), static_cast<double>(level), 1e-13) << i;
    ASSERT_NEAR(outcome.witness_a.z() - outcome.witness_b.z(), outcome.distance, 1e-13) << i;
  }
  for (const Answer answer : {Answer::separated, Answer::overlapping, Answer::touching}) {
    EXPECT_GT(seen[answer], 500) << to_string(answer);
  }
}

TEST(GjkHalfspace, AgainstEachOther) {
  const auto gjk = make_gjk();
  const Body ground = at(make_halfspace({0, 0, 2}, 2), {0, 0, 0});  // z <= 1
  const Outcome apart =
      query(*gjk, Task::distance, ground, at(make_halfspace({0, 0, -1}, 0), {0, 0, 3}));
  EXPECT_EQ(apart.answer, Answer::separated);
  EXPECT_EQ(apart.distance, 2);
  EXPECT_EQ(apart.witness_a.z(), 1);
  EXPECT_EQ(apart.witness_b.z(), 3);
  const Outcome slab =
      query(*gjk, Task::penetration, ground, at(make_halfspace({0, 0, -1}, 0), {0, 0, 0.5}));
  EXPECT_EQ(slab.answer, Answer::overlapping);
  EXPECT_EQ(slab.distance, -0.5);
  const Body wall = at(make_halfspace({1, 0, 0}, 0), {-100, 0, 0});
  EXPECT_EQ(query(*gjk, Task::intersect, ground, wall).answer, Answer::overlapping);
  EXPECT_EQ(query(*gjk, Task::intersect, ground, wall).status, Status::ok);
  EXPECT_EQ(query(*gjk, Task::penetration, ground, wall).status, Status::degenerate);
}

// A sphere of triangles.
Shape icosphere(int level) {
  const double g = (1 + std::sqrt(5.)) / 2;
  auto hull = std::make_shared<Hull>();
  for (const double s : {1., -1.}) {
    for (const double t : {1., -1.}) {
      hull->vertices.insert(hull->vertices.end(), {{0, s, t * g}, {s, t * g, 0}, {t * g, 0, s}});
    }
  }
  for (Vec3d& v : hull->vertices) v.normalize();
  std::vector<std::array<std::uint32_t, 3>> faces;
  const double edge = 2 / std::sqrt(1 + g * g) + 1e-6;
  const auto close = [&](std::uint32_t i, std::uint32_t j) {
    return (hull->vertices[i] - hull->vertices[j]).norm() < edge;
  };
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t j = i + 1; j < 12; ++j) {
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (close(i, j) && close(j, k) && close(i, k)) faces.push_back({i, j, k});
      }
    }
  }
  for (; level > 0; --level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto between = [&](std::uint32_t i, std::uint32_t j) {
      const std::pair<std::uint32_t, std::uint32_t> key = std::minmax(i, j);
      const auto next = static_cast<std::uint32_t>(hull->vertices.size());
      const auto [place, added] = middle.try_emplace(key, next);
      if (added) {
        hull->vertices.push_back((hull->vertices[i] + hull->vertices[j]).normalized());
      }
      return place->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [i, j, k] : faces) {
      const std::uint32_t a = between(i, j);
      const std::uint32_t b = between(j, k);
      const std::uint32_t c = between(k, i);
      finer.insert(finer.end(), {{i, a, c}, {j, b, a}, {k, c, b}, {a, b, c}});
    }
    faces = std::move(finer);
  }
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::move(hull);
  return shape;
}

TEST(GjkLargeHulls, OrderOfVerticesDoesNotMatter) {
  const auto gjk = make_gjk();
  Random random(11);
  const Shape sphere = icosphere(3);
  ASSERT_EQ(sphere.hull->vertices.size(), 642);
  Shape shuffled = sphere;
  auto other = std::make_shared<Hull>(*sphere.hull);
  std::shuffle(other->vertices.begin(), other->vertices.end(), std::mt19937(5));
  shuffled.hull = other;
  int apart = 0;
  int common = 0;
  int capped = 0;
  for (int i = 0; i < drawn(200, 40); ++i) {
    const Mat3d turn_a = random.rotation();
    const Mat3d turn_b = random.rotation();
    const Vec3d place = random.uniform(1.7, 2.3) * random.direction();
    for (const Task task : {Task::distance, Task::penetration}) {
      const Outcome x = query(*gjk, task, at(sphere, {0, 0, 0}, turn_a), at(sphere, place, turn_b));
      const Outcome y =
          query(*gjk, task, at(shuffled, {0, 0, 0}, turn_a), at(shuffled, place, turn_b));
      ASSERT_NE(x.answer, Answer::unknown);
      ASSERT_EQ(x.answer, y.answer);
      if (std::isnan(x.distance)) continue;
      ++(x.answer == Answer::separated ? apart : common);
      capped += x.status != Status::ok;
      if (x.status != Status::ok || y.status != Status::ok) continue;
      EXPECT_NEAR(x.distance, y.distance, 1e-13);
      EXPECT_NEAR(x.distance, place.norm() - 2, 0.03);
    }
  }
  EXPECT_GT(apart, 50 / one_in);
  EXPECT_GT(common, 50 / one_in);
  EXPECT_EQ(capped, 0);
}

TEST(GjkSettings, CapAndToleranceAreKept) {
  NarrowPhaseSettings settings;
  settings.max_iterations = 3;
  const Body a = at(make_ellipsoid(1, 2, 3), {0, 0, 0});
  const Body b = at(make_ellipsoid(3, 1, 2), {4.5, 1, 0.5}, Random(12).rotation());
  const Outcome capped = query(*make_gjk(settings), Task::distance, a, b);
  EXPECT_EQ(capped.status, Status::not_converged);
  EXPECT_EQ(capped.iterations, 3);
  const Outcome fine = query(*make_gjk(), Task::distance, a, b);
  ASSERT_EQ(fine.status, Status::ok);
  EXPECT_LE(capped.lower, fine.distance);
  EXPECT_GE(capped.upper, fine.distance);

  NarrowPhaseSettings coarse_settings;
  coarse_settings.tolerance = 1e-2;
  const Outcome coarse = query(*make_gjk(coarse_settings), Task::distance, a, b);
  EXPECT_EQ(coarse.status, Status::ok);
  EXPECT_LT(coarse.iterations, fine.iterations);
  EXPECT_NEAR(coarse.distance, fine.distance, 0.05);

  const Body inside = at(make_ellipsoid(1, 1, 1), {0.1, 0, 0});
  settings.max_iterations = 10;
  const Outcome deep = query(*make_gjk(settings), Task::penetration, a, inside);
  EXPECT_EQ(deep.answer, Answer::overlapping);
  EXPECT_EQ(deep.status, Status::not_converged);
  EXPECT_LT(deep.lower, deep.upper);
}

Vec3d vector_of(const nlohmann::json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

Body body_of(const nlohmann::json& json) {
  const nlohmann::json& s = json["shape"];
  const std::string type = s["type"];
  const double radius = s.value("radius", 0.);
  const double half_length = s.value("half_length", 0.);
  Body body;
  body.pose.translation = vector_of(json["translation"]);
  if (json.contains("rotation")) {
    for (int i = 0; i < 9; ++i) body.pose.rotation(i / 3, i % 3) = json["rotation"][i];
  } else {
    const nlohmann::json& q = json["quaternion_wxyz"];
    body.pose.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }
  if (type == "sphere") body.shape = make_sphere(radius);
  if (type == "capsule") body.shape = make_capsule(radius, half_length);
  if (type == "cylinder") body.shape = make_cylinder(radius, half_length);
  if (type == "cone") body.shape = make_cone(radius, half_length);
  if (type == "ellipsoid") {
    const Vec3d radii = vector_of(s["radii"]);
    body.shape = make_ellipsoid(radii.x(), radii.y(), radii.z());
  }
  if (type == "box") {
    const Vec3d half = vector_of(s["half_extents"]);
    body.shape = make_box(half.x(), half.y(), half.z());
  }
  if (type == "hull") {
    std::vector<Vec3d> vertices;
    for (const auto& v : s["vertices"]) vertices.push_back(vector_of(v));
    body.shape = make_hull(std::move(vertices));
  }
  const std::string axis = s.value("axis", "z");
  Mat3d to_axis = Mat3d::Identity();
  if (axis == "x") to_axis << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  if (axis == "y") to_axis << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  body.pose.rotation = body.pose.rotation * to_axis;
  return body;
}

TEST(GjkCollected, EveryCaseIsRight) {
  const char* const folder = std::getenv("TOUCHSTONE_SHARED");
  if (folder == nullptr) GTEST_SKIP() << "TOUCHSTONE_SHARED is not set";
  std::ifstream file(std::filesystem::path(folder) / "cases" / "pairs.jsonl");
  ASSERT_TRUE(file);
  const auto gjk = make_gjk();
  int count = 0;
  int undecided = 0;
  for (std::string line; std::getline(file, line);) {
    const auto json = nlohmann::json::parse(line);
    SCOPED_TRACE(json["id"].get<std::string>());
    const Body a = body_of(json["a"]);
    const Body b = body_of(json["b"]);
    const nlohmann::json& expected = json["expect"];
    const double truth = expected["signed_distance"];
    const Task task = truth > 0 ? Task::distance : Task::penetration;
    const Outcome outcome = query(*gjk, task, a, b);
    const Outcome verdict = query(*gjk, Task::intersect, a, b);
    ++count;
    if (!expected["answer"].is_null()) {
      EXPECT_EQ(to_string(outcome.answer), expected["answer"].get<std::string>());
      EXPECT_EQ(to_string(verdict.answer), expected["answer"].get<std::string>());
      EXPECT_EQ(verdict.status, Status::ok);
    } else {
      undecided += outcome.answer == Answer::unknown;
    }
    const double extent = (b.pose.translation - a.pose.translation).norm();
    const double tolerance = std::max(expected["tolerance"].get<double>(), 1e-9 * extent);
    // The number is missing if the answer went the other way within the tolerance.
    const bool other_way = std::isnan(outcome.distance) && expected["answer"].is_null() &&
                           std::abs(truth) <= tolerance;
    if (!other_way) {
      EXPECT_NEAR(outcome.distance, truth, tolerance) << to_string(outcome.status);
    }
  }
  RecordProperty("undecided", undecided);
  EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace touchstone::gjk_hard_test
