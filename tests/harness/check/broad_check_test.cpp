// Tests that checks of broad phases accept ours and find planted faults.
#include "harness/kinds/box/broad_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <set>

namespace touchstone {
namespace {

using ::testing::HasSubstr;

using Find = std::function<Status(std::span<const Aabb>, PairSink&)>;

// Tests all pairs, which `find` writes or spoils.
class PlantedBroadPhase final : public BroadPhase {
 public:
  explicit PlantedBroadPhase(Find find) : find_(std::move(find)) {}
  void build(std::span<const Aabb> boxes) override { boxes_ = boxes; }
  void update(const FrameChange& change) override { boxes_ = change.boxes; }
  Status find_pairs(PairSink& sink) override { return find_(boxes_, sink); }

 private:
  Find find_;
  std::span<const Aabb> boxes_;
};

BroadPhaseEntry planted_search(const Find& find, Origin origin = Origin::ours) {
  return {.info = {.name = "planted", .citation = "a test", .origin = origin},
          .make = [=](Executor&) { return std::make_unique<PlantedBroadPhase>(find); }};
}

// Writes all pairs whose boxes overlap, except the last `dropped` of each frame.
Status all_but(std::size_t dropped, std::span<const Aabb> boxes, PairSink& sink) {
  std::vector<IndexPair> pairs;
  for (std::uint32_t a = 0; a < boxes.size(); ++a) {
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
      if (overlap(boxes[a], boxes[b])) pairs.push_back({a, b});
    }
  }
  sink.start(1);
  for (std::size_t i = 0; i + dropped < pairs.size(); ++i) {
    sink.chunk(0).push(pairs[i].a, pairs[i].b);
  }
  return Status::ok;
}

std::vector<kinds::BroadCheck> check(const BroadPhaseEntry& entry,
                                     std::span<const kinds::BoxScene> scenes) {
  const std::vector<const BroadPhaseEntry*> entries = {&entry};
  return kinds::check_broad_phases(entries, scenes, 10);
}

TEST(BoxScenes, HaveFramesThatChangeAndPairsOfEachKind) {
  const std::vector<kinds::BoxScene> scenes = kinds::box_scenes(1);
  std::set<std::string> names;
  for (const kinds::BoxScene& scene : scenes) {
    names.insert(scene.name);
    ASSERT_EQ(scene.frames.size(), 5u);
    std::size_t pairs = 0, apart = 0, empty = 0;
    for (std::size_t f = 0; f < scene.frames.size(); ++f) {
      const std::vector<Aabb>& boxes = scene.frames[f];
      if (f > 0) {
        EXPECT_GE(boxes.size(), scene.frames[f - 1].size());
      }
      for (const Aabb& box : boxes) {
        if (box.is_empty()) {
          ++empty;
          continue;
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_TRUE(std::isfinite(box.min[axis]) && std::isfinite(box.max[axis])) << scene.name;
          EXPECT_LE(box.min[axis], box.max[axis]) << scene.name;
        }
      }
      for (std::size_t a = 0; a < boxes.size(); ++a) {
        for (std::size_t b = a + 1; b < boxes.size(); ++b) {
          ++(overlap(boxes[a], boxes[b]) ? pairs : apart);
        }
      }
    }
    EXPECT_GT(pairs, 20u) << scene.name;
    EXPECT_GT(apart, 20u) << scene.name;
    EXPECT_GT(empty, 20u) << scene.name;
  }
  EXPECT_EQ(names.size(), scenes.size());
  EXPECT_EQ(kinds::box_scenes(1)[0].frames, scenes[0].frames);
  EXPECT_NE(kinds::box_scenes(2)[0].frames, scenes[0].frames);
}

TEST(BroadCheck, EveryOneOfOurs) {
  const std::vector<kinds::BoxScene> scenes = kinds::box_scenes(3);
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (entry.info.origin != Origin::ours) continue;
    for (const kinds::BroadCheck& one : check(entry, scenes)) {
      EXPECT_TRUE(one.good()) << entry.info.name << ' ' << one.scene->name << ": " << one.faults();
      EXPECT_GT(one.pairs, 0);
    }
  }
}

TEST(BroadCheck, ADroppedPairIsFound) {
  const std::vector<kinds::BoxScene> scenes = kinds::box_scenes(1);
  const BroadPhaseEntry good =
      planted_search([](auto boxes, auto& sink) { return all_but(0, boxes, sink); });
  const BroadPhaseEntry bad =
      planted_search([](auto boxes, auto& sink) { return all_but(1, boxes, sink); });
  for (const kinds::BroadCheck& one : check(good, scenes)) EXPECT_TRUE(one.good()) << one.faults();
  for (const kinds::BroadCheck& one : check(bad, scenes)) {
    EXPECT_FALSE(one.good());
    EXPECT_THAT(one.faults(), HasSubstr("frame 0: 1 missing"));
  }
}

// Answers all pairs where it is asked for those of some bodies, and tells no end.
class ForgetfulBroadPhase final : public BroadPhase {
 public:
  void build(std::span<const Aabb> boxes) override { boxes_ = boxes; }
  void update(const FrameChange& change) override { boxes_ = change.boxes; }
  Status find_pairs(PairSink& sink) override { return all_but(0, boxes_, sink); }
  Status find_pairs_of(std::span<const std::uint32_t>, PairSink& sink) override {
    return find_pairs(sink);
  }
  Status find_changes(PairSink& began, PairSink& ended) override {
    const Status status = BroadPhase::find_changes(began, ended);
    ended.start(0);
    return status;
  }

 private:
  std::span<const Aabb> boxes_;
};

TEST(BroadCheck, WrongAnswersToOtherQuestionsAreFound) {
  const std::vector<kinds::BoxScene> scenes = {kinds::box_scenes(1)[0]};
  const BroadPhaseEntry entry = {
      .info = {.name = "planted", .citation = "a test", .origin = Origin::ours},
      .make = [](Executor&) { return std::make_unique<ForgetfulBroadPhase>(); }};
  const std::vector<kinds::BroadCheck> checks = check(entry, scenes);
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_FALSE(checks[0].good());
  for (const char* words :
       {"of the moved: ", "of the awake: ", "ended: ", "began of the awake: "}) {
    EXPECT_THAT(checks[0].faults(), HasSubstr(words));
  }
  for (const kinds::FrameFaults& faults : checks[0].frames) {
    EXPECT_TRUE(faults.pairs.none());
    EXPECT_TRUE(faults.began.none());
  }
}

TEST(BroadCheck, CrashesHangsAndRefusalsAreFound) {
  const std::vector<kinds::BoxScene> scenes = {kinds::box_scenes(1)[0]};
  const auto status = [&](const Find& find, double seconds) {
    const BroadPhaseEntry entry = planted_search(find, Origin::peer);
    const std::vector<const BroadPhaseEntry*> entries = {&entry};
    const std::vector<kinds::BroadCheck> checks =
        kinds::check_broad_phases(entries, scenes, seconds);
    EXPECT_FALSE(checks[0].good());
    EXPECT_FALSE(checks[0].faults().empty());
    return checks[0].status;
  };
  EXPECT_EQ(status([](auto, auto&) -> Status { std::abort(); }, 10), Status::crashed);
  EXPECT_EQ(status(
                [](auto, auto&) -> Status {
                  for (;;) usleep(1000);
                },
                0.1),
            Status::timed_out);
  EXPECT_EQ(status([](auto, auto&) { return Status::capacity; }, 10), Status::capacity);
}

}  // namespace
}  // namespace touchstone
