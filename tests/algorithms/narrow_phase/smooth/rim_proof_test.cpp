// The proof that is kept from point to point against one that starts anew, and against heights of the
// polytope along many normals.
#include "algorithms/narrow_phase/smooth/rim_proof.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone::rim_proof_test {
namespace {

constexpr std::size_t most_points = 60;

DifferencePoint<double> difference_point(const Vec3d& v) { return {v, v, Vec3d::Zero()}; }

double height_of(const std::vector<Vec3d>& points, const Vec3d& normal) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3d& p : points) most = std::max(most, normal.dot(p));
  return most;
}

TEST(RimProof, KeepsWhatIsProven) {
  reference::Random random(5);
  EpaHull<double> surface(most_points + 4);
  RimProof kept(surface.face_capacity()), anew(surface.face_capacity());
  int proven = 0, failed = 0, on_rim = 0;
  for (int repeat = 0; repeat < drawn(300, 30); ++repeat) {
    const std::array corners{Vec3d(0.3, 0.3, 0.3), Vec3d(0.3, -0.3, -0.3), Vec3d(-0.3, 0.3, -0.3),
                             Vec3d(-0.3, -0.3, 0.3)};
    std::vector<Vec3d> points(corners.begin(), corners.end());
    ASSERT_TRUE(surface.start({difference_point(points[0]), difference_point(points[1]),
                               difference_point(points[2]), difference_point(points[3])}));
    const double cosine = repeat % 3 == 0 ? 0 : random.uniform(0.3, 0.99);
    const Rim rim{random.direction(), cosine, random.uniform(0.2, 0.85)};
    kept.start(surface, rim);
    for (;;) {
      const RimProof::Failure failure = kept.failure(surface);
      anew.start(surface, rim);
      const RimProof::Failure again = anew.failure(surface);
      ASSERT_EQ(failure.face < 0, again.face < 0);
      if (failure.face < 0) {
        for (int k = 0; k < 200; ++k) {
          const Vec3d m = random.direction();
          if (cosine == 0 || m.dot(rim.normal) < cosine) {
            EXPECT_GE(height_of(points, m), rim.height * (1 - 1e-12));
          }
        }
        ++proven;
        break;
      }
      EXPECT_LE((failure.along - again.along).norm(), 1e-9);
      EXPECT_LE(height_of(points, failure.along), rim.height * (1 + 1e-12));
      EXPECT_TRUE(cosine == 0 || failure.along.dot(rim.normal) < cosine);
      if (failure.along != surface.normal(failure.face)) ++on_rim;
      // Some points are too near, as those of a body that is lower there.
      const double far = repeat % 4 == 0 ? random.uniform(0.3, 1) : 1;
      const auto added = difference_point(far * failure.along);
      if (points.size() >= most_points ||
          !surface.add(added, failure.face, std::numeric_limits<double>::infinity())) {
        ++failed;
        break;
      }
      points.push_back(added.difference);
      kept.extend(surface);
    }
  }
  EXPECT_GT(proven, drawn(100, 10));
  EXPECT_GT(failed, drawn(20, 2));
  EXPECT_GT(on_rim, drawn(20, 2));
}

}  // namespace
}  // namespace touchstone::rim_proof_test
