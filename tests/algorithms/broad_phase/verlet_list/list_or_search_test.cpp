// When the Verlet list keeps a list, as its structure shows: a grown box for each body while it does,
// and the fewer nodes of the packed R-tree while it does not.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <numeric>
#include <vector>

#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"

namespace touchstone {
namespace {

class VerletListOrSearch : public testing::Test {
 protected:
  void SetUp() override {
    std::iota(all_.begin(), all_.end(), 0);
    phase_->build(boxes_);
  }
  void move(float step) {
    for (Aabb& box : boxes_) box.min[0] += step, box.max[0] += step;
    phase_->update({boxes_, all_, {}, {}});
  }
  bool has_list() const { return phase_->structure().size() == boxes_.size(); }

  static constexpr std::size_t count = 2000;
  Random random_{7};
  std::vector<Aabb> boxes_ = uniform_boxes(random_, count, 0.02f);
  std::vector<std::uint32_t> all_ = std::vector<std::uint32_t>(count);
  Executor executor_{1};
  std::unique_ptr<BroadPhase> phase_ =
      registry::find<BroadPhaseEntry>("verlet-list")->make(executor_);
  PairSink sink_;
};

TEST_F(VerletListOrSearch, ListsPairsOfSlowBodiesAndNotOfFastOnes) {
  phase_->find_pairs(sink_);
  for (int frame = 0; frame < 40; ++frame) {
    move(1e-6f);
    phase_->find_pairs(sink_);
  }
  EXPECT_TRUE(has_list());
  for (int frame = 0; frame < 40; ++frame) {
    move(0.1f);
    phase_->find_pairs(sink_);
  }
  EXPECT_FALSE(has_list());
}

TEST_F(VerletListOrSearch, ListsAgainAfterAQuestionForAFewBodies) {
  const std::vector<std::uint32_t> few{5};
  phase_->find_pairs_of(few, sink_);
  for (int frame = 0; frame < 40; ++frame) {
    move(1e-6f);
    phase_->find_pairs_of(few, sink_);
  }
  EXPECT_FALSE(has_list());
  for (int frame = 0; frame < 40; ++frame) {
    move(1e-6f);
    phase_->find_pairs(sink_);
    phase_->find_pairs_of({}, sink_);
  }
  EXPECT_TRUE(has_list());
}

}  // namespace
}  // namespace touchstone
