// Tests of warm contestants: each pair's memory, the order of frames, and the rows of a campaign.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "harness/base/random.h"
#include "harness/campaign/plan.h"
#include "harness/campaign/runner.h"
#include "harness/measure/narrow_sampler.h"
#include "harness/stats/samples.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

measure::NarrowSet random_set(base::Random& random, std::uint32_t bodies, std::size_t frames) {
  measure::NarrowSet set{"some", record::QueryTask::intersect, ShapeKind::box, ShapeKind::hull, {}};
  for (std::size_t frame = 0; frame < frames; ++frame) {
    grade::PairGroup group{ShapeKind::box, ShapeKind::hull, {}, {}};
    for (std::uint32_t a = 0; a < bodies; ++a) {
      for (std::uint32_t b = 0; b < a; ++b) {
        if (random.below(3) != 0) continue;
        const bool swap = (a + b) % 2 == 0;  // then the first of a kind has the greater number
        group.first.push_back(swap ? a : b);
        group.second.push_back(swap ? b : a);
      }
    }
    if (frame % 4 == 3) group = {ShapeKind::box, ShapeKind::hull, {}, {}};
    set.frames.push_back(group);
  }
  return set;
}

TEST(WarmPairs, APairHasOneSlotAndATaskItsOwn) {
  base::Random random(3, 1);
  const measure::NarrowSet set = random_set(random, 30, 9);
  constexpr std::size_t slots_a_task = 16;
  const measure::WarmPairs warm(set, slots_a_task);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> slot_of;
  bool some_in_another_order = false;
  for (std::size_t i = 0; i < set.frames.size(); ++i) {
    const grade::PairGroup& group = set.frames[i];
    const measure::WarmPairs::Frame& frame = warm.frame(i);
    ASSERT_EQ(frame.pairs.size(), group.size());
    ASSERT_EQ(frame.slots.size(), group.size());
    ASSERT_EQ(frame.begins.size(), warm.tasks() + 1);
    EXPECT_EQ(frame.begins.front(), 0u);
    EXPECT_EQ(frame.begins.back(), group.size());
    some_in_another_order = some_in_another_order || !frame.places.empty();
    for (std::size_t task = 0; task < warm.tasks(); ++task) {
      for (std::size_t k = frame.begins[task]; k < frame.begins[task + 1]; ++k) {
        EXPECT_EQ(frame.slots[k] / slots_a_task, task);
      }
    }
    for (std::size_t k = 0; k < group.size(); ++k) {
      const std::size_t place = frame.places.empty() ? k : frame.places[k];
      const std::pair pair{frame.pairs.first[k], frame.pairs.second[k]};
      EXPECT_EQ(pair, (std::pair{group.first[place], group.second[place]}));
      const auto at = slot_of.try_emplace(pair, frame.slots[k]).first;
      EXPECT_EQ(at->second, frame.slots[k]);
    }
  }
  EXPECT_TRUE(some_in_another_order);
  EXPECT_EQ(slot_of.size(), warm.slots());
  std::set<std::uint32_t> slots;
  for (const auto& [pair, slot] : slot_of) slots.insert(slot);
  EXPECT_EQ(slots.size(), warm.slots());
  EXPECT_EQ(*slots.rbegin() + 1, warm.slots());
}

constexpr int frames = 12;

class Warm : public testing::Test {
 protected:
  Warm() {
    folder_.write("pairs.toml",
                  "generator = 'pairs'\ncount = 800\ndistinct = 100\nplacement = 'facing'\n"
                  "shapes = [{type = 'hull', points = 20}, 'box']\ngaps = [1e-2, -1e-2, 0.3]\n"
                  "sway = 0.5\nframes = " +
                      std::to_string(frames) + "\n");
    folder_.write("still.toml", "generator = 'pairs'\ncount = 8\n");
    folder_.write("moving.toml",
                  "generator = 'uniform'\ncount = 60\noverlaps = 4\nframes = 6\nstep = 0.2\n"
                  "shapes = ['box', 'capsule']\n");
  }
  campaign::Campaign campaign(const std::string& keys) {
    return campaign::read_campaign(folder_.write(
        "c.toml", "broad = 'none'\nthreads = 1\nsquares = 6\nrounds = 1\nprocesses = 1\n" + keys));
  }
  TemporaryFolder folder_;
};

