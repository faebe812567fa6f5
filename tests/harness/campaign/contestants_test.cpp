// Tests that the errors of contestants cost only themselves, and that slowness is found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <map>
#include <stdexcept>
#include <string>

#include "harness/campaign/runner.h"
#include "harness/campaign/schedule.h"
#include "harness/campaign/set_times.h"
#include "harness/stats/samples.h"
#include "harness/stats/summary.h"
#include "tests/harness/campaign/fakes.h"
#include "tests/harness/campaign/stopped_run.h"

namespace touchstone {
namespace {

constexpr double confidence = 0.95;

void wait_a_little(long microseconds) {
  const timespec time{0, microseconds * 1000};
  nanosleep(&time, nullptr);
}

// Runs two good contestants and one that does harm in its n-th find_pairs.
struct Harm {
  FakeCampaign fakes;
  campaign::RunResult result;
  std::vector<record::RawRow> lost;    // rows of the bad one without a good status
  std::map<std::string, int> samples;  // the number of rows of find_pairs

  Harm(int when, const FakeBroadPhase::Hook& harm, std::string_view status,
       double time_limit = 60) {
    fakes.time_limit = time_limit;
    const auto good = [](int, PairSink&) {};
    fakes.fakes = {fake("good", good),
                   fake("bad",
                        [=](int call, PairSink& sink) {
                          if (call == when) harm(call, sink);
                        }),
                   fake("fine", good)};
    result = campaign::run_campaign(fakes.campaign(6), fakes.out());
    for (const record::RawRow& row : result.findings.rows()) {
      if (row.status != record::RowStatus::ok && row.broad == "bad") lost.push_back(row);
      if (row.kind == record::RowKind::sample && row.phase == record::Phase::find_pairs &&
          row.seconds > 0) {
        ++samples[row.broad + (row.is_twin() ? " twin" : "")];
      }
      if (row.broad != "bad") {
        EXPECT_EQ(row.status, record::RowStatus::ok) << row.broad;
      }
    }
    EXPECT_EQ(lost.size(), 1u);
    if (!lost.empty()) {
      EXPECT_EQ(to_string(*lost[0].status), status);
    }
    EXPECT_EQ(result.findings.departures().size(), 1u) << record::departures_text(result.findings);
    const int rounds = 6 * (when > FakeCampaign::frames ? 4 : 3);
    EXPECT_EQ(samples["good"], rounds);
    EXPECT_EQ(samples["good twin"], rounds);
    EXPECT_EQ(samples["fine"], rounds);
    EXPECT_LT(samples["bad"], rounds);
  }
};

// These are calls in the check pass, in a worker's first pass, and in its samples: each instance
// counts from 1, and the first pass plays the frames of the check.
constexpr int in_check = 2;
// The pass that counts allocations plays the frames twice.
constexpr int in_samples = 2 * FakeCampaign::frames + 2;

TEST(Contestants, ACrashCostsItsOwnRowsOnly) {
  const auto crash = [](int, PairSink&) {
    std::fputs("it was\nthe butler", stderr);
    std::raise(SIGSEGV);
  };
  for (const int when : {in_check, in_samples}) {
    const Harm harm(when, crash, "crashed");
    ASSERT_FALSE(harm.lost.empty());
    EXPECT_EQ(harm.lost[0].words, "it was the butler");
  }
}

TEST(Contestants, AHangIsOver) {
  for (const int when : {in_check, in_samples}) {
    const Harm harm(
        when, [](int, PairSink&) { pause(); }, "timed_out", 2);
  }
}

TEST(Contestants, WhatIsThrownIsCaught) {
  for (const int when : {in_check, in_samples}) {
    const Harm harm(
        when, [](int, PairSink&) { throw std::runtime_error("not me"); }, "crashed");
    ASSERT_FALSE(harm.lost.empty());
    EXPECT_EQ(harm.lost[0].words, "not me");
  }
}

TEST(Contestants, WhoLeavesIsMissed) {
  for (const int when : {in_check, in_samples}) {
    const Harm harm(
        when, [](int, PairSink&) { _exit(0); }, "crashed");
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Contestants, ALeakEndsAtTheMemoryLimit) {
  const auto leak = [](int, PairSink&) {
    for (;;) {
      volatile char* const lost = new char[1 << 20];
      lost[0] = 1;
    }
  };
  for (const int when : {in_check, in_samples}) {
    const Harm harm(when, leak, "crashed");
  }
}
#endif

TEST(Contestants, AWrongAnswerIsNotTimed) {
  const auto add = [](int, PairSink& sink) { sink.chunk(0).push(0, 0); };
  for (const int when : {in_check, in_samples}) {
    const Harm harm(when, add, "wrong");
  }
}

TEST(Contestants, AnotherAnswerInAWorkerThanInTheCheckIsWrong) {
  FakeCampaign fakes;
  fakes.fakes = {fake("good", [](int, PairSink&) {})};
  fakes.fakes[0].info.origin = Origin::ours;  // it is the baseline, which has a twin
  BroadPhaseEntry wide;
  wide.info.name = "wide";
  wide.info.origin = Origin::ours;
  wide.make = [](Executor& executor) -> std::unique_ptr<BroadPhase> {
    const bool wrong = executor.width() > 1;
    return std::make_unique<FakeBroadPhase>(executor, [wrong](int, PairSink& sink) {
      if (wrong) sink.chunk(0).push(0, 0);
    });
  };
  fakes.fakes.push_back(wide);
  campaign::Campaign campaign = fakes.campaign(6);
  campaign.groups[0].threads = {2};
  const campaign::RunResult result = campaign::run_campaign(campaign, fakes.out());
  EXPECT_TRUE(result.findings.ours_are_wrong());
  int wrong = 0;
  for (const record::RawRow& row : result.findings.rows()) {
    if (row.broad != "wide") continue;
    wrong += row.status == record::RowStatus::wrong;
    EXPECT_EQ(row.kind, record::RowKind::check);
  }
  EXPECT_EQ(wrong, 1);
}

TEST(Contestants, WhatARoundToldGoesWithItWhenItIsMeasuredAgain) {
  // It crashes once, in whichever process comes first.
  const auto crashes = std::make_shared<process::SharedArray<std::atomic<int>>>(1);
  FakeCampaign fakes;
  fakes.fakes = {fake("good", [](int, PairSink&) {}), fake("bad", [=](int call, PairSink&) {
                   if (call == in_samples && (*crashes)[0]++ == 0) std::raise(SIGSEGV);
                 })};
  const campaign::RunResult first = campaign::run_campaign(fakes.campaign(6), fakes.out());
  ASSERT_EQ(first.findings.departures().size(), 1u);
  const auto row = static_cast<std::size_t>(first.findings.departures()[0].row);
  ASSERT_LT(row, first.findings.rows().size());
  EXPECT_EQ(first.findings.rows()[row].status, record::RowStatus::crashed);
  EXPECT_EQ(record::read_rows<record::Departure>(fakes.out() / "departures.csv").size(), 1u);

  // The file is cut as if the run had been stopped in that round.
  const std::string raw = fakes.folder.read("out/raw.csv");
  // That round was the first after the check.
  const std::size_t crash = raw.find(",crashed,");
  stop_run(fakes.out(), raw.find('\n', raw.rfind(",check,", crash)) + 1, raw.find('\n', crash) + 1);
  const campaign::RunResult again =
      campaign::run_campaign(fakes.campaign(6), fakes.out(), record::FolderStart::resume);
  for (const record::RawRow& one : again.findings.rows())
    EXPECT_EQ(one.status, record::RowStatus::ok);
  EXPECT_TRUE(again.findings.departures().empty()) << record::departures_text(again.findings);
  EXPECT_TRUE(record::read_rows<record::Departure>(fakes.out() / "departures.csv").empty());
}

TEST(Contestants, WhereAWholeGroupIsGoneTheOthersStopAllTheSame) {
  // The set has two groups; the second, with the baseline, is lost from its first sample on.
  const auto crash = [](int call, PairSink&) {
    if (call >= in_samples) std::raise(SIGSEGV);
  };
  const auto good = [](int, PairSink&) {};
  FakeCampaign fakes;
  fakes.fakes = {fake("baseline", crash), fake("a", good), fake("b", good), fake("c", crash),
                 fake("d", crash)};
  const campaign::RunResult result = campaign::run_campaign(fakes.campaign(6), fakes.out());
  int stops = 0;
  for (const record::RawRow& row : result.findings.rows()) stops += row.stop == "rounds";
  EXPECT_EQ(stops, 1);
}

campaign::SetTimes times_of(const campaign::RunResult& result) {
  campaign::SetTimes times;
  for (const record::RawRow& row : result.findings.rows()) times.add(row);
  return times;
}

TEST(Contestants, OneThatSleepsLongerIsSlower) {
  FakeCampaign fakes;
  fakes.fakes = {fake("first", [](int, PairSink&) { wait_a_little(1000); }),
                 fake("second", [](int, PairSink&) { wait_a_little(4000); })};
  const campaign::SetTimes times =
      times_of(campaign::run_campaign(fakes.campaign(12), fakes.out()));
  EXPECT_EQ(times.baseline(), "first");
  const auto ratio = stats::median_interval(times.log_ratios("second", "first", true), confidence);
  EXPECT_EQ(ratio.n, 12u);
  EXPECT_GT(ratio.low, 0);
  for (const double seconds : times.times("second", true)) EXPECT_GE(seconds, 4000e-6);
}

// The times below are exact: they are those of fakes on a clock of their own.
double jittered(double seconds, base::Random& random) {
  return seconds * std::exp(random.uniform(-0.2, 0.2));
}

class ExactTimes : public testing::Test {
 protected:
  // Makes three contestants whose times are spread by a tenth: one, its equal, and one with 5 %
  // more work.
  void fill() {
    const auto like = [](int, base::Random& random) { return jittered(100e-6, random); };
    fakes_.fakes = {timed_fake("first", 1, like), timed_fake("like", 2, like),
                    timed_fake("slower", 3,
                               [](int, base::Random& random) { return jittered(105e-6, random); })};
  }
  QuietMachine quiet_;
  FakeCampaign fakes_;
};

TEST_F(ExactTimes, TheClockTellsWhatTheWorkTook) {
  fakes_.fakes = {timed_fake("first", 1, [](int, base::Random&) { return 100e-6; }),
                  timed_fake("second", 2, [](int, base::Random&) { return 150e-6; })};
  const campaign::SetTimes times =
      times_of(campaign::run_campaign(fakes_.campaign(6), fakes_.out()));
  for (const double seconds : times.times("first", false)) EXPECT_NEAR(seconds, 100e-6, 1e-12);
  for (const double seconds : times.times("second", false)) EXPECT_NEAR(seconds, 150e-6, 1e-12);
  for (const double ratio : times.log_ratios("second", "first", false)) {
    EXPECT_NEAR(ratio, std::log(1.5), 1e-9);
  }
}

TEST_F(ExactTimes, AFewPercentMoreToDoAreFoundAndTwinsAreNotToldApart) {
  fill();
  const campaign::SetTimes times =
      times_of(campaign::run_campaign(fakes_.campaign(48), fakes_.out()));
  const auto ratio = [&](const std::string& label) {
    return stats::median_interval(times.log_ratios(label, "first", false), confidence);
  };
  const auto slower = ratio("slower");
  EXPECT_EQ(slower.n, 48u);
  EXPECT_GT(slower.low, 0);
  EXPECT_LT(slower.low, std::log(1.05));
  EXPECT_GT(slower.high, std::log(1.05));
  for (const auto& same : {ratio("like"), ratio(campaign::SetTimes::twin_of("first"))}) {
    EXPECT_EQ(same.n, 48u);
    EXPECT_LT(same.low, 0);
    EXPECT_GT(same.high, 0);
  }
}

// Returns the last row of the only set.
record::RawRow last_row(const campaign::RunResult& result) { return result.findings.rows().back(); }

TEST_F(ExactTimes, RepetitionEndsWhereTheIntervalIsNarrow) {
  fill();
  campaign::Campaign campaign = fakes_.campaign({});
  campaign.groups[0].seconds = 1e9;
  campaign.groups[0].width = 0.5;
  const campaign::RunResult wide = campaign::run_campaign(campaign, fakes_.folder.path() / "wide");
  EXPECT_EQ(last_row(wide).stop, "width");
  EXPECT_EQ(last_row(wide).square, measure::first_look - 1);
}

TEST_F(ExactTimes, RepetitionEndsWithTheLastLook) {
  fill();
  campaign::Campaign campaign = fakes_.campaign({});
  campaign.groups[0].seconds = 1e9;
  campaign.groups[0].width = 1e-4;
  const campaign::RunResult result = campaign::run_campaign(campaign, fakes_.out());
  EXPECT_EQ(last_row(result).stop, "rounds");
  EXPECT_EQ(last_row(result).square, 47);
}

TEST_F(ExactTimes, RepetitionEndsWithTheBudget) {
  fill();
  campaign::Campaign campaign = fakes_.campaign({});
  campaign.groups[0].seconds = 1e-9;  // four times as much are spent before there is an interval
  const campaign::RunResult result = campaign::run_campaign(campaign, fakes_.out());
  EXPECT_EQ(last_row(result).stop, "budget");
  EXPECT_EQ(last_row(result).square, 0);
}

TEST_F(ExactTimes, ATwinThatTakesLongerMakesTheSetSuspect) {
  // The instances after the check's are the baseline and its twin in turn.
  fakes_.fakes = {
      timed_fake("first", 1,
                 [](int instance, base::Random& random) {
                   const bool twin = instance > 0 && instance % 2 == 0;
                   return jittered(twin ? 130e-6 : 100e-6, random);
                 }),
      timed_fake("second", 2, [](int, base::Random& random) { return jittered(100e-6, random); })};
  const campaign::RunResult result = campaign::run_campaign(fakes_.campaign(12), fakes_.out());
  EXPECT_EQ(last_row(result).noise, "canary");
  int flagged = 0;
  for (const record::RawRow& row : result.findings.rows()) flagged += !row.noise.empty();
  EXPECT_EQ(flagged, 1);
  const stats::Results read = stats::read_results(fakes_.out());
  EXPECT_THAT(
      stats::summary(read, stats::make_tables(read, stats::Noise::left_out), {}, ""),
      testing::HasSubstr(
          "NOT TRUSTED of 1, counted as unclear: 1 (an algorithm differed from its own copy)"));
  ASSERT_EQ(read.sets.size(), 1u);
  EXPECT_TRUE(read.sets[0].suspect);
}

TEST_F(ExactTimes, ATwinThatIsOneMakesNoneSuspect) {
  fill();
  const campaign::RunResult result = campaign::run_campaign(fakes_.campaign(12), fakes_.out());
  for (const record::RawRow& row : result.findings.rows()) EXPECT_EQ(row.noise, "");
  EXPECT_FALSE(stats::read_results(fakes_.out()).sets.at(0).suspect);
}

TEST_F(ExactTimes, ARoundThatWasDisturbedDoesNotCount) {
  // Every round is flagged: then there is no interval that could end the set or make it suspect.
  measure::noise_judge() = [](const measure::NoiseReading&, const measure::NoiseReading&, double,
                              double) { return std::string("steal"); };
  fill();
  campaign::Campaign campaign = fakes_.campaign({});
  campaign.groups[0].seconds = 1e9;
  campaign.groups[0].width = 10;
  const campaign::RunResult result = campaign::run_campaign(campaign, fakes_.out());
  EXPECT_EQ(last_row(result).stop, "rounds");
  for (const record::RawRow& row : result.findings.rows()) {
    EXPECT_EQ(row.noise, row.kind == record::RowKind::sample ? "steal" : "");
  }
  const campaign::SetTimes times = times_of(result);
  EXPECT_TRUE(times.log_ratios("slower", "first", false).empty());
  EXPECT_EQ(times.log_ratios("slower", "first", true).size(), 48u);
}

}  // namespace
}  // namespace touchstone
