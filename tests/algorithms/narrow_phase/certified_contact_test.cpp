// Certified at contact and inside it: polytopes and rounded polytopes that touch exactly, or miss
// it by less than rounding, are decided as the oracle decides them, and without asking it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "algorithms/narrow_phase/certified/placed_body.h"
#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/bodies.h"

namespace touchstone::certified_contact_test {
namespace {

using namespace test;

struct ContactCount {
  int asked = 0, of_oracle = 0, touching = 0, separated = 0, overlapping = 0;

  void expect_all(int least) const {
    EXPECT_GT(touching, least);
    EXPECT_GT(separated, least);
    EXPECT_GT(overlapping, least);
  }
  // The share of the queries that the oracle answered.
  double share_of_oracle() const { return static_cast<double>(of_oracle) / asked; }
};

void grade(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
           const std::vector<Task>& tasks, ContactCount& count) {
  const oracle::Solid solid_a(a), solid_b(b);
  oracle::Oracle oracle;
  const oracle::Measure exact =
      oracle.measure(oracle::Body(solid_a, pose_a), oracle::Body(solid_b, pose_b));
  ++(exact.answer == Answer::touching    ? count.touching
     : exact.answer == Answer::separated ? count.separated
                                         : count.overlapping);
  const NarrowPhaseEntry& certified = *registry::find<NarrowPhaseEntry>("certified");
  for (const Task task : tasks) {
    // No tolerance is taken to be below 4e-15.
    const bool tight = count.asked++ % 3 == 0;
    const NarrowPhaseSettings settings{.tolerance = tight ? std::optional(0.0) : std::nullopt};
    const Outcome outcome = ask(certified, settings, task, a, pose_a, b, pose_b);
    if (outcome.support_calls < 0) ++count.of_oracle;
    ASSERT_EQ(outcome.answer, exact.answer) << exact.lower << " to " << exact.upper;
    ASSERT_EQ(outcome.status, Status::ok);
    const bool has_interval =
        exact.answer != Answer::touching && asks_for_number(task, exact.answer);
    if (!has_interval) continue;
    ASSERT_LE(outcome.lower, exact.upper);
    ASSERT_GE(outcome.upper, exact.lower);
    const double size = std::max(PreparedShape(a).size(), PreparedShape(b).size());
    const double roundings = 0x1p-51 * std::abs(outcome.distance);
    ASSERT_LE(outcome.upper - outcome.lower, std::max((tight ? 4e-15 : 2e-13) * size, roundings));
  }
}

// A few units in the last place, of either sign, or none.
double nudge(Random& random) {
  const int steps = static_cast<int>(random() % 5) - 2;
  return random() % 2 == 0 ? 0 : std::ldexp(steps, -50);
}

TEST(CertifiedContact, BoxesThatMeetInAFaceAnEdgeOrACorner) {
  Random random(1);
  ContactCount count;
  for (int i = 0; i < 3000; ++i) {
    const auto whole = [&] { return 1 + static_cast<double>(random() % 8); };
    const Vec3d half_a(whole(), whole(), whole()), half_b(whole(), whole(), whole());
    // One, two or three coordinates are those at which faces meet.
    const std::size_t meeting = 1 + random() % 3;
    Vec3d offset;
    for (std::size_t k = 0; k < 3; ++k) {
      const double reach = half_a[k] + half_b[k];
      offset[k] = k < meeting ? reach : std::floor(uniform(random, -reach, reach));
    }
    offset[0] += nudge(random);
    const Mat3d rotation = i % 3 == 0 ? random_rotation(random) : Mat3d(Mat3d::Identity());
    grade(box(half_a.x(), half_a.y(), half_a.z()), {rotation, Vec3d::Zero()},
          box(half_b.x(), half_b.y(), half_b.z()), {rotation, rotation * offset},
          {Task::intersect, Task::distance}, count);
  }
  count.expect_all(300);
  EXPECT_LT(count.share_of_oracle(), 0.02);
}

// A hull of points with whole coordinates, below or above the plane z = 0, some of them in it.
Shape half_of_grid(Random& random, double side, std::size_t in_plane) {
  const auto whole = [&](std::size_t most) { return static_cast<double>(random() % most) - 20; };
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < in_plane; ++i) points.emplace_back(whole(40), whole(40), 0);
  for (int i = 0; i < 12; ++i) points.emplace_back(whole(40), whole(40), side * (1 + i));
  return bare_hull(std::move(points), 3);
}

TEST(CertifiedContact, HullsThatMeetInAPlaneUnderAnyRotation) {
  Random random(2);
  ContactCount count;
  for (int i = 0; i < 2000; ++i) {
    const Shape a = half_of_grid(random, -1, 3 + random() % 4);
    const Shape b = half_of_grid(random, 1, 3 + random() % 4);
    const Mat3d rotation = random_rotation(random);
    const Vec3d off = i % 2 == 0 ? Vec3d(0, 0, 0) : Vec3d(nudge(random) * rotation.col(2));
    grade(a, {rotation, Vec3d::Zero()}, b, {rotation, off}, {Task::intersect, Task::distance},
          count);
  }
  count.expect_all(100);
  EXPECT_LT(count.share_of_oracle(), 0.05);
}

TEST(CertifiedContact, RoundedBodiesAreComparedByTheSquareOfTheirDistance) {
  Random random(3);
  ContactCount count;
  const std::vector<Vec3d> whole_lengths = {{3, 4, 0}, {2, 3, 6}, {1, 4, 8}, {0, 0, 5}, {2, 6, 9}};
  for (int i = 0; i < 2000; ++i) {
    Vec3d line = whole_lengths[random() % whole_lengths.size()];
    const double length = line.norm();
    const double radius_a = 0.25 * static_cast<double>(1 + random() % 8);
    const double radius_b = length - radius_a + nudge(random);
    Shape a = sphere(radius_a), b = sphere(radius_b);
    Pose pose_b;
    pose_b.translation = line;
    // Capsules' segments are square to the line between them, if that has no height.
    if (line.z() == 0 && i % 2 == 0) {
      for (Shape* shape : {&a, &b}) {
        shape->kind = ShapeKind::capsule;
        shape->half_length = static_cast<double>(random() % 4) + 1;
      }
    }
    grade(a, {}, b, pose_b, {Task::intersect, Task::distance}, count);
  }
  count.expect_all(100);
  EXPECT_LT(count.share_of_oracle(), 0.02);
}

TEST(CertifiedContact, BallsOnFacesAndEdges) {
  Random random(4);
  ContactCount count;
  for (int i = 0; i < 2000; ++i) {
    const Shape below = i % 2 == 0 ? half_of_grid(random, -1, 3) : box(4, 5, 6);
    const double radius = 0.5 * static_cast<double>(1 + random() % 9);
    const double top = i % 2 == 0 ? 0 : 6;
    Pose pose_b;
    pose_b.translation = {std::floor(uniform(random, -4, 4)), std::floor(uniform(random, -5, 5)),
                          top + radius + nudge(random)};
    grade(below, {}, sphere(radius), pose_b, {Task::intersect, Task::distance}, count);
  }
  EXPECT_GT(count.touching, 300);
  EXPECT_GT(count.separated, 300);
  EXPECT_GT(count.overlapping, 100);
  EXPECT_LT(count.share_of_oracle(), 0.02);
}

// A turn by quarters: each row and each column has one number, 1 or -1.
Mat3d quarter_turns(Random& random) {
  Mat3d turn = Mat3d::Zero();
  const int first = static_cast<int>(random() % 3);
  const int step = random() % 2 == 0 ? 1 : 2;
  for (int k = 0; k < 3; ++k) turn(k, (first + step * k) % 3) = random() % 2 == 0 ? 1 : -1;
  return turn;
}

// Sizes and places are decimal, so that rounding decides which gaps are zero.
TEST(CertifiedContact, BoxesThatStandLevel) {
  Random random(12);
  ContactCount upright, turned;
  const auto tenths = [&] { return 0.1 * static_cast<double>(1 + random() % 20); };
  for (int i = 0; i < 4000; ++i) {
    const Vec3d half_a(tenths(), tenths(), tenths()), half_b(tenths(), tenths(), tenths());
    Pose pose_a, pose_b;
    pose_a.translation = {tenths(), tenths(), i % 5 == 0 ? 1e3 * tenths() : tenths()};
    const bool is_turned = i % 2 == 0;
    if (is_turned) {
      for (Pose* pose : {&pose_a, &pose_b}) {
        const double angle = uniform(random, 0, 6);
        pose->rotation << std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0,
            0, 0, 1;
      }
    } else {
      pose_a.rotation = quarter_turns(random);
      pose_b.rotation = quarter_turns(random);
    }
    const Vec3d reach = pose_a.rotation.cwiseAbs() * half_a + pose_b.rotation.cwiseAbs() * half_b;
    const std::size_t meeting = is_turned ? 4 : 1 + random() % 7;
    for (int k = 0; k < 3; ++k) {
      const bool meets = (meeting >> k & 1) != 0;
      pose_b.translation[k] =
          pose_a.translation[k] + (meets ? reach[k] : reach[k] * uniform(random, -1.05, 1.05));
      if (meets && random() % 4 == 0) pose_b.translation[k] += nudge(random);
    }
    grade(box(half_a.x(), half_a.y(), half_a.z()), pose_a, box(half_b.x(), half_b.y(), half_b.z()),
          pose_b, {Task::intersect, Task::distance, Task::penetration, Task::signed_distance},
          is_turned ? turned : upright);
  }
  upright.expect_all(100);
  turned.expect_all(100);
  EXPECT_EQ(upright.of_oracle, 0);
  EXPECT_LT(turned.share_of_oracle(), 0.02);
}

TEST(CertifiedContact, BodiesThatStandOnAPlane) {
  Random random(6);
  ContactCount count;
  for (int i = 0; i < 2000; ++i) {
    Shape plane;
    plane.kind = ShapeKind::halfspace;
    plane.normal = {0, 0, 1};
    plane.offset = std::floor(uniform(random, -3, 3));
    const Shape stands = i % 3 == 0   ? box(1, 2, 3)
                         : i % 3 == 1 ? sphere(3)
                                      : half_of_grid(random, 1, 3 + random() % 4);
    Pose pose_a, pose_b;
    pose_b.translation = {0, 0, std::floor(uniform(random, -5, 5))};
    pose_a.translation = pose_b.translation;
    pose_a.translation.z() += plane.offset + (i % 3 == 2 ? 0 : 3) + nudge(random);
    grade(stands, pose_a, plane, pose_b, {Task::intersect, Task::distance}, count);
  }
  count.expect_all(100);
  EXPECT_LT(count.share_of_oracle(), 0.02);
}

// Fills the memory that the next calls find on the stack. Bytes of 0xff make doubles that are NaN.
[[gnu::noinline]] void fill_stack(unsigned char byte) {
  std::array<volatile unsigned char, 1 << 16> memory;
  for (volatile unsigned char& each : memory) each = byte;
}

// An answer depends on no memory that nobody has set.
TEST(CertifiedContact, AnswersDoNotDependOnWhatIsOnTheStack) {
  Random random(8);
  const NarrowPhaseEntry& certified = *registry::find<NarrowPhaseEntry>("certified");
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  for (int i = 0; i < 600; ++i) {
    const std::vector<Shape> shapes = {half_of_grid(random, -1, 1 + random() % 5),
                                       half_of_grid(random, 1, 1 + random() % 5)};
    const Mat3d rotation = i % 2 == 0 ? random_rotation(random) : Mat3d(Mat3d::Identity());
    const std::vector<Pose> poses = {{rotation, Vec3d::Zero()},
                                     {rotation, Vec3d(nudge(random) * rotation.col(2))}};
    const std::array<std::uint32_t, 1> first = {0}, second = {1};
    const std::array<std::uint32_t, 2> shape_of = {0, 1};
    const std::unique_ptr<NarrowPhase> narrow = certified.make({});
    narrow->bind(shapes);
    for (const Task task : all_tasks) {
      const auto solve = [&](unsigned char byte) {
        std::array<Outcome, 1> outcome;
        fill_stack(byte);
        narrow->solve(task, {ShapeKind::hull, ShapeKind::hull, {first, second, shape_of, poses}},
                      outcome);
        return outcome[0];
      };
      const Outcome x = solve(0), y = solve(0xff);
      ASSERT_EQ(x.answer, y.answer) << i;
      ASSERT_TRUE(same(x.distance, y.distance) && same(x.lower, y.lower) && same(x.upper, y.upper))
          << i;
      for (int k = 0; k < 3; ++k) {
        ASSERT_TRUE(same(x.normal[k], y.normal[k]) && same(x.witness_a[k], y.witness_a[k]) &&
                    same(x.witness_b[k], y.witness_b[k]))
            << i;
      }
    }
  }
}

// More vertices in the plane of contact than are looked at exactly: the oracle decides.
TEST(CertifiedContact, FacesOfManyVertices) {
  Random random(7);
  ContactCount count;
  std::vector<Vec3d> points;
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.0314159 * i;
    for (const double z : {-1.0, 1.0}) points.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  const Shape drum = bare_hull(points, 3);
  for (int i = 0; i < 60; ++i) {
    const Mat3d rotation = i % 2 == 0 ? random_rotation(random) : Mat3d(Mat3d::Identity());
    const Vec3d offset(uniform(random, -1, 1), 0, 2 + nudge(random));
    grade(drum, {rotation, Vec3d::Zero()}, drum, {rotation, rotation * offset}, {Task::intersect},
          count);
  }
  count.expect_all(3);
  EXPECT_GT(count.share_of_oracle(), 0.5);
}

TEST(CertifiedContact, DepthsAreProvenWithoutTheOracle) {
  Random random(5);
  ContactCount count;
  for (int i = 0; i < 1500; ++i) {
    const double deep = std::pow(10.0, uniform(random, -7, -0.3));
    const bool boxes = i % 3 == 0;
    const Shape a = boxes ? box(1, 2, 3) : random_hull(random, 8 + static_cast<int>(random() % 8));
    const Shape b = boxes ? box(2, 1, 1) : random_hull(random, 8 + static_cast<int>(random() % 8));
    const Pose pose_a{random_rotation(random), random_direction(random)};
    Pose pose_b{random_rotation(random), random_direction(random)};
    const oracle::Solid solid_a(a), solid_b(b);
    oracle::Oracle oracle;
    const oracle::Measure now =
        oracle.measure(oracle::Body(solid_a, pose_a), oracle::Body(solid_b, pose_b));
    pose_b.translation -= (now.middle() + deep) * now.normal.stableNormalized();
    grade(a, pose_a, b, pose_b, {Task::penetration}, count);
  }
  EXPECT_GT(count.overlapping, 1400);
  EXPECT_LT(count.share_of_oracle(), 0.1);
}

}  // namespace
}  // namespace touchstone::certified_contact_test
