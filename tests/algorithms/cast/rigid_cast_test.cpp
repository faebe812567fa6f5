// Casts of bodies that turn: against closed forms, and against poses at many times.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/families/moving_pairs.h"
#include "tests/algorithms/cast/linear_cast.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using namespace reference;

std::vector<const CastEntry*> turning_casts() {
  std::vector<const CastEntry*> all;
  for (const CastEntry& entry : registry::entries<CastEntry>()) {
    if (entry.info.origin != Origin::peer && entry.rotation) all.push_back(&entry);
  }
  return all;
}

// The signed distance at a time, by the narrow phase gjk: negative if they overlap.
class Watch {
 public:
  explicit Watch(const MovingPairCase& c)
      : case_(c),
        swap_(c.b.kind < c.a.kind),
        gjk_(registry::find<NarrowPhaseEntry>("gjk")->make({})) {
    shapes_ = swap_ ? std::array<Shape, 2>{c.b, c.a} : std::array<Shape, 2>{c.a, c.b};
    gjk_->bind(shapes_);
  }
  double distance(double time) {
    std::array<Pose, 2> poses = {pose_at(case_.pose_a, case_.motion_a, time),
                                 pose_at(case_.pose_b, case_.motion_b, time)};
    if (swap_) std::swap(poses[0], poses[1]);
    constexpr std::array<std::uint32_t, 2> bodies = {0, 1};
    const std::span<const std::uint32_t> both(bodies);
    Outcome outcome;
    gjk_->solve(Task::distance,
                {.kind_a = shapes_[0].kind,
                 .kind_b = shapes_[1].kind,
                 .pairs = {both.subspan(0, 1), both.subspan(1, 1), bodies, poses}},
                {&outcome, 1});
    return outcome.answer == Answer::overlapping ? -1 : outcome.distance;
  }

 private:
  const MovingPairCase& case_;
  bool swap_;
  std::array<Shape, 2> shapes_;
  std::unique_ptr<NarrowPhase> gjk_;
};

class RigidCast : public testing::TestWithParam<const CastEntry*> {
 protected:
  const CastEntry& entry() const { return *GetParam(); }
  CastOutcome check(const MovingPairCase& c, double tolerance) {
    CastSettings settings;
    settings.tolerance = tolerance;
    const CastOutcome outcome = solve(entry(), c, settings);
    expect_true(entry(), c, outcome, tolerance, counts);
    ++asked;
    return outcome;
  }
  // Looks at the poses at many times.
  void watch(const MovingPairCase& c, const CastOutcome& outcome, double tolerance, int looks) {
    Watch watch(c);
    const bool hit = outcome.answer == CastAnswer::hit;
    const double free = hit ? outcome.lower : outcome.answer == CastAnswer::miss ? 1.0 : 0.0;
    for (int i = 0; i < looks && free > 0; ++i) {
      const double time = free * i / looks;
      ASSERT_GT(watch.distance(time), 0)
          << entry().info.name << ", " << c.what << " at " << time << " of " << free;
    }
    if (!hit) return;
    ASSERT_LE(watch.distance(outcome.toi), 1.01 * tolerance + 1e-13) << c.what;
    if (!std::isnan(outcome.upper)) {
      ASSERT_LE(watch.distance(outcome.upper), 0) << c.what;
    }
  }

  CastCounts counts;
  int asked = 0;
};

INSTANTIATE_TEST_SUITE_P(, RigidCast, testing::ValuesIn(turning_casts()), name_of);

