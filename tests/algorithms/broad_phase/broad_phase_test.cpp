// Every broad phase of the registry, ours and the peers', against the definition.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "algorithms/core/isa.h"
#include "algorithms/registry.h"
#include "harness/base/hash.h"
#include "tests/algorithms/broad_phase/box_sets.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

constexpr std::size_t stack_size = drawn(4'000, 2'000);
constexpr std::size_t crowd_size = drawn(8'000, 2'500);

struct Sample {
  BoxSet set;
  std::vector<IndexPair> truth;
};

const std::vector<Sample>& samples() {
  static const std::vector<Sample> all = [] {
    std::vector<Sample> list;
    for (BoxSet& set : box_sets()) {
      auto truth = true_pairs(set.boxes);
      list.push_back({std::move(set), std::move(truth)});
    }
    return list;
  }();
  return all;
}

// Large enough for many tasks.
const Sample& crowd() {
  static const Sample sample = [] {
    Random random(7);
    BoxSet set{.name = "crowd", .boxes = uniform_boxes(random, crowd_size, 0.05f)};
    auto truth = true_pairs(set.boxes);
    return Sample{std::move(set), std::move(truth)};
  }();
  return sample;
}

class BroadPhases : public testing::TestWithParam<const BroadPhaseEntry*> {
 protected:
  void SetUp() override {
    if (!is_built(entry().info)) GTEST_SKIP() << "not built: " << entry().info.reason;
  }
  void TearDown() override { limit_isa(isa_of_machine()); }

  static const BroadPhaseEntry& entry() { return *GetParam(); }
  static bool is_ours() { return entry().info.origin == Origin::ours; }
  static bool may_err(bool degenerate) { return degenerate && !entry().info.known_defect.empty(); }

  // The pairs as the algorithm ordered them, if it kept the promises about their form.
  static std::vector<IndexPair> ordered_pairs(BroadPhase& algorithm, PairSink& sink) {
    EXPECT_EQ(algorithm.find_pairs(sink), Status::ok);
    return sink.gather();
  }

  static void expect_truth(const std::vector<IndexPair>& found, const std::vector<IndexPair>& truth,
                           std::size_t boxes, bool degenerate) {
    auto sorted = found;
    std::ranges::sort(sorted);
    EXPECT_EQ(std::ranges::adjacent_find(sorted), sorted.end()) << "a pair comes twice";
    EXPECT_TRUE(std::ranges::all_of(
        sorted, [&](const IndexPair& pair) { return pair.a < pair.b && pair.b < boxes; }));
    if (may_err(degenerate)) return;
    std::vector<IndexPair> missing, extra;
    std::ranges::set_difference(truth, sorted, std::back_inserter(missing));
    std::ranges::set_difference(sorted, truth, std::back_inserter(extra));
    EXPECT_TRUE(missing.empty()) << missing.size() << " of " << truth.size() << " missing, first "
                                 << missing[0].a << ' ' << missing[0].b;
    EXPECT_TRUE(extra.empty()) << extra.size() << " too many, first " << extra[0].a << ' '
                               << extra[0].b;
  }
};

std::string test_name(const testing::TestParamInfo<const BroadPhaseEntry*>& param) {
  std::string name = param.param->info.name;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

std::vector<const BroadPhaseEntry*> entries(bool ours_only) {
  std::vector<const BroadPhaseEntry*> list;
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (!ours_only || entry.info.origin == Origin::ours) list.push_back(&entry);
  }
  return list;
}

// What is promised of our own only.
class OurBroadPhases : public BroadPhases {};

INSTANTIATE_TEST_SUITE_P(Registry, BroadPhases, testing::ValuesIn(entries(false)), test_name);
INSTANTIATE_TEST_SUITE_P(Registry, OurBroadPhases, testing::ValuesIn(entries(true)), test_name);

