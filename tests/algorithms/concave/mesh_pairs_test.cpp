// Pairs of meshes: verdicts and lists of pairs of every phase against the oracle's, with every
// mid-phase.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/algorithms/concave/agreed.h"
#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

using reference::agreed;
using reference::Answered;
using reference::ask;
using reference::body_of;
using reference::moved_by;

TEST(MeshPairs, ToriInRandomPoses) {
  reference::Random random(1);
  const auto tori = [](double scale) {
    return std::array{
        body_of(families::moved(reference::torus(12, 6, 1, 0.3), scale, Vec3d::Zero())),
        body_of(families::moved(reference::torus(9, 5, 0.8, 0.25), scale, Vec3d::Zero()))};
  };
  // Vertices that are floats, and such as are none.
  const auto floats = tori(1), doubles = tori(1.1);
  int hits = 0;
  const int count = drawn(20, 12);
  for (int i = 0; i < count; ++i) {
    const Pose a = {random.rotation(), random.vector(0.8)};
    const Pose b = {random.rotation(), random.vector(0.8)};
    const std::array<ConcaveBody, 2> bodies = {(i & 1) != 0 ? doubles[0] : floats[0],
                                               (i & 2) != 0 ? doubles[1] : floats[1]};
    hits += agreed(bodies, a, b).meets();
  }
  EXPECT_GT(hits, count / 10);
  EXPECT_LT(hits, count);
}

// The lists of all mid-phases, from large meshes: too many pairs for the oracle.
TEST(MeshPairs, EveryMidPhaseGivesTheSameLists) {
  reference::Random random(2);
  const std::array<ConcaveBody, 2> bodies = {
      body_of(reference::torus(40, 16, 1, 0.3)),
      body_of(families::moved(reference::torus(50, 20, 1, 0.3), 1.1, Vec3d::Zero()))};
  std::size_t most = 0, least = 1000;
  for (int i = 0; i < drawn(10, 6); ++i) {
    const Pose a = {random.rotation(), random.vector(0.6)};
    const Pose b = {random.rotation(), random.vector(0.6)};
    const Answered fused = ask("fused", ConcaveTask::contacts, bodies, a, b);
    for (const MidPhaseEntry& mid : registry::entries<MidPhaseEntry>()) {
      const Answered found = ask("part-pairs", ConcaveTask::contacts, bodies, a, b, mid.info.name);
      EXPECT_EQ(found.pairs, fused.pairs) << mid.info.name;
    }
    most = std::max(most, fused.pairs.size());
    least = std::min(least, fused.pairs.size());
  }
  EXPECT_GT(most, 50u);
  if (one_in == 1) {
    EXPECT_EQ(least, 0u);
  }
}

// Of fine meshes that just touch, so that pairs are few and their leaves lie close, in poses that are not quite
// rigid, or not at all.
TEST(MeshPairs, PosesThatStretchGiveTheListsOfAllPairs) {
  reference::Random random(3);
  const std::array<ConcaveBody, 2> bodies = {body_of(reference::torus(40, 16, 1, 0.3)),
                                             body_of(reference::torus(30, 12, 1, 0.3))};
  std::size_t hits = 0;
  const int count = drawn(16, 6);
  for (int i = 0; i < count; ++i) {
    const auto bent = [&](double by) {
      Mat3d turn = random.rotation();
      for (int k = 0; k < 3; ++k) turn.col(k) += by * random.vector(1);
      return turn;
    };
    const std::array<double, 6> bends = {0, 1e-12, 1e-7, 1e-4, 1e-2, 0.5};
    const double bend = bends[static_cast<std::size_t>(i) % bends.size()];
    Pose a = {bent(bend), random.vector(100)}, b = {bent(bend), {}};
    const Vec3d way = random.vector(1).normalized();
    double in = 0, out = 6;
    for (int step = 0; step < 20; ++step) {
      const double middle = 0.5 * (in + out);
      b.translation = a.translation + middle * way;
      (ask("fused", ConcaveTask::intersect, bodies, a, b).meets() ? in : out) = middle;
    }
    for (const double depth : {-1e-4, 0.0, 1e-3}) {
      b.translation = a.translation + (in - depth) * way;
      const Answered truth = ask("part-pairs", ConcaveTask::contacts, bodies, a, b, "naive");
      EXPECT_EQ(ask("fused", ConcaveTask::contacts, bodies, a, b).pairs, truth.pairs) << bend;
      EXPECT_EQ(ask("fused", ConcaveTask::intersect, bodies, a, b).meets(), truth.meets()) << bend;
      const Answered wide = ask("part-pairs", ConcaveTask::contacts, bodies, a, b, "wide-bvh");
      EXPECT_EQ(wide.pairs, truth.pairs) << bend;
      hits += truth.meets();
    }
  }
  EXPECT_GT(hits, static_cast<std::size_t>(count));
  EXPECT_LT(hits, 3 * static_cast<std::size_t>(count));
}

