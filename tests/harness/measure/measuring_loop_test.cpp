// Tests of the measuring loop with contestants that only count.
#include "harness/measure/measuring_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <map>
#include <set>

#include "harness/measure/noise.h"

namespace touchstone {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::SizeIs;

// A sampler that reports the number of its calls, and crashes at a chosen call.
class Counter final : public measure::Sampler {
 public:
  explicit Counter(int crash_at) : crash_at_(crash_at) {}
  measure::SampleReply sample(const measure::SampleRequest& request) override {
    if (++calls_ == crash_at_) std::raise(SIGSEGV);
    measure::SampleReply reply;
    reply.durations.add("work", 1e-3 * request.frames);
    reply.durations.add("rest", 0.5);
    reply.pairs = calls_;
    return reply;
  }

 private:
  int crash_at_, calls_ = 0;
};

measure::MeasuredContestant counter(const std::string& label, int crash_at = 0) {
  return {label, false, [crash_at] { return std::make_unique<Counter>(crash_at); }};
}

class Job : public measure::MeasuringJob {
 public:
  std::vector<measure::Round> rounds;
  std::vector<std::size_t> lost_at_start;
  std::set<std::size_t> without_time;  // numbers of processes
  std::int64_t wrong_pairs = -1;
  int most_calls = 1 << 20;

