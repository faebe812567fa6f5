// Our broad phases through many frames of bodies that move, leap, come and go: what they keep from
// frame to frame has to stay right, whatever was done to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

struct Sequence {
  std::string name;
  std::size_t bodies = 350;
  float side = 0.15f;
  int frames = 120;
  float moved = 0, reach = 0;  // how many of the bodies, and how far
  float drift = 0;             // a frame, of all, each in a direction of its own
  float resized = 0, teleported = 0, inserted = 0, removed = 0;
  // Frames in which all is at rest, then all leaps, and so on.
  int calm_frames = 0;
  float orders = 0;  // of sizes
  float scale = 1;   // of everything
};

const Sequence sequences[] = {
    {.name = "at rest"},
    {.name = "a few jitter", .frames = 300, .moved = 0.02f, .reach = 0.004f},
    {.name = "a few go far", .frames = 300, .moved = 0.02f, .reach = 0.05f},
    {.name = "all drift slowly", .drift = 0.0005f},
    {.name = "all drift", .drift = 0.005f},
    {.name = "all drift fast", .drift = 0.05f},
    {.name = "a few leap", .frames = 300, .teleported = 0.01f},
    {.name = "churn",
     .frames = 300,
     .moved = 0.05f,
     .reach = 0.01f,
     .teleported = 0.005f,
     .inserted = 0.01f,
     .removed = 0.01f},
    {.name = "much churn", .moved = 0.3f, .reach = 0.01f, .inserted = 0.15f, .removed = 0.1f},
    {.name = "sizes change", .frames = 200, .resized = 0.03f},
    {.name = "calm and leaps", .frames = 200, .moved = 0.04f, .reach = 0.02f, .calm_frames = 9},
    {.name = "sizes over 3 orders",
     .side = 0.6f,
     .frames = 300,
     .moved = 0.03f,
     .reach = 0.02f,
     .teleported = 0.01f,
     .orders = 3},
    {.name = "crowd", .bodies = 150, .side = 1.2f, .moved = 0.03f, .reach = 0.2f},
    {.name = "great crowd", .bodies = 400, .side = 0.9f, .frames = 20, .teleported = 0.01f},
    {.name = "very small", .drift = 0.0005f, .teleported = 0.01f, .scale = 1e-42f},
    {.name = "very large", .drift = 0.0005f, .teleported = 0.01f, .scale = 1e38f},
    {.name = "few bodies", .bodies = 3, .side = 0.9f, .frames = 300, .teleported = 0.2f},
};

class SequenceBodies {
 public:
  SequenceBodies(const Sequence& sequence, Random& random) : sequence_(sequence), random_(random) {
    for (std::size_t i = 0; i < sequence.bodies; ++i) add();
    boxes_[0] = scaled();
  }

  std::span<const Aabb> boxes() const { return boxes_[now_]; }

  FrameChange next(int frame) {
    for (std::size_t i = 0; i < own_.size(); ++i) change(i, frame);
    const auto fresh =
        static_cast<std::size_t>(sequence_.inserted * 0.3f * static_cast<float>(sequence_.bodies));
    for (std::size_t i = 0; i < fresh && own_.size() < 3 * sequence_.bodies; ++i) add();
    // The array of the frame before is spoilt, so that nobody goes on using it.
    std::vector<Aabb>& before = boxes_[now_];
    std::vector<Aabb>& after = boxes_[1 - now_];
    after = scaled();
    before.resize(after.size(), Aabb::empty());
    moved_.clear(), inserted_.clear(), removed_.clear();
    for (std::uint32_t id = 0; id < after.size(); ++id) {
      if (before[id] == after[id]) continue;
      auto& list = before[id].is_empty() ? inserted_ : after[id].is_empty() ? removed_ : moved_;
      list.push_back(id);
    }
    std::ranges::fill(before, Aabb{{-9, -9, -9}, {9, 9, 9}});
    now_ = 1 - now_;
    return {after, moved_, inserted_, removed_};
  }

 private:
  Aabb fresh_box() {
    const float shrink = std::pow(10.0f, -uniform(random_, 0, sequence_.orders));
    return uniform_boxes(random_, 1, sequence_.side * shrink)[0];
  }
  void add() {
    own_.push_back(fresh_box());
    const float d = sequence_.drift;
    drift_.push_back({uniform(random_, -d, d), uniform(random_, -d, d), uniform(random_, -d, d)});
  }
  static void shift(Aabb& box, std::size_t axis, float by) {
    box.min[axis] += by;
    box.max[axis] += by;
  }
  void change(std::size_t i, int frame) {
    Aabb& box = own_[i];
    const float dice = uniform(random_, 0, 1);
    if (box.is_empty()) {
      if (dice < sequence_.inserted) box = fresh_box();
      return;
    }
    if (dice < sequence_.removed) {
      box = Aabb::empty();
      return;
    }
    const bool all_leap = sequence_.calm_frames > 0 && frame % (sequence_.calm_frames + 1) == 0;
    if (all_leap || uniform(random_, 0, 1) < sequence_.teleported) box = fresh_box();
    const bool is_moved = uniform(random_, 0, 1) < sequence_.moved;
    const bool is_resized = uniform(random_, 0, 1) < sequence_.resized;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (is_moved) shift(box, axis, uniform(random_, -sequence_.reach, sequence_.reach));
      if (box.min[axis] < 0 || box.min[axis] > 1) drift_[i][axis] = -drift_[i][axis];
      shift(box, axis, drift_[i][axis]);
      if (is_resized) {
        const float side = std::max(0.0f, uniform(random_, -0.1f, 1.5f * sequence_.side));
        box.max[axis] = box.min[axis] + side;
      }
    }
  }
  std::vector<Aabb> scaled() const {
    std::vector<Aabb> boxes = own_;
    for (Aabb& box : boxes) {
      if (box.is_empty()) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.min[axis] *= sequence_.scale;
        box.max[axis] *= sequence_.scale;
      }
    }
    return boxes;
  }

  const Sequence& sequence_;
  Random& random_;
  std::vector<Aabb> own_;
  std::vector<std::array<float, 3>> drift_;
  std::vector<Aabb> boxes_[2];
  std::size_t now_ = 0;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
};

