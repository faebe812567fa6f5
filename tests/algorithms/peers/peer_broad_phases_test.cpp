// What is asked of every peer without a known defect.
#include "tests/algorithms/peers/broad_phase_frames.h"
#include "tests/algorithms/peers/peer_test.h"

namespace touchstone {
namespace {

class PeerBroadPhaseTest : public PeerTest<registry::find<BroadPhaseEntry>> {
 protected:
  std::vector<IndexPair> pairs_of(std::span<const Aabb> boxes) const {
    Executor executor(1);
    const auto algorithm = entry_->make(executor);
    algorithm->build(boxes);
    return sorted_pairs(*algorithm);
  }
};

TEST_P(PeerBroadPhaseTest, FindsTheClosedPairsOfEveryFrame) {
  EXPECT_TRUE(entry_->info.known_defect.empty());
  Tally tally;
  for (const Style& style : styles()) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) play(*entry_, style, seed, false, tally);
  }
  EXPECT_GT(tally.pairs, tally.possible / 100);
  EXPECT_LT(tally.pairs, tally.possible / 2);
}

TEST_P(PeerBroadPhaseTest, KeepsPairsThatTouch) {
  // Against the first: a face, an edge, a corner, the same box, a point on its corner; and two gaps
  // of one float.
  const float beyond = std::nextafter(1.0F, 2.0F);
  const std::vector<Aabb> boxes = {
      {{0, 0, 0}, {1, 1, 1}},      {{1, 0, 0}, {2, 1, 1}},      {{1, 1, 0}, {2, 2, 1}},
      {{1, 1, 1}, {2, 2, 2}},      {{0, 0, 0}, {1, 1, 1}},      {{1, 1, 1}, {1, 1, 1}},
      {{beyond, 0, 0}, {3, 1, 1}}, {{0, beyond, 0}, {1, 2, 1}},
  };
  const std::vector<IndexPair> found = pairs_of(boxes);
  EXPECT_EQ(found, closed_pairs(boxes));
  for (const std::uint32_t id : {1U, 2U, 3U, 4U, 5U}) {
    EXPECT_TRUE(std::ranges::count(found, IndexPair{0, id})) << id;
  }
  for (const std::uint32_t id : {6U, 7U}) {
    EXPECT_FALSE(std::ranges::count(found, IndexPair{0, id})) << id;
  }
}

TEST_P(PeerBroadPhaseTest, ForgetsPairsThatCameApart) {
  // Bullet's tree keeps the first box's larger leaf, and its cache the pair.
  const std::vector<Aabb> before = {{{0, 0, 0}, {4, 4, 4}}, {{3, 3, 3}, {5, 5, 5}}};
  const std::vector<Aabb> after = {{{0, 0, 0}, {1, 1, 1}}, {{3, 3, 3}, {5, 5, 5}}};
  const std::vector<std::uint32_t> moved = {0};
  Executor executor(1);
  const auto algorithm = entry_->make(executor);
  PairSink sink;
  algorithm->build(before);
  algorithm->find_pairs(sink);
  EXPECT_EQ(sink.size(), 1U);
  algorithm->update({after, moved, {}, {}});
  algorithm->find_pairs(sink);
  EXPECT_EQ(sink.size(), 0U);
  algorithm->update({before, moved, {}, {}});
  algorithm->find_pairs(sink);
  EXPECT_EQ(sink.size(), 1U);
}

TEST_P(PeerBroadPhaseTest, TakesBoxesAtTheEndsOfTheFloats) {
  constexpr float most = std::numeric_limits<float>::max();
  const std::vector<Aabb> boxes = {{{-most, -most, -most}, {most, most, most}},
                                   {{most, most, most}, {most, most, most}},
                                   {{-1, -1, -1}, {1e-40F, 1e-40F, 1e-40F}},
                                   {{1e-40F, 1e-40F, 1e-40F}, {1, 1, 1}},
                                   {{2e38F, 0, 0}, {3e38F, 1, 1}}};
  EXPECT_EQ(pairs_of(boxes), closed_pairs(boxes));

  // Many, with little between the ends.
  std::mt19937_64 random(6);
  std::vector<Aabb> many(400);
  for (int round = 0; round < 10; ++round) {
    for (Aabb& box : many) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        constexpr std::array ends = {-most, -most, -1.0F, 0.0F, 1.0F, most, most};
        const float a = ends[random() % ends.size()];
        const float b = ends[random() % ends.size()];
        box.min[axis] = std::min(a, b);
        box.max[axis] = std::max(a, b);
      }
    }
    EXPECT_EQ(pairs_of(many) == closed_pairs(many), true) << round;
  }
}

INSTANTIATE_TEST_SUITE_P(Peers, PeerBroadPhaseTest,
                         testing::Values("bullet-tree", "bullet-axis-sweep", "ode-hash",
                                         "ode-quadtree", "ode-sap", "cgal-box", "embree-low",
                                         "embree-refit", "boost-rtree"),
                         peer_test_name);

}  // namespace
}  // namespace touchstone