  std::vector<Untimed> warm_up(std::size_t, std::span<const std::size_t> sets,
                               const measure::ProcessLaps&) override {
    std::vector<Untimed> all;
    for (const std::size_t set : sets) all.push_back({set, {}});
    return all;
  }
  double deadline(std::size_t, std::size_t, std::uint32_t) const override { return 60; }
  bool is_right(std::size_t, std::size_t, const measure::SampleRequest&,
                const measure::SampleReply& reply) const override {
    return reply.pairs != wrong_pairs;
  }
  bool has_time(std::size_t, const measure::ProcessLaps& process) const override {
    return !without_time.contains(static_cast<std::size_t>(process.process));
  }
  void lose(std::size_t contestant, std::size_t, int, std::uint32_t,
            const measure::Loss&) override {
    lost_at_start.push_back(contestant);
  }
  void take(measure::Round& round) override { rounds.push_back(round); }
  bool goes_on() override { return --most_calls > 0; }
};

measure::MeasurePlan plan_of(std::vector<measure::MeasuredContestant> contestants, int squares,
                             int processes) {
  measure::MeasurePlan plan;
  measure::MeasuredSet& set = plan.sets.emplace_back();
  for (std::size_t i = 0; i < contestants.size(); ++i) set.members.push_back(i);
  set.groups = {set.members};
  set.frames = 10;
  set.starts = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  set.window = 2;
  plan.contestants = std::move(contestants);
  plan.periods = measure::periods(squares, processes);
  plan.seed = 5;
  return plan;
}

TEST(Durations, AddUpByName) {
  measure::Durations durations;
  durations.add("a", 1);
  durations.add("b", 2);
  durations.add("a", 3);
  EXPECT_EQ(durations.of("a"), 4);
  EXPECT_EQ(durations.sum(), 6);
  EXPECT_TRUE(std::isnan(durations.of("c")));
  ASSERT_EQ(durations.all().size(), 2u);
  EXPECT_EQ(durations.all()[1].name(), "b");
  EXPECT_THROW(durations.add("a name of sixteen", 1), std::length_error);
}

TEST(MeasuringLoop, EveryRoundHasEachContestantInAnOrderOfItsOwn) {
  const measure::MeasurePlan plan = plan_of({counter("a"), counter("b"), counter("c")}, 4, 2);
  Job job;
  measure::MeasuringLoop(plan, job).run();
  ASSERT_THAT(job.rounds, SizeIs(4 * 3));
  std::map<std::pair<std::int64_t, std::int64_t>, std::set<std::size_t>> of_position;
  for (std::size_t i = 0; i < job.rounds.size(); ++i) {
    const measure::Round& round = job.rounds[i];
    EXPECT_EQ(round.square, static_cast<std::int64_t>(i / 3));
    EXPECT_EQ(round.round, static_cast<std::int64_t>(i % 3));
    EXPECT_EQ(round.process, i / 6);
    EXPECT_EQ(round.request.frame, 1 + 2 * i % 9);
    ASSERT_THAT(round.samples, SizeIs(3));
    const measure::LatinSquare order = measure::square_order(plan, 0, round.square, 3);
    for (std::size_t position = 0; position < 3; ++position) {
      const measure::Sample& sample = round.samples[position];
      EXPECT_EQ(sample.contestant, order[i % 3][position]);
      EXPECT_EQ(sample.position, static_cast<std::int64_t>(position));
      EXPECT_EQ(sample.reply.durations.of("work"), 2e-3);
      // A worker is warm within its process: it has had one untimed call, and the samples before
      // this one.
      EXPECT_EQ(sample.reply.pairs, static_cast<std::int64_t>(2 + i % 6));
      of_position[{round.square, sample.position}].insert(sample.contestant);
    }
    EXPECT_EQ(round.ends_lap, i % 3 == 2);
    EXPECT_EQ(round.ends_period, i == 11);
    EXPECT_EQ(round.stop, i == 11 ? measure::Stop::rounds : measure::Stop::none);
  }
  for (const auto& [place, contestants] : of_position) EXPECT_THAT(contestants, SizeIs(3));
}

TEST(MeasuringLoop, ACrashCostsItsContestantAlone) {
  Job job;
  measure::MeasuringLoop(plan_of({counter("a"), counter("b", 4)}, 3, 1), job).run();
  ASSERT_THAT(job.rounds, SizeIs(6));
  std::vector<std::size_t> samples;
  int losses = 0;
  for (const measure::Round& round : job.rounds) {
    samples.push_back(round.samples.size());
    for (const measure::Sample& sample : round.samples) {
      if (!sample.loss) continue;
      ++losses;
      EXPECT_EQ(sample.contestant, 1u);
      EXPECT_EQ(sample.loss->failure.state, process::ItemState::crashed);
    }
  }
  EXPECT_THAT(samples, ElementsAre(2, 2, 2, 1, 1, 1));
  EXPECT_EQ(losses, 1);
}

TEST(MeasuringLoop, AWrongAnswerEndsAContestant) {
  Job job;
  job.wrong_pairs = 3;
  measure::MeasuringLoop(plan_of({counter("a"), counter("b")}, 3, 1), job).run();
  ASSERT_THAT(job.rounds, SizeIs(2));
  for (const measure::Sample& sample : job.rounds[1].samples)
    EXPECT_TRUE(sample.loss && sample.loss->wrong);
  EXPECT_EQ(job.rounds[1].stop, measure::Stop::crashed);
}

TEST(MeasuringLoop, AContestantThatFailsUntimedTakesNoPart) {
  Job job;
  measure::MeasuringLoop(plan_of({counter("a"), counter("b", 1)}, 1, 1), job).run();
  EXPECT_THAT(job.lost_at_start, ElementsAre(1));
  for (const measure::Round& round : job.rounds) EXPECT_THAT(round.samples, SizeIs(1));
}

TEST(MeasuringLoop, ASetGoesOnBehindWhatIsDone) {
  Job job;
  measure::SetProgress progress;
  progress.done = {{0, 0}, {0, 1}, {1, 0}};
  measure::MeasuringLoop(plan_of({counter("a"), counter("b")}, 2, 2), job, {progress}).run();
  ASSERT_THAT(job.rounds, SizeIs(1));
  EXPECT_EQ(job.rounds[0].square, 1);
  EXPECT_EQ(job.rounds[0].round, 1);
}

TEST(MeasuringLoop, SetsOfTheirOwnWorkersBeginAsLongAsThereIsTime) {
  measure::MeasurePlan plan = plan_of({counter("a"), counter("b")}, 3, 3);
  plan.sets.push_back(plan.sets.front());
  plan.sets[1].warm_up_windows = 1;
  plan.sets[1].most_rounds = 1;
  plan.shares_workers = false;
  Job job;
  job.without_time = {1};
  measure::MeasuringLoop(plan, job).run();
  std::vector<std::pair<std::size_t, int>> order;
  for (const measure::Round& round : job.rounds) {
    order.emplace_back(round.set, round.process);
    // Each process and set has new workers.
    EXPECT_EQ(round.samples[0].reply.pairs, 2 + round.round);
  }
  EXPECT_THAT(order, ElementsAre(std::pair(0u, 0), std::pair(0u, 0), std::pair(1u, 0),
                                 std::pair(0u, 2), std::pair(0u, 2), std::pair(1u, 2)));
  EXPECT_EQ(job.rounds[2].request.frame, 3u);  // it begins behind the untimed window
}

TEST(MeasuringLoop, EndsWhereTheJobSays) {
  Job job;
  job.most_calls = 4;  // two starts, and a round after which it continues
  measure::MeasuringLoop(plan_of({counter("a"), counter("b")}, 6, 1), job).run();
  EXPECT_THAT(job.rounds, SizeIs(2));
}

}  // namespace
}  // namespace touchstone