TEST(BoxSets, BothOutcomesAreCommon) {
  std::size_t with_pairs = 0, with_both = 0, pairs = 0;
  for (const Sample& sample : samples()) {
    const std::size_t n = sample.set.boxes.size();
    with_pairs += sample.truth.empty() ? 0 : 1;
    with_both += !sample.truth.empty() && sample.truth.size() < n * (n - 1) / 2 ? 1 : 0;
    pairs += sample.truth.size();
  }
  EXPECT_GT(with_pairs, samples().size() * 3 / 4);
  EXPECT_GT(with_both, samples().size() * 2 / 3);
  EXPECT_GT(pairs, 100'000u);
}

TEST_P(BroadPhases, FindThePairsOfEverySet) {
  Executor executor(2);
  // One instance for all sets, so that each build also has to forget the set before.
  const auto algorithm = entry().make(executor);
  PairSink sink;
  for (const Sample& sample : samples()) {
    if (sample.set.extreme && !is_ours()) continue;
    SCOPED_TRACE(sample.set.name);
    algorithm->build(sample.set.boxes);
    const auto found = ordered_pairs(*algorithm, sink);
    expect_truth(found, sample.truth, sample.set.boxes.size(), sample.set.degenerate);
    const auto again = ordered_pairs(*algorithm, sink);
    if (is_ours()) {
      EXPECT_EQ(again, found) << "asked again";
    } else {  // a library may order them as its threads happen to run
      expect_truth(again, sample.truth, sample.set.boxes.size(), sample.set.degenerate);
    }
  }
}

// Widths, each with the kind of its threads.
constexpr std::pair<int, ExecutorKind> executors[] = {{1, ExecutorKind::crew},
                                                      {2, ExecutorKind::crew},
                                                      {3, ExecutorKind::crew},
                                                      {2, ExecutorKind::onetbb},
                                                      {4, ExecutorKind::onetbb}};

TEST_P(OurBroadPhases, WriteTheSameAtEveryWidth) {
  std::vector<const BoxSet*> sets = {&crowd().set};
  for (const Sample& sample : samples()) sets.push_back(&sample.set);
  for (const BoxSet* set : sets) {
    SCOPED_TRACE(set->name);
    std::optional<std::vector<IndexPair>> first;
    for (const auto& [width, kind] : executors) {
      Executor executor(width, Pinning::none, kind);
      const auto algorithm = entry().make(executor);
      PairSink sink;
      algorithm->build(set->boxes);
      const auto found = ordered_pairs(*algorithm, sink);
      if (!first) first = found;
      EXPECT_EQ(*first == found, true) << "width " << width << ", " << to_string(kind);
    }
  }
}

TEST_P(OurBroadPhases, FindTheSameWithEveryInstructionSet) {
  std::vector<const Sample*> tried = {&crowd()};
  for (const Sample& sample : samples()) tried.push_back(&sample);
  Executor executor(2);
  const auto algorithm = entry().make(executor);
  PairSink sink;
  for (const Isa level : isa_levels()) {
    SCOPED_TRACE(to_string(level));
    limit_isa(level);
    for (const Sample* sample : tried) {
      SCOPED_TRACE(sample->set.name);
      algorithm->build(sample->set.boxes);
      expect_truth(ordered_pairs(*algorithm, sink), sample->truth, sample->set.boxes.size(), false);
    }
  }
}

// Boxes that change from frame to frame, and what changed. Two arrays take turns, as the harness
// has it, and the older one is spoilt, so that nobody goes on using it.
class Frames {
 public:
  explicit Frames(std::vector<Aabb> boxes) : boxes_{boxes, std::move(boxes)} {}

  std::span<const Aabb> boxes() const { return boxes_[now_]; }
  // The next frame's boxes, to be changed at will.
  std::vector<Aabb>& next() {
    next_ = boxes_[now_];
    return next_;
  }
  FrameChange change() {
    auto& before = boxes_[now_];
    moved_.clear(), inserted_.clear(), removed_.clear();
    before.resize(next_.size(), Aabb::empty());
    for (std::uint32_t id = 0; id < next_.size(); ++id) {
      if (before[id] == next_[id]) continue;
      auto& list = before[id].is_empty() ? inserted_ : next_[id].is_empty() ? removed_ : moved_;
      list.push_back(id);
    }
    now_ = 1 - now_;
    boxes_[now_] = next_;
    return {boxes_[now_], moved_, inserted_, removed_};
  }
  void spoil_the_older() { std::ranges::fill(boxes_[1 - now_], Aabb{{-9, -9, -9}, {9, 9, 9}}); }

 private:
  std::vector<Aabb> boxes_[2];
  std::vector<Aabb> next_;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
  std::size_t now_ = 0;
};

void shift(Aabb& box, Random& random, float reach) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float by = uniform(random, -reach, reach);
    box.min[axis] += by;
    box.max[axis] = std::max(box.min[axis], box.max[axis] + by);
  }
}

