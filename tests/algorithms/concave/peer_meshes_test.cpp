// What Bullet, ODE and CGAL say of meshes and of convex parts, on bodies in general position, where they
// are right; and that they bear what is hard for them.
#include <gtest/gtest.h>

#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

using reference::Answered;
using reference::ask;
using reference::body_of;
using reference::moved_by;

class PeerMeshesTest : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    entry_ = registry::find<ConcaveEntry>(GetParam());
    ASSERT_NE(entry_, nullptr);
    EXPECT_EQ(entry_->info.origin, Origin::peer);
    if (!is_built(entry_->info)) GTEST_SKIP() << entry_->info.reason;
  }
  bool offers(ConcaveTask task) const { return std::ranges::count(entry_->tasks, task) > 0; }

  // Random placements of two bodies. Counts the verdicts that are not those of `fused`.
  struct Count {
    int asked = 0, hits = 0, missed = 0, false_hits = 0, other_pairs = 0;
  };
  Count compare(const std::array<ConcaveBody, 2>& bodies, double reach, int count) const {
    reference::Random random(11);
    Count result;
    for (int i = 0; i < count; ++i) {
      const Pose a = {random.rotation(), random.vector(reach)};
      const Pose b = {random.rotation(), random.vector(reach)};
      const Answered truth = ask("fused", ConcaveTask::contacts, bodies, a, b);
      const Answered found = ask(GetParam(), ConcaveTask::intersect, bodies, a, b);
      EXPECT_EQ(found.outcome.status, Status::not_reported);
      EXPECT_TRUE(found.pairs.empty());
      ++result.asked;
      result.hits += truth.meets();
      result.missed += truth.meets() && !found.meets();
      result.false_hits += !truth.meets() && found.meets();
      if (!offers(ConcaveTask::contacts)) continue;
      const Answered listed = ask(GetParam(), ConcaveTask::contacts, bodies, a, b);
      EXPECT_EQ(listed.meets(), found.meets());
      result.other_pairs += listed.pairs != truth.pairs;
    }
    EXPECT_GT(result.hits, result.asked / 10);
    EXPECT_LT(result.hits, result.asked);
    return result;
  }

  const ConcaveEntry* entry_ = nullptr;
};

TEST_P(PeerMeshesTest, TellsToriThatMeetFromToriThatDoNot) {
  const std::array<ConcaveBody, 2> tori = {body_of(reference::torus(14, 7, 1, 0.3)),
                                           body_of(reference::torus(12, 6, 0.8, 0.25))};
  if (!entry_->supports(tori[0], tori[1])) GTEST_SKIP() << "it takes no two meshes";
  const Count count = compare(tori, 0.8, drawn(30, 8));
  EXPECT_EQ(count.missed, 0);
  const bool has_false_hits = entry_->info.name == "bullet-gimpact";
  EXPECT_LE(count.false_hits, has_false_hits ? count.asked / 4 : 0);
  if (!has_false_hits) {
    EXPECT_EQ(count.other_pairs, 0);
  }
}

TEST_P(PeerMeshesTest, TellsConvexBodiesThatMeetATorus) {
  const ConcaveBody torus = body_of(reference::torus(14, 7, 1, 0.3));
  for (const Shape& shape : {reference::make_sphere(0.3), reference::make_box(0.3, 0.2, 0.4)}) {
    for (const bool swapped : {false, true}) {
      std::array<ConcaveBody, 2> bodies = {torus, body_of(shape)};
      if (swapped) std::swap(bodies[0], bodies[1]);
      if (!entry_->supports(bodies[0], bodies[1])) GTEST_SKIP() << "it takes no convex bodies";
      const Count count = compare(bodies, 0.7, drawn(30, 8));
      // ODE's triangles have one side for spheres.
      const bool one_sided = entry_->info.name == "ode-opcode" && shape.kind == ShapeKind::sphere;
      EXPECT_LE(count.missed, one_sided ? count.hits / 2 : 0);
      EXPECT_EQ(count.false_hits, 0);
    }
  }
}

TEST_P(PeerMeshesTest, NumbersPartsInTheOrderOfTheBodies) {
  ConcaveBody pair = body_of(reference::make_sphere(0.2), moved_by({5, 0, 0}));
  pair.parts.push_back({reference::make_box(0.25, 0.25, 0.25), moved_by({1, 0, 0}), 0});
  const ConcaveBody torus = body_of(reference::torus(14, 7, 1, 0.3));
  if (!entry_->supports(torus, pair)) GTEST_SKIP() << "it takes no convex bodies";
  reference::Random random(2);
  const Pose tilt = {random.rotation(), {0, 0, 0}};
  const std::array<ConcaveBody, 2> bodies = {torus, pair}, swapped = {pair, torus};
  EXPECT_TRUE(ask(GetParam(), ConcaveTask::intersect, bodies, tilt, {}).meets());
  EXPECT_TRUE(ask(GetParam(), ConcaveTask::intersect, swapped, {}, tilt).meets());
  const Pose away = moved_by({3, 0, 0});
  EXPECT_FALSE(ask(GetParam(), ConcaveTask::intersect, bodies, tilt, away).meets());
  if (!offers(ConcaveTask::contacts)) return;
  const Answered found = ask(GetParam(), ConcaveTask::contacts, bodies, tilt, {});
  ASSERT_GT(found.pairs.size(), 3u);
  for (const IndexPair& touching : found.pairs) EXPECT_EQ(touching.b, 1u);
  Answered back = ask(GetParam(), ConcaveTask::contacts, swapped, {}, tilt);
  for (IndexPair& touching : back.pairs) std::swap(touching.a, touching.b);
  std::ranges::sort(back.pairs);
  EXPECT_EQ(back.pairs, found.pairs);
}

TEST_P(PeerMeshesTest, BearsMeshesOfNoOneAndDegenerateTriangles) {
  const ConcaveBody none = body_of(TriangleMesh{});
  const ConcaveBody one = reference::mesh_of({{Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0)}});
  const ConcaveBody point = reference::mesh_of({{Vec3d(9, 9, 9), Vec3d(9, 9, 9), Vec3d(9, 9, 9)}});
  const ConcaveBody torus = body_of(reference::torus(14, 7, 1, 0.3));
  if (!entry_->supports(torus, torus)) GTEST_SKIP() << "it takes no two meshes";
  for (const ConcaveBody& other : {none, point}) {
    EXPECT_FALSE(ask(GetParam(), ConcaveTask::intersect, {torus, other}, {}, {}).meets());
    EXPECT_FALSE(ask(GetParam(), ConcaveTask::intersect, {other, one}, {}, {}).meets());
  }
  EXPECT_TRUE(ask(GetParam(), ConcaveTask::intersect, {torus, one}, {}, moved_by({0.2, 0.1, 0.05}))
                  .meets());
  EXPECT_FALSE(
      ask(GetParam(), ConcaveTask::intersect, {one, torus}, {}, moved_by({5, 0, 0})).meets());
}

INSTANTIATE_TEST_SUITE_P(Libraries, PeerMeshesTest,
                         testing::Values("bullet-gimpact", "bullet-mesh", "ode-opcode",
                                         "cgal-rigid-meshes"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace touchstone
