// Tests the algorithms of results/how_to.md, which are compiled as they stand there (tests/CMakeLists.txt).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "algorithms/core/executor/executor.h"
#include "harness/check/check_run.h"
#include "harness/grade/answer_check.h"
#include "tests/harness/check/planted.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {

namespace entries {
std::vector<BroadPhaseEntry> broad_phase_mine();
std::vector<NarrowPhaseEntry> narrow_phase_mine();
}  // namespace entries

namespace {

std::vector<Aabb> random_boxes(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(0, 10);
  std::vector<Aabb> boxes;
  for (int i = 0; i < 60; ++i) {
    const float x = place(random), y = place(random), z = place(random);
    boxes.push_back(i % 20 == 7 ? Aabb::empty() : Aabb{{x, y, z}, {x + 2, y + 2, z + 2}});
  }
  return boxes;
}

TEST(HowTo, TheBroadPhaseFindsAllPairs) {
  Executor executor(1);
  const auto mine = entries::broad_phase_mine().at(0).make(executor);
  for (unsigned frame = 0; frame < 3; ++frame) {
    const std::vector<Aabb> boxes = random_boxes(frame);
    if (frame == 0) mine->build(boxes);
    if (frame > 0) mine->update({.boxes = boxes, .moved = {}, .inserted = {}, .removed = {}});
    std::vector<IndexPair> truth;
    for (std::uint32_t a = 0; a < boxes.size(); ++a) {
      for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
        if (overlap(boxes[a], boxes[b])) truth.push_back({a, b});
      }
    }
    EXPECT_GT(truth.size(), 5u);
    PairSink sink;
    EXPECT_EQ(mine->find_pairs(sink), Status::ok);
    std::vector<IndexPair> found = sink.gather();
    EXPECT_TRUE(grade::check_pairs(found, truth, {}).none());
  }
}

TEST(HowTo, TheNarrowPhaseIsRight) {
  const TemporaryFolder folder;
  const kinds::Regime balls = balls_regime();
  const NarrowPhaseEntry mine = entries::narrow_phase_mine().at(0);
  check::CheckRequest request;
  request.scalars = {Precision::float64};
  ask(request, {&mine});
  draw(request, balls);
  request.cases = 40;
  request.out = folder.path() / "out";
  const auto result = check::run_check(request);
  EXPECT_EQ(result.of<kinds::CaseChecker>().answers().begin()->second.answers, 40 * 4);
  EXPECT_THAT(result.ours_wrong(), testing::IsEmpty());
}

}  // namespace
}  // namespace touchstone