struct Churn {
  std::string name;
  float moved = 0, reach = 0, teleported = 0, inserted = 0, removed = 0;
};

TEST_P(BroadPhases, FollowTheFrames) {
  const Churn churns[] = {
      {.name = "at rest"},
      {.name = "a tenth moves", .moved = 0.1f, .reach = 0.01f},
      {.name = "all move a little", .moved = 1, .reach = 0.002f},
      {.name = "all move far", .moved = 1, .reach = 0.3f},
      {.name = "teleports", .moved = 0.1f, .reach = 0.01f, .teleported = 0.1f},
      {.name = "insertion", .inserted = 0.2f},
      {.name = "removal", .removed = 0.3f},
      {.name = "all at once",
       .moved = 0.5f,
       .reach = 0.02f,
       .teleported = 0.02f,
       .inserted = 0.1f,
       .removed = 0.1f},
  };
  Executor executor(2);
  const auto algorithm = entry().make(executor);
  PairSink sink;
  Random random(42);
  for (const Churn& churn : churns) {
    SCOPED_TRACE(churn.name);
    Frames frames(uniform_boxes(random, 500, 0.15f));
    algorithm->build(frames.boxes());
    for (int frame = 0; frame < 6; ++frame) {
      SCOPED_TRACE(frame);
      if (frame > 0) {
        auto& boxes = frames.next();
        for (Aabb& box : boxes) {
          const float dice = uniform(random, 0, 1);
          if (box.is_empty()) {  // a body that comes back
            if (dice < churn.inserted) box = uniform_boxes(random, 1, 0.15f)[0];
          } else if (dice < churn.removed) {
            box = Aabb::empty();
          } else if (dice < churn.removed + churn.teleported) {
            shift(box, random, 2);
          } else if (dice < churn.removed + churn.teleported + churn.moved) {
            shift(box, random, churn.reach);
          }
        }
        const auto fresh = uniform_boxes(
            random, static_cast<std::size_t>(churn.inserted * static_cast<float>(boxes.size())),
            0.15f);
        boxes.insert(boxes.end(), fresh.begin(), fresh.end());
        algorithm->update(frames.change());
        frames.spoil_the_older();
      }
      const auto truth = true_pairs(frames.boxes());
      EXPECT_GT(truth.size(), 20u);
      expect_truth(ordered_pairs(*algorithm, sink), truth, frames.boxes().size(), false);
    }
  }
}

// The first bodies come, and the last ones go, in an update; nothing changes for some frames between.
TEST_P(BroadPhases, FollowFromNothingToNothing) {
  Executor executor(2);
  const auto algorithm = entry().make(executor);
  PairSink sink;
  Random random(43);
  Frames frames(std::vector<Aabb>{});
  algorithm->build(frames.boxes());
  EXPECT_TRUE(ordered_pairs(*algorithm, sink).empty());
  bool present = false;
  for (const int idle : {0, 0, 0, 1, 2, 2, 3, 3, 9, 9, 20, 40, 0, 1}) {
    present = !present;
    for (int frame = 0; frame <= idle; ++frame) {
      SCOPED_TRACE(testing::Message() << "frame " << frame << " of " << idle + 1);
      std::vector<Aabb> next(frames.boxes().begin(), frames.boxes().end());
      if (frame == 0)
        next = present ? uniform_boxes(random, 60, 0.5f) : std::vector<Aabb>(60, Aabb::empty());
      frames.next() = std::move(next);
      algorithm->update(frames.change());
      frames.spoil_the_older();
      const auto truth = true_pairs(frames.boxes());
      EXPECT_EQ(truth.empty(), !present);
      expect_truth(ordered_pairs(*algorithm, sink), truth, frames.boxes().size(), false);
    }
  }
}

