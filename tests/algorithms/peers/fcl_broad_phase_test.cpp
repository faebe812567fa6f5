#include "tests/algorithms/peers/broad_phase_frames.h"
#include "tests/algorithms/peers/peer_test.h"

namespace touchstone {
namespace {

class FclBroadPhaseTest : public PeerTest<registry::find<BroadPhaseEntry>> {};

TEST_P(FclBroadPhaseTest, FindsTheClosedPairsOfEveryFrame) {
  const bool misses_touching = !entry_->info.known_defect.empty();
  Tally tally;
  for (const Style& style : styles()) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      play(*entry_, style, seed, misses_touching, tally);
    }
  }
  EXPECT_GT(tally.pairs, tally.possible / 100);
  EXPECT_LT(tally.pairs, tally.possible / 2);
  // The defect that is declared is there, and only there.
  EXPECT_EQ(tally.missed_touching > 0, misses_touching);
}

TEST_P(FclBroadPhaseTest, TakesBodiesOfWhichNoneIsLeft) {
  std::vector<Aabb> boxes(40, Aabb{{0, 0, 0}, {2, 2, 2}});
  std::vector<std::uint32_t> all;
  for (std::uint32_t id = 0; id < boxes.size(); ++id) {
    const auto at = static_cast<float>(id);
    boxes[id] = {{at, 0, 0}, {at + 1.5F, 1, 1}};
    all.push_back(id);
  }
  const std::vector<Aabb> none(boxes.size(), Aabb::empty());
  Executor executor(1);
  const auto algorithm = entry_->make(executor);
  PairSink sink;
  algorithm->build(boxes);
  ASSERT_EQ(algorithm->find_pairs(sink), Status::ok);
  EXPECT_EQ(sink.size(), 39U);
  for (int round = 0; round < 3; ++round) {
    algorithm->update({none, {}, {}, all});
    ASSERT_EQ(algorithm->find_pairs(sink), Status::ok);
    EXPECT_EQ(sink.size(), 0U);
    algorithm->update({boxes, {}, all, {}});
    ASSERT_EQ(algorithm->find_pairs(sink), Status::ok);
    EXPECT_EQ(sink.size(), 39U);
  }
}

TEST(PeerBroadPhases, AreBuiltOrSayWhyNot) {
  int peers = 0;
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    peers += entry.info.origin == Origin::peer;
    EXPECT_EQ(static_cast<bool>(entry.make), entry.info.reason.empty()) << entry.info.name;
    EXPECT_FALSE(entry.info.citation.empty()) << entry.info.name;
  }
  EXPECT_GE(peers, 16);
}

// Each has types of its own, and to convert to them changes nothing; ours read the boxes as they
// are.
TEST(PeerBroadPhases, ConvertBoxesApart) {
  const std::vector<Aabb> boxes = Frames({.name = "moving"}, 1).boxes();
  const std::vector<Aabb> others =
      Frames({.name = "far away", .count = 300, .offset = 1e6F}, 2).boxes();
  const std::vector<IndexPair> truth = closed_pairs(boxes);
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (!is_built(entry.info)) continue;
    SCOPED_TRACE(entry.info.name);
    Executor executor(1);
    const auto algorithm = entry.make(executor);
    algorithm->build(boxes);
    EXPECT_EQ(sorted_pairs(*algorithm), truth);
    auto* const peer = dynamic_cast<PeerBroadPhase*>(algorithm.get());
    EXPECT_EQ(peer != nullptr, entry.info.origin == Origin::peer);
    if (peer == nullptr) continue;
    for (const std::vector<Aabb>& given : {others, boxes, {}}) peer->convert(given);
    EXPECT_EQ(sorted_pairs(*algorithm), truth);
  }
}

INSTANTIATE_TEST_SUITE_P(Peers, FclBroadPhaseTest,
                         testing::Values("fcl-naive", "fcl-ssap", "fcl-sap", "fcl-dynamic-tree",
                                         "fcl-dynamic-tree-array", "fcl-interval-tree",
                                         "fcl-spatial-hash"),
                         peer_test_name);

}  // namespace
}  // namespace touchstone
