// What balls tell of moving pairs, against exact casts: near and far, at every scale, and turned by matrices that
// stretch.
#include "algorithms/kernels/motion/linear/ball_verdict.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/algorithms/cast/linear_cast.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using namespace reference;

struct Asked {
  BallVerdict verdict;
  Vec3d point;
};

Asked ask(const MovingPairCase& c, double tolerance) {
  const std::vector<Shape> shapes = {c.a, c.b};
  const auto supports = make_support_shapes<double>(shapes);
  const std::vector<double> inner = inner_radii(shapes, supports);
  const MovingBody a{&supports[0], &c.pose_a, &c.motion_a, inner[0], stretch_of(c.pose_a)};
  const MovingBody b{&supports[1], &c.pose_b, &c.motion_b, inner[1], stretch_of(c.pose_b)};
  const CentreOffset offset = centre_offset(supports[0], c.pose_a, supports[1], c.pose_b);
  return {ask_balls(offset, a, b, outer_reach(a) + outer_reach(b), tolerance),
          point_in_balls(offset, a, b)};
}

TEST(BallVerdict, IsThatOfTheExactCast) {
  Random random(52);
  const CastEntry& exact = *registry::find<CastEntry>("exact");
  int misses = 0, overlaps = 0, open = 0;
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (int i = 0; i < drawn(24, 6); ++i) {
      MovingPairCase c = passing(a, b, features[static_cast<std::size_t>(i % 3)],
                                 random.uniform(-1, 3), 2, random);
      if (i % 4 == 0) c.pose_b.translation = c.pose_a.translation;
      if (i % 6 == 1) c.pose_b.rotation *= 1 + random.uniform(-1e-3, 1e-3);
      const double scale = std::ldexp(1, random.below(61) - 30);
      c = scaled(c, scale);
      const double tolerance = i % 2 == 0 ? 0 : 1e-3 * scale;
      const Asked asked = ask(c, tolerance);
      const CastOutcome truth = solve(exact, c);
      switch (asked.verdict) {
        case BallVerdict::open: ++open; continue;
        case BallVerdict::miss:
          ++misses;
          EXPECT_NE(truth.answer, CastAnswer::hit) << i;
          continue;
        case BallVerdict::overlap:
          ++overlaps;
          EXPECT_NE(truth.answer, CastAnswer::miss) << i;
          EXPECT_FALSE(truth.toi > 0) << i;
          EXPECT_TRUE(asked.point.allFinite());
          continue;
      }
    }
  });
  EXPECT_GT(misses, drawn(100, 25));
  EXPECT_GT(overlaps, drawn(100, 25));
  EXPECT_GT(open, drawn(100, 25));
}

TEST(BallVerdict, IsOpenWhereSquaresHaveNoDigits) {
  Random random(53);
  for (const double scale : {0x1p-600, 0x1p600}) {
    const MovingPairCase c =
        scaled(passing(ShapeKind::box, ShapeKind::hull, ContactFeature::face, 3, 2, random), scale);
    EXPECT_EQ(ask(c, 0).verdict, BallVerdict::open);
  }
}

}  // namespace
}  // namespace touchstone
