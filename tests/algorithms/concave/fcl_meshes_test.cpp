// FCL's trees of meshes, on bodies in general position, where it is right.
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

class FclMeshesTest : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const ConcaveEntry* entry = registry::find<ConcaveEntry>(GetParam());
    ASSERT_NE(entry, nullptr);
    EXPECT_EQ(entry->info.origin, Origin::peer);
    if (!is_built(entry->info)) GTEST_SKIP() << entry->info.reason;
  }
};

TEST_P(FclMeshesTest, FindsThePairsAndDistancesOfTori) {
  reference::Random random(1);
  const std::array<ConcaveBody, 2> bodies = {body_of(reference::torus(14, 7, 1, 0.3)),
                                             body_of(reference::torus(12, 6, 0.8, 0.25))};
  int hits = 0;
  const int count = drawn(30, 5);
  for (int i = 0; i < count; ++i) {
    const Pose a = {random.rotation(), random.vector(0.8)};
    const Pose b = {random.rotation(), random.vector(0.8)};
    const Answered truth = ask("fused", ConcaveTask::contacts, bodies, a, b);
    const Answered found = ask(GetParam(), ConcaveTask::contacts, bodies, a, b);
    EXPECT_EQ(found.outcome.status, Status::not_reported);
    EXPECT_EQ(found.outcome.answer, truth.outcome.answer);
    EXPECT_EQ(found.pairs, truth.pairs);
    EXPECT_EQ(ask(GetParam(), ConcaveTask::intersect, bodies, a, b).meets(), truth.meets());
    hits += truth.meets();
    if (truth.meets() || GetParam() != std::string_view("fcl-obbrss")) continue;
    const Outcome distance = ask(GetParam(), ConcaveTask::distance, bodies, a, b).outcome;
    EXPECT_NEAR(distance.distance,
                ask("fused", ConcaveTask::distance, bodies, a, b).outcome.distance, 1e-12);
    EXPECT_NEAR((distance.witness_a - distance.witness_b).norm(), distance.distance, 1e-12);
  }
  EXPECT_GT(hits, count / 10);
  EXPECT_LT(hits, count);
}

TEST_P(FclMeshesTest, NumbersPartsInTheOrderOfTheBodies) {
  ConcaveBody pair = body_of(reference::make_sphere(0.2), moved_by({5, 0, 0}));
  pair.parts.push_back({reference::make_box(0.25, 0.25, 0.25), moved_by({1, 0, 0}), 0});
  const ConcaveBody torus = body_of(reference::torus(14, 7, 1, 0.3));
  reference::Random random(2);
  const Pose tilt = {random.rotation(), {0, 0, 0}};
  const Answered truth = ask("fused", ConcaveTask::contacts, {torus, pair}, tilt, {});
  EXPECT_GT(truth.pairs.size(), 3u);
  EXPECT_EQ(ask(GetParam(), ConcaveTask::contacts, {torus, pair}, tilt, {}).pairs, truth.pairs);
  Answered swapped = ask(GetParam(), ConcaveTask::contacts, {pair, torus}, {}, tilt);
  for (IndexPair& found : swapped.pairs) std::swap(found.a, found.b);
  std::ranges::sort(swapped.pairs);
  EXPECT_EQ(swapped.pairs, truth.pairs);
}

INSTANTIATE_TEST_SUITE_P(Trees, FclMeshesTest,
                         testing::Values("fcl-obbrss", "fcl-aabb", "fcl-kdop16"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace touchstone
