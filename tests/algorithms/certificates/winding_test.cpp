// The check's winding numbers are those of the solver for points under and over edges, however long the numbers are.
#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/oracle/certificates/parts/rational_mesh.h"
#include "algorithms/oracle/concave/exact_winding.h"
#include "tests/algorithms/certificates/bodies.h"

namespace touchstone {
namespace {

using oracle::RationalMesh;
using reference::body_of;
using reference::box_mesh;
using reference::make_sphere;
using reference::PartsCertificate;
using reference::PartsClaim;
using reference::ProvenPair;

TEST(RationalWinding, IsThatOfTheSolverUnderEdgesAtEveryScale) {
  reference::Random random(11);
  int inside = 0, outside = 0;
  for (int i = 0; i < 400; ++i) {
    const double scale = std::ldexp(1.0, 130 * (random.below(11) - 5));
    TriangleMesh mesh = box_mesh(1, 2, 1, true);
    for (Vec3d& vertex : mesh.vertices) {
      if (random.below(3) == 0) vertex += Vec3d(random.below(3), random.below(3), 0);
      vertex *= scale;
    }
    Pose pose;
    if (random.below(2) == 0) pose.rotation = random.rotation();
    const RationalMesh placed = RationalMesh(mesh).placed(oracle::rational_pose(pose));
    // Halves of sums of vertices are under and over edges, as vertices with another height are.
    const std::size_t u = static_cast<std::size_t>(random.below(8)),
                      v = static_cast<std::size_t>(random.below(8));
    const Vec3d point = mesh.vertices[u] / 2 + mesh.vertices[v] / 2 +
                        Vec3d(0, 0, scale * (random.below(5) - 2) / 4);
    const int turns = oracle::exact_winding(mesh, pose, point, pose);
    ++(turns == 0 ? outside : inside);
    EXPECT_EQ(placed.winding(oracle::rational_pose(pose)(oracle::rational_vector(point))), turns);
  }
  EXPECT_GT(inside, 50);
  EXPECT_GT(outside, 50);
}

// The middle of a turned box is under the diagonal of a face, and its coordinates are products of doubles.
TEST(RationalWinding, NothingInTheMiddleOfATurnedSolidIsSeparated) {
  Pose pose;
  pose.rotation << 0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1;
  pose.translation = {0.1, 0.2, 0};
  const ProvenPair hollow = {body_of(box_mesh(0.7, 0.7, 0.7, false)), body_of(make_sphere(0.1)),
                             pose, pose};
  const ProvenPair solid = {body_of(box_mesh(0.7, 0.7, 0.7, true)), hollow.b, pose, pose};
  for (const PartsClaim claim : reference::all_claims) {
    const PartsCertificate apart = hollow.prove(claim), inside = solid.prove(claim);
    EXPECT_EQ(apart.answer, Answer::separated);
    EXPECT_EQ(hollow.fault(apart), "");
    EXPECT_EQ(solid.fault(apart), "a surface winds around a part");
    EXPECT_EQ(inside.answer, Answer::overlapping);
    EXPECT_EQ(solid.fault(inside), "");
  }
}

}  // namespace
}  // namespace touchstone
