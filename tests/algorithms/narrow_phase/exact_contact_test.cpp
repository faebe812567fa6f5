// The exact verdict near contact, against the oracle: polytopes that touch in faces, edges and
// corners under any rotation, and are moved by less than rounding.
#include "algorithms/narrow_phase/certified/exact_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone::exact_contact_test {
namespace {

using namespace reference;

// A hull of points with whole coordinates below 64, all at z <= 0 or all at z >= 0, some of them at
// 0. Under one matrix two of them touch exactly, whatever the matrix.
Shape half_of_grid(Random& random, bool upper, std::size_t in_plane) {
  std::vector<Vec3d> points;
  const auto whole = [&](int most) { return static_cast<double>(random.below(most)); };
  for (std::size_t i = 0; i < in_plane; ++i) points.push_back({whole(64), whole(64), 0});
  for (int i = 0; i < 12; ++i) {
    points.push_back({whole(64), whole(64), (upper ? 1 : -1) * (1 + whole(63))});
  }
  return reference::make_hull(std::move(points));
}

struct ContactTally {
  std::map<Answer, int> decided;
  int open = 0, measured = 0;
};

void compare(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
             const Vec3d& normal, Task task, ContactTally& tally) {
  const PreparedShape prepared_a(a), prepared_b(b);
  const oracle::Solid &solid_a = prepared_a.solid, &solid_b = prepared_b.solid;
  ExactContactFinder finder;
  SupportPair<double> pair(prepared_a.support(), pose_a, prepared_b.support(), pose_b);
  const ExactContact found =
      finder.find({prepared_a, pose_a}, {prepared_b, pose_b}, {normal, {}}, pair, task);
  oracle::Oracle oracle;
  const Answer exact = oracle.verdict({solid_a, pose_a}, {solid_b, pose_b});
  const oracle::Measure measure = oracle.measure({solid_a, pose_a}, {solid_b, pose_b});
  if (found.answer == Answer::unknown) {
    // The plane along the normal does not tell bodies that lie beside each other in it.
    if (measure.upper < 1e-9) ++tally.open;
    return;
  }
  ASSERT_EQ(found.answer, exact);
  ++tally.decided[exact];
  const bool asked = exact == Answer::touching ||
                     exact == (task == Task::distance ? Answer::separated : Answer::overlapping);
  if (!asked) return;
  ++tally.measured;
  EXPECT_LE(found.lower, measure.upper);
  EXPECT_GE(found.upper, measure.lower);
  if (std::abs(measure.middle()) < 1e-12) {
    EXPECT_LT(found.upper - found.lower, 1e-12);
  }
  EXPECT_NEAR(found.normal.norm(), 1, 1e-14);
}

TEST(ExactContact, AgreesWithTheOracle) {
  Random random(1);
  ContactTally tally;
  for (int i = 0; i < 3000; ++i) {
    const std::size_t in_a = 1 + static_cast<std::size_t>(random.below(5));
    const std::size_t in_b = 1 + static_cast<std::size_t>(random.below(5));
    const Shape a = half_of_grid(random, false, in_a), b = half_of_grid(random, true, in_b);
    const Mat3d rotation = i % 3 == 0 ? Mat3d::Identity() : random.rotation();
    const Vec3d normal = rotation.col(2).normalized();
    const Pose pose_a{rotation, Vec3d::Zero()};
    Pose pose_b = pose_a;
    if (i % 2 == 1) {
      const double step = std::ldexp(random.uniform(-1, 1), -48 - random.below(6));
      pose_b.translation = step * normal;
    }
    compare(a, pose_a, b, pose_b, normal, i % 4 < 2 ? Task::distance : Task::penetration, tally);
  }
  EXPECT_GT(tally.decided[Answer::touching], 300);
  EXPECT_GT(tally.decided[Answer::separated], 100);
  EXPECT_GT(tally.decided[Answer::overlapping], 100);
  EXPECT_GT(tally.measured, 600);
  EXPECT_LE(tally.open, 3);
}

TEST(ExactContact, BoxesOnAGrid) {
  Random random(2);
  ContactTally tally;
  for (int i = 0; i < 3000; ++i) {
    const auto whole = [&](int most) { return 1 + static_cast<double>(random.below(most)); };
    const Vec3d half_a(whole(8), whole(8), whole(8)), half_b(whole(8), whole(8), whole(8));
    const double turn = i % 2 == 0 ? 0 : random.uniform(0, 3);
    const Mat3d rotation = Eigen::AngleAxisd(turn, Vec3d::UnitZ()).toRotationMatrix();
    const Vec3d place(random.below(8), random.below(8), half_a.z() + half_b.z());
    compare(make_box(half_a.x(), half_a.y(), half_a.z()), {Mat3d::Identity(), Vec3d::Zero()},
            make_box(half_b.x(), half_b.y(), half_b.z()), {rotation, place}, Vec3d::UnitZ(),
            Task::distance, tally);
  }
  EXPECT_GT(tally.decided[Answer::touching], 2000);
  EXPECT_EQ(tally.open, 0);
}

}  // namespace
}  // namespace touchstone::exact_contact_test
