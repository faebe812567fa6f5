// Tests of the continuous and of the discrete way through a scene's steps.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/measure/motion.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

measure::MotionInput input_of(const std::string& text, bool is_linear = false) {
  const TemporaryFolder folder;
  const auto file = folder.write("scene.toml", text);
  return measure::motion_input(scene::load_scene(file), file, is_linear);
}

// A ball goes through a wall and comes to rest far behind; another passes beside the wall; a
// half-space is under all; the last ball falls into it.
const std::string wall = R"(
time_step = 1
[[body]]
shape = {type = "box", half_extents = [0.01, 1, 1]}
moving = false
[[body]]
shape = {type = "sphere", radius = 0.1}
translation = [-5, 0, 0]
velocity = [10, 0, 0]
[[body]]
shape = {type = "sphere", radius = 0.1}
translation = [-5, 5, 0]
velocity = [10, 0, 0]
[[body]]
shape = {type = "halfspace", normal = [0, 0, 1], offset = -2}
moving = false
[[body]]
shape = {type = "sphere", radius = 0.1}
translation = [50, 0, 0]
velocity = [0, 0, -2]
)";

std::vector<measure::StepAnswer> cast(const measure::MotionInput& input, const char* name,
                                      int threads = 1) {
  Executor executor(threads);
  measure::ContinuousSteps steps(
      input,
      {registry::find<BroadPhaseEntry>("linear-bvh"), {registry::find<CastEntry>(name)}, {}, 0},
      executor);
  steps.play();
  return steps.answers();
}

std::vector<measure::StepAnswer> look(const measure::MotionInput& input, int substeps) {
  Executor executor(1);
  measure::DiscreteSteps steps(input,
                               {registry::find<BroadPhaseEntry>("linear-bvh"),
                                {registry::find<NarrowPhaseEntry>("gjk")},
                                {},
                                substeps},
                               executor);
  steps.play();
  const auto once = steps.answers();
  steps.play();
  EXPECT_EQ(once.front().hits, steps.answers().front().hits);
  return once;
}

TEST(MotionPlay, CastsFindWhatSubstepsMiss) {
  const measure::MotionInput input = input_of(wall);
  const std::vector<IndexPair> hits = {{0, 1}, {3, 4}};
  const auto answers = cast(input, "rigid-advancement");
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers.front().hits, hits);
  EXPECT_TRUE(answers.front().unknown.empty());
  EXPECT_EQ(look(input, 1).front().hits, (std::vector<IndexPair>{{3, 4}}));
  EXPECT_EQ(look(input, 2).front().hits, hits);  // a substep ends in the wall
}

TEST(MotionPlay, LeavesRotationsOutWhereAsked) {
  const std::string spinners = "generator = \"spinners\"\ncount = 8\nframes = 2\n";
  EXPECT_TRUE(input_of(spinners).turns());
  EXPECT_FALSE(input_of(spinners, true).turns());
  EXPECT_EQ(input_of(spinners).steps.size(), 2U);
}

// A cast of straight motion gives up on what turns, and says so.
TEST(MotionPlay, PairsThatACastDoesNotTakeAreUnknown) {
  const auto input = input_of("generator = \"spinners\"\ncount = 40\nframes = 1\n");
  const auto answers = cast(input, "gjk-ray-cast");
  EXPECT_FALSE(answers.front().unknown.empty());
  EXPECT_TRUE(answers.front().hits.empty());
}

TEST(MotionPlay, AnswersAreThoseOfEveryWidthAndOfTheExactCast) {
  for (const char* scene : {"generator = \"bullets\"\ncount = 150\nframes = 2\n",
                            "generator = \"robot\"\ncount = 64\nframes = 1\n",
                            "generator = \"cards\"\ncount = 26\nframes = 1\n"}) {
    const auto input = input_of(scene);
    const auto alone = cast(input, "rigid-advancement"), two = cast(input, "rigid-advancement", 2);
    const auto exact = cast(input, "exact");
    std::size_t hits = 0, misses = 0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_EQ(alone[i].hits, two[i].hits) << scene;
      EXPECT_EQ(alone[i].hits, exact[i].hits) << scene;
      EXPECT_EQ(alone[i].misses, exact[i].misses) << scene;
      hits += alone[i].hits.size();
      misses += alone[i].misses.size();
    }
    EXPECT_GT(hits, 0U) << scene;
    EXPECT_GT(misses, 0U) << scene;
  }
}

}  // namespace
}  // namespace touchstone