TEST_P(RigidCast, RandomMotions) {
  constexpr std::array kinds = {ShapeKind::sphere,   ShapeKind::capsule, ShapeKind::box,
                                ShapeKind::cylinder, ShapeKind::cone,    ShapeKind::ellipsoid,
                                ShapeKind::hull};
  Random random(21);
  const bool slow = entry().info.origin == Origin::oracle;
  for (int i = 0; i < drawn(slow ? 90 : 600, 40); ++i) {
    const double turn = i % 3 == 0 ? 0.5 : i % 3 == 1 ? 3 : 30;
    const ShapeKind a = kinds[static_cast<std::size_t>(random.below(7))];
    const ShapeKind b = kinds[static_cast<std::size_t>(random.below(7))];
    const MovingPairCase c = families::turning(a, b, turn, random);
    const double tolerance = 1e-6;
    CastSettings settings;
    settings.tolerance = tolerance;
    const CastOutcome outcome = solve(entry(), c, settings);
    ++asked;
    if (outcome.answer == CastAnswer::hit) ++counts.hits;
    if (outcome.answer == CastAnswer::miss) ++counts.misses;
    if (outcome.answer == CastAnswer::unknown) ++counts.unknown;
    watch(c, outcome, tolerance, turn > 10 ? 150 : 40);
  }
  EXPECT_GT(counts.hits, asked / 8);
  EXPECT_GT(counts.misses, asked / 8);
  EXPECT_LE(counts.unknown, asked / 50);
}

TEST_P(RigidCast, NeedlesThatTurnInPlace) {
  Random random(22);
  for (int i = 0; i < drawn(120, 12); ++i) {
    check(families::turning_needle(i % 2 == 0, random), 1e-9);
  }
  EXPECT_GE(counts.hits, asked / 3);
  EXPECT_GE(counts.misses, asked / 3);
  EXPECT_EQ(counts.unknown, 0);
}

TEST_P(RigidCast, SeveralTurns) {
  Random random(23);
  for (int i = 0; i < drawn(40, 6); ++i) check(families::sinking_rod(i % 2 == 0, random), 1e-9);
  EXPECT_GE(counts.hits, asked / 3);
  EXPECT_GE(counts.misses, asked / 3);
  EXPECT_LE(counts.unknown, asked / 4);
}

TEST_P(RigidCast, PivotsFarFromTheBody) {
  Random random(24);
  for (int i = 0; i < drawn(60, 6); ++i) check(families::far_pivot(i % 2 == 0, random), 1e-6);
  EXPECT_EQ(counts.hits, asked / 2);
  EXPECT_EQ(counts.misses, asked / 2);
}

TEST_P(RigidCast, CornersThatPassTangentially) {
  for (const double gap : {1e-2, 1e-5, 1e-7, -1e-7, -1e-5, -1e-2}) {
    for (const double scale : {0x1p-20, 1.0, 0x1p20}) {
      check(scaled(families::passing_corner(gap), scale), scale * 1e-9);
    }
  }
  // The plain one may give up, since its bound on the speed is far above the true one.
  EXPECT_LE(counts.unknown, entry().info.name == "rigid-advancement" ? 0 : 9);
  EXPECT_GE(counts.hits, 3);
  EXPECT_GE(counts.misses, 3);
}

TEST_P(RigidCast, SizesWhoseSquaresHaveNoDigits) {
  constexpr std::array kinds = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                ShapeKind::hull};
  if (entry().info.origin == Origin::oracle) return;
  Random random(27);
  int brackets = 0;
  for (const double scale : {0x1p-600, 0x1p600}) {
    for (int i = 0; i < drawn(200, 60); ++i) {
      const ShapeKind a = kinds[static_cast<std::size_t>(random.below(4))];
      const ShapeKind b = kinds[static_cast<std::size_t>(random.below(4))];
      const MovingPairCase c = scaled(families::turning(a, b, 2, random), scale);
      CastSettings settings;
      settings.tolerance = 1e-6 * scale;
      const CastOutcome outcome = solve(entry(), c, settings);
      ++(outcome.answer == CastAnswer::hit ? counts.hits : counts.misses);
      brackets += std::isnan(outcome.upper) ? 0 : 1;
      watch(c, outcome, settings.tolerance.value(), 40);
    }
  }
  EXPECT_GT(brackets, counts.hits / 2);
  EXPECT_GT(counts.misses, counts.hits / 4);
}