// Every one of ours but the one that the truth is like, at two widths.
struct Follower {
  Follower(const BroadPhaseEntry& entry, int width)
      : name(entry.info.name + ", width " + std::to_string(width)),
        executor(std::make_unique<Executor>(width)),
        algorithm(entry.make(*executor)) {}
  std::vector<IndexPair> pairs() {
    EXPECT_EQ(algorithm->find_pairs(sink), Status::ok);
    return sink.gather();
  }

  std::string name;
  std::unique_ptr<Executor> executor;
  std::unique_ptr<BroadPhase> algorithm;
  PairSink sink;
};

std::vector<Follower> followers() {
  std::vector<Follower> list;
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (entry.info.origin != Origin::ours || entry.info.name == "naive") continue;
    for (const int width : {1, 3}) list.emplace_back(entry, width);
  }
  return list;
}

class LongSequences : public testing::TestWithParam<Sequence> {};

std::string sequence_name(const testing::TestParamInfo<Sequence>& param) {
  std::string name = param.param.name;
  std::ranges::replace(name, ' ', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Bodies, LongSequences, testing::ValuesIn(sequences), sequence_name);

TEST_P(LongSequences, AreFollowed) {
  const Sequence& sequence = GetParam();
  Random random(77);
  SequenceBodies bodies(sequence, random);
  std::vector<Follower> all = followers();
  for (Follower& follower : all) follower.algorithm->build(bodies.boxes());
  std::vector<IndexPair> before;
  std::size_t came = 0, went = 0, stayed = 0;
  const int frames = drawn(sequence.frames, 5);
  for (int frame = 0; frame < frames; ++frame) {
    if (frame > 0) {
      const FrameChange change = bodies.next(frame);
      for (Follower& follower : all) follower.algorithm->update(change);
    }
    const std::vector<IndexPair> truth = true_pairs(bodies.boxes());
    for (std::size_t i = 0; i < all.size(); i += 2) {
      SCOPED_TRACE(all[i].name);
      std::vector<IndexPair> found = all[i].pairs();
      ASSERT_EQ(found == all[i + 1].pairs(), true) << "frame " << frame << " at another width";
      std::ranges::sort(found);
      ASSERT_EQ(found == truth, true)
          << "frame " << frame << ": " << found.size() << " pairs of " << truth.size();
    }
    if (frame > 0) {
      std::vector<IndexPair> common;
      std::ranges::set_intersection(before, truth, std::back_inserter(common));
      came += truth.size() - common.size();
      went += before.size() - common.size();
      stayed += common.size();
    }
    before = truth;
  }
  if (sequence.name == "at rest") return;
  const auto some = static_cast<std::size_t>(frames) / 20;
  EXPECT_GT(came, some);
  EXPECT_GT(went, some);
  EXPECT_GT(stayed, some);
}

// What is kept from frame to frame is not let grow.
TEST(LongSequencesOfChurn, DoNotGrowTheMemory) {
  const Sequence sequence{.name = "churn",
                          .frames = drawn(400, 80),
                          .moved = 0.03f,
                          .reach = 0.01f,
                          .teleported = 0.01f,
                          .inserted = 0.01f,
                          .removed = 0.01f};
  Random random(78);
  SequenceBodies bodies(sequence, random);
  std::vector<Follower> all = followers();
  for (Follower& follower : all) follower.algorithm->build(bodies.boxes());
  std::vector<std::int64_t> early(all.size());
  for (int frame = 1; frame < sequence.frames; ++frame) {
    const FrameChange change = bodies.next(frame);
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].algorithm->update(change);
      const auto pairs = static_cast<std::int64_t>(all[i].pairs().size());
      EXPECT_GE(all[i].algorithm->work().candidates, pairs) << all[i].name;
      if (frame == sequence.frames / 2) early[i] = all[i].algorithm->work().bytes;
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_LE(all[i].algorithm->work().bytes, 2 * early[i]) << all[i].name;
  }
}

}  // namespace
}  // namespace touchstone