// One pair a call, seven, and all: cold and warm the same answers to the digit.
TEST_F(Warm, AnswersDoNotDependOnTheBatch) {
  const scene::Scene scene = scene::load_scene(folder_.path() / "pairs.toml");
  const measure::BlockInput input(scene, scene::BoxKind::tight, true);
  const std::vector<std::vector<IndexPair>> pairs(frames, scene.pairs);
  constexpr std::array tasks = {record::QueryTask::distance, record::QueryTask::intersect};
  const std::vector<measure::NarrowSet> sets = measure::narrow_sets(input, "", pairs, tasks);
  Executor two(2);
  for (const bool warm : {false, true}) {
    const auto sampler = [&](int batch) {
      const measure::NarrowChoice choice{.entry = registry::find<NarrowPhaseEntry>("gjk"),
                                         .settings = {},
                                         .warm = warm,
                                         .batch = batch};
      return measure::NarrowSampler(choice, input, sets, two);
    };
    measure::NarrowSampler whole = sampler(measure::usual_batch), sevens = sampler(7),
                           alone = sampler(1);
    for (std::uint32_t set = 0; set < sets.size(); ++set) {
      for (std::uint32_t frame = 0; frame < frames; ++frame) {
        const measure::SampleRequest request{.set = set, .frame = frame};
        const std::uint64_t expected = whole.sample(request).outcome_hash;
        EXPECT_EQ(sevens.sample(request).outcome_hash, expected);
        EXPECT_EQ(alone.sample(request).outcome_hash, expected);
      }
    }
  }
}

// The answers to a frame are equal for all windows and numbers of workers.
TEST_F(Warm, AnswersDoNotDependOnTheWindow) {
  const scene::Scene scene = scene::load_scene(folder_.path() / "pairs.toml");
  const measure::BlockInput input(scene, scene::BoxKind::tight, true);
  std::vector<std::vector<IndexPair>> pairs(frames, scene.pairs);
  pairs[5].resize(300);
  std::ranges::reverse(pairs[7]);
  constexpr std::array tasks = {record::QueryTask::distance, record::QueryTask::intersect};
  const std::vector<measure::NarrowSet> sets = measure::narrow_sets(input, "", pairs, tasks);
  const measure::NarrowChoice choice{
      .entry = registry::find<NarrowPhaseEntry>("gjk"), .settings = {}, .warm = true};
  Executor one(1), two(2);
  measure::NarrowSampler straight(choice, input, sets, one), narrow(choice, input, sets, one),
      wide(choice, input, sets, two);
  ASSERT_GE(sets.size(), 4u);
  for (std::uint32_t set = 0; set < sets.size(); ++set) {
    std::vector<std::uint64_t> hash(frames);
    std::vector<std::vector<Outcome>> outcomes(frames);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      hash[frame] = straight.sample({.set = set, .frame = frame}).outcome_hash;
      outcomes[frame].assign(straight.outcomes().begin(), straight.outcomes().end());
    }
    base::Random random(9, set);
    for (int n = 0; n < 20; ++n) {
      const measure::SampleRequest request{
          .set = set,
          .frame = 1 + static_cast<std::uint32_t>(random.below(frames - 1)),
          .frames = 1 + static_cast<std::uint32_t>(random.below(30)),
          .skips_first = true};
      std::uint64_t expected = 0;
      std::size_t frame = request.frame;
      for (std::uint32_t i = 0; i < request.frames; ++i) {
        expected += hash[frame];
        frame = frame + 1 == frames ? 1 : frame + 1;
      }
      EXPECT_EQ(narrow.sample(request).outcome_hash, expected);
      EXPECT_EQ(wide.sample(request).outcome_hash, expected);
      // The answers are in the order of the set.
      const std::size_t first = outcomes[request.frame].size();
      ASSERT_GE(wide.outcomes().size(), first);
      for (std::size_t i = 0; i < first; ++i) {
        EXPECT_EQ(wide.outcomes()[i].answer, outcomes[request.frame][i].answer);
      }
      // A count between samples does not change later answers.
      narrow.sample({.set = set, .frame = 3});
      narrow.count_allocations({.set = set, .frame = 3});
      EXPECT_EQ(narrow.sample({.set = set, .frame = 4}).outcome_hash, hash[4]);
    }
  }
}