// They end in hits whose normals have unit length.
TEST_P(RigidCast, BoxesWhoseRotationsAreNotQuite) {
  if (entry().info.origin == Origin::oracle) return;
  for (const double off : {1e-12, 1e-9, 1e-7, 1e-3, -1e-9, -1e-3}) {
    MovingPairCase c;
    c.a = make_box(1, 1, 1);
    c.b = make_box(0.5, 0.5, 0.5);
    c.pose_a.rotation *= 1 + off;
    c.pose_b.translation = {3, 0.1, 0.2};
    c.motion_b = {{-3, 0, 0}, {0.2, 0, 0}};
    const CastOutcome outcome = solve(entry(), c);
    EXPECT_EQ(outcome.answer, CastAnswer::hit) << off;
    EXPECT_NEAR(outcome.toi, (1.5 - off) / 3, 1e-8) << off;
    EXPECT_NEAR(outcome.normal.norm(), 1, 2e-14) << off;
  }
}

// The brackets of an algorithm and of the oracle have the truth in common.
TEST_P(RigidCast, AgreesWithTheOracle) {
  constexpr std::array kinds = {ShapeKind::capsule, ShapeKind::box, ShapeKind::cylinder,
                                ShapeKind::hull};
  const CastEntry& exact = *registry::find<CastEntry>("exact");
  if (&entry() == &exact) return;
  Random random(26);
  for (int i = 0; i < drawn(120, 48); ++i) {
    MovingPairCase c;
    c.a = random_shape(kinds[static_cast<std::size_t>(random.below(4))], random);
    c.b = random_shape(kinds[static_cast<std::size_t>(random.below(4))], random);
    c.pose_a.rotation = random.rotation();
    c.pose_b.rotation = random.rotation();
    const Vec3d towards = random.direction();
    c.pose_b.translation = random.uniform(2, 4) * towards;
    c.motion_a = {random.vector(1), 3 * random.direction()};
    c.motion_b = {random.vector(2) - 0.5 * c.pose_b.translation, random.vector(2)};
    c.what = "number " + std::to_string(i);
    const CastOutcome ours = solve(entry(), c), truth = solve(exact, c);
    if (ours.answer == CastAnswer::unknown || truth.answer == CastAnswer::unknown) {
      ++counts.unknown;
      continue;
    }
    EXPECT_EQ(ours.answer, truth.answer) << c.what;
    if (truth.answer == CastAnswer::miss) ++counts.misses;
    if (truth.answer != CastAnswer::hit) continue;
    ++counts.hits;
    EXPECT_LE(ours.lower, truth.upper) << c.what;
    if (!std::isnan(ours.upper)) {
      EXPECT_GE(ours.upper, truth.lower) << c.what;
    }
    EXPECT_LE(truth.upper - truth.lower, 1e-6) << c.what;
  }
  EXPECT_GT(counts.hits, counts.misses / 4);
  EXPECT_GT(counts.misses, counts.hits / 4);
  EXPECT_LE(counts.unknown, 3);
}

// Without rotation they answer as the linear ones.
TEST_P(RigidCast, AgreesWithTheLinearCast) {
  Random random(25);
  const CastEntry& linear = *registry::find<CastEntry>("gjk-ray-cast");
  for (int i = 0; i < drawn(200, 20); ++i) {
    const MovingPairCase c =
        i % 2 == 0
            ? meeting(ShapeKind::hull, ShapeKind::capsule, ContactFeature::vertices,
                      random.uniform(0, 1), 2, random)
            : passing(ShapeKind::hull, ShapeKind::box, ContactFeature::face, 1e-3, 2, random);
    if (!c.squarely) continue;
    EXPECT_EQ(solve(entry(), c).answer, solve(linear, c).answer) << c.what;
  }
}

}  // namespace
}  // namespace touchstone