TEST(MeshPairs, AMeshOnItself) {
  const TriangleMesh mesh = reference::torus(8, 5, 1, 0.3);
  TriangleMesh off = mesh;
  for (Vec3d& vertex : off.vertices) vertex[0] = std::nextafter(vertex[0], 9.0);
  reference::Random random(3);
  const Pose pose = {random.rotation(), random.vector(1)};
  const Answered same = agreed({body_of(mesh), body_of(mesh)}, {}, {});
  // Each triangle meets itself and, of a torus, twelve others.
  EXPECT_EQ(same.pairs.size(), 13 * mesh.triangles.size());
  EXPECT_EQ(agreed({body_of(mesh), body_of(mesh)}, pose, pose).pairs, same.pairs);
  EXPECT_TRUE(agreed({body_of(mesh), body_of(off)}, {}, {}).meets());
  EXPECT_TRUE(agreed({body_of(mesh), body_of(off)}, pose, pose).meets());
}

TEST(MeshPairs, RotationsAreTakenLiterally) {
  const std::array<ConcaveBody, 2> bodies = {body_of(reference::torus(7, 4, 1, 0.3)),
                                             body_of(reference::box_mesh(0.5, 0.4, 0.3))};
  reference::Random random(4);
  int hits = 0;
  const int count = drawn(20, 12);
  for (int i = 0; i < count; ++i) {
    // Mirrored, stretched, sheared and flattened bodies.
    Pose a = {random.rotation(), random.vector(0.7)}, b = {random.rotation(), random.vector(0.7)};
    if (i % 4 == 0) a.rotation.col(0) *= -1;
    if (i % 4 == 1) a.rotation *= 1.5;
    if (i % 4 == 2) b.rotation.col(1) += 0.3 * b.rotation.col(2);
    if (i % 4 == 3) a.rotation.row(2).setZero();
    hits += agreed(bodies, a, b).meets();
  }
  EXPECT_GT(hits, 0);
  EXPECT_LT(hits, count);
}

TEST(MeshPairs, DegenerateMeshes) {
  const TriangleMesh none;
  TriangleMesh points;  // vertices alone
  points.vertices = {{0, 0, 0}, {1, 0, 0}};
  TriangleMesh one = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, false};
  TriangleMesh twice = one;
  twice.triangles.push_back({0, 1, 2});
  TriangleMesh segment = {{{0, 0, -1}, {0.25, 0.25, 1}}, {{0, 1, 1}, {0, 0, 0}}, false};
  EXPECT_FALSE(agreed({body_of(none), body_of(one)}, {}, {}).meets());
  EXPECT_FALSE(agreed({body_of(none), body_of(none)}, {}, {}).meets());
  EXPECT_FALSE(agreed({body_of(points), body_of(one)}, {}, {}).meets());
  EXPECT_EQ(agreed({body_of(one), body_of(one)}, {}, {}).pairs.size(), 1u);
  EXPECT_EQ(agreed({body_of(twice), body_of(twice)}, {}, {}).pairs.size(), 4u);
  EXPECT_THAT(agreed({body_of(one), body_of(segment)}, {}, {}).pairs,
              testing::ElementsAre(IndexPair{0, 0}));
  EXPECT_FALSE(agreed({body_of(one), body_of(one)}, {}, moved_by({0, 0, 1e-300})).meets());
  EXPECT_TRUE(agreed({body_of(one), body_of(one)}, {}, moved_by({0.5, 0.5, 0})).meets());
  EXPECT_FALSE(
      agreed({body_of(one), body_of(one)}, {}, moved_by({0.5, std::nextafter(0.5, 1.0), 0}))
          .meets());
}

// A corner in the middle of another triangle's edge, an open surface, and sizes 1e9 apart.
TEST(MeshPairs, UnevenMeshes) {
  const TriangleMesh junction = {
      {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}, {1, -1, 0}, {0, -1, 1}},
      {{0, 1, 2}, {0, 4, 3}, {3, 4, 1}, {0, 5, 4}},
      false};
  const TriangleMesh small = {
      {{1, 0, -1e-9}, {1, 0, 1e-9}, {1 + 1e-9, 1e-9, 0}}, {{0, 1, 2}}, false};
  const Answered answered = agreed({body_of(junction), body_of(small)}, {}, {});
  EXPECT_EQ(answered.pairs.size(), 3u);
  EXPECT_EQ(agreed({body_of(junction), body_of(small)}, {}, moved_by({0, 5e-10, 0})).pairs.size(),
            1u);
  EXPECT_FALSE(agreed({body_of(junction), body_of(small)}, {}, moved_by({0, 2, 0})).meets());
}

// Coordinates beyond floats and near the ends of doubles.
TEST(MeshPairs, ExtremeSizes) {
  for (const double size : {1e-200, 1e-40, 1e40, 1e90, 1e200}) {
    SCOPED_TRACE(size);
    TriangleMesh box = reference::box_mesh(size, size, size);
    const std::array<ConcaveBody, 2> bodies = {body_of(box), body_of(box)};
    EXPECT_TRUE(agreed(bodies, {}, moved_by({size, size / 2, size / 4})).meets());
    EXPECT_TRUE(agreed(bodies, {}, moved_by({2 * size, 0, 0})).meets());
    EXPECT_FALSE(agreed(bodies, {}, moved_by({2.0001 * size, 0, 0})).meets());
    EXPECT_FALSE(agreed(bodies, {}, moved_by({std::nextafter(2 * size, 1e300), 0, 0})).meets());
  }
}

}  // namespace
}  // namespace touchstone