// Boxes that grow and shrink without moving, to and from no volume.
TEST_P(BroadPhases, FollowSizes) {
  Executor executor(2);
  const auto algorithm = entry().make(executor);
  PairSink sink;
  Random random(44);
  Frames frames(uniform_boxes(random, 400, 0.1f));
  algorithm->build(frames.boxes());
  for (int frame = 0; frame < 6; ++frame) {
    SCOPED_TRACE(frame);
    for (Aabb& box : frames.next()) {
      const float side = std::max(0.0f, uniform(random, -0.1f, 0.2f));
      for (std::size_t axis = 0; axis < 3; ++axis) box.max[axis] = box.min[axis] + side;
    }
    algorithm->update(frames.change());
    frames.spoil_the_older();
    expect_truth(ordered_pairs(*algorithm, sink), true_pairs(frames.boxes()), 400, true);
  }
}

// The order too depends only on the frames that came, not on the width or the kind of threads.
TEST_P(OurBroadPhases, FollowTheSameAtEveryWidth) {
  std::optional<std::vector<IndexPair>> first;
  for (const auto& [width, kind] : executors) {
    Random random(45);
    Executor executor(width, Pinning::none, kind);
    const auto algorithm = entry().make(executor);
    PairSink sink;
    Frames frames(uniform_boxes(random, crowd_size, 0.03f));
    algorithm->build(frames.boxes());
    std::vector<IndexPair> all;
    for (const float reach : {0.00001f, 0.01f, 0.0001f}) {
      for (Aabb& box : frames.next()) shift(box, random, reach);
      algorithm->update(frames.change());
      frames.spoil_the_older();
      const auto found = ordered_pairs(*algorithm, sink);
      all.insert(all.end(), found.begin(), found.end());
    }
    if (!first) {
      first = all;
      expect_truth(sink.gather(), true_pairs(frames.boxes()), crowd_size, false);
    }
    EXPECT_EQ(*first == all, true) << "width " << width << ", " << to_string(kind);
  }
}

// Every pair overlaps: the memory is that of the output, and no pair is dropped.
TEST_P(BroadPhases, BearAStackInOnePlace) {
  const std::size_t count = is_ours() ? stack_size : 500;
  const std::vector<Aabb> boxes(count, Aabb{{1, 2, 3}, {2, 3, 4}});
  Executor executor(2);
  const auto algorithm = entry().make(executor);
  PairSink sink;
  algorithm->build(boxes);
  ASSERT_EQ(algorithm->find_pairs(sink), Status::ok);
  std::uint64_t hash = 0, true_hash = 0;
  std::size_t room = 0;
  bool in_order = true;
  for (const PairBuffer& chunk : sink.chunks()) {
    hash += base::pair_hash(chunk.pairs());
    room += chunk.capacity();
    for (const IndexPair& pair : chunk.pairs()) in_order &= pair.a < pair.b && pair.b < count;
  }
  EXPECT_TRUE(in_order);
  if (may_err(true)) return;
  for (std::uint64_t a = 0; a < count; ++a) {
    for (std::uint64_t b = a + 1; b < count; ++b) true_hash += base::mix((a << 32) + b);
  }
  EXPECT_EQ(sink.size(), count * (count - 1) / 2);
  EXPECT_EQ(hash, true_hash);
  if (is_ours()) {
    EXPECT_LE(room, 2 * sink.size() + 256 * sink.chunks().size());
  }
}

}  // namespace
}  // namespace touchstone