TEST_F(Warm, StandsBesideColdOnesInRowsAndTables) {
  const campaign::Campaign c = campaign(
      "scenes = 'pairs.toml'\nnarrow = ['gjk', 'sat', 'mpr']\nscalars = 'double'\n"
      "warm = [false, true]\ntasks = ['intersect', 'distance']\n");
  const campaign::RunResult result = campaign::run_campaign(c, folder_.path() / "out");
  EXPECT_TRUE(result.findings.departures().empty());
  std::map<std::string, std::int64_t> supports, queries;
  std::map<std::string, int> checks, samples;
  for (const record::RawRow& row : result.findings.rows()) {
    EXPECT_EQ(row.is_warm(), record::label_of(row).ends_with(" warm"));
    EXPECT_NE(row.status, record::RowStatus::wrong);
    EXPECT_LE(row.disagreements, 0);
    if (row.kind == record::RowKind::check) {
      ++checks[record::label_of(row)];
    } else {
      ++samples[record::label_of(row)];
      EXPECT_GE(row.frame, 1);
      if (row.task == record::QueryTask::distance && row.pair_kind == "hull-hull") {
        supports[record::label_of(row)] += row.support_calls;
        queries[record::label_of(row)] += row.pair_count;
      }
    }
  }
  EXPECT_THAT(checks,
              testing::UnorderedElementsAre(testing::Pair("gjk double", testing::Gt(0)),
                                            testing::Pair("gjk double warm", checks["gjk double"]),
                                            testing::Pair("sat double", testing::Gt(0)),
                                            testing::Pair("sat double warm", checks["sat double"]),
                                            testing::Pair("mpr double", testing::Gt(0))));
  EXPECT_EQ(samples.size(), 5u);
  const double cold =
      static_cast<double>(supports["gjk double"]) / static_cast<double>(queries["gjk double"]);
  const double warm = static_cast<double>(supports["gjk double warm"]) /
                      static_cast<double>(queries["gjk double warm"]);
  EXPECT_LT(2 * warm, cold);

  const stats::Results read = stats::read_results(folder_.path() / "out");
  for (const stats::SampleSet& set : read.sets) {
    EXPECT_NE(set.find("gjk double warm"), nullptr);
    EXPECT_EQ(set.baseline().label, "gjk double");
  }
  std::vector<std::string> planned;
  for (const campaign::PlannedBlock& block : campaign::plan_campaign(c)) {
    for (const auto& set : block.sets) {
      planned.insert(planned.end(), set.contestants.begin(), set.contestants.end());
    }
  }
  EXPECT_THAT(planned, testing::Contains("sat double warm"));
}

// The pairs come and go, as broad phases report them.
TEST_F(Warm, TakesPairsThatComeAndGo) {
  const campaign::Campaign c = campaign(
      "scenes = 'moving.toml'\nnarrow = ['gjk']\nwarm = true\npairing = 'product'\n[[group]]\n"
      "broad = ['naive', 'uniform-grid']\n");
  const campaign::RunResult result = campaign::run_campaign(c, folder_.path() / "out");
  int rows = 0;
  for (const record::RawRow& row : result.findings.rows()) {
    if (row.narrow.empty()) continue;
    EXPECT_NE(row.status, record::RowStatus::wrong);
    rows += row.is_warm() && row.kind == record::RowKind::sample;
  }
  EXPECT_GT(rows, 0);
  EXPECT_TRUE(result.findings.departures().empty());
}

TEST_F(Warm, WantsAFrameBefore) {
  const std::string keys = "scenes = 'still.toml'\nnarrow = 'gjk'\nwarm = true\n";
  EXPECT_THAT(input_fault([&] { campaign::run_campaign(campaign(keys), folder_.path() / "out"); }),
              testing::AllOf(HasSubstr("still.toml"), HasSubstr("frames")));
  EXPECT_NO_THROW(campaign::plan_campaign(campaign(keys + "frames = 2\n")));
}

}  // namespace
}  // namespace touchstone
