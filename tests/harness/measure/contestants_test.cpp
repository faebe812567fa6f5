// What contestants do wrong costs only themselves, and what they do slowly is found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <ctime>
#include <map>
#include <stdexcept>
#include <string>

#include "harness/measure/set_times.h"
#include "harness/run/report.h"
#include "harness/run/runner.h"
#include "tests/harness/measure/fakes.h"

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
  RunResult result;
  std::vector<RawRow> lost;            // rows of the bad one without a good status
  std::map<std::string, int> samples;  // rows of find_pairs

  Harm(int when, const FakeBroadPhase::Hook& harm, std::string_view status) {
    const auto good = [](int, PairSink&) {};
    fakes.fakes = {fake("good", good),
                   fake("bad",
                        [=](int call, PairSink& sink) {
                          if (call == when) harm(call, sink);
                        }),
                   fake("fine", good)};
    result = run_campaign(fakes.campaign(6), fakes.out());
    for (const RawRow& row : result.findings.rows()) {
      if (row.status != "ok" && row.broad == "bad") lost.push_back(row);
      if (row.kind == RowKind::sample && row.phase == Phase::find_pairs && row.seconds > 0) {
        ++samples[row.broad + (row.twin == 1 ? " twin" : "")];
      }
      if (row.broad != "bad") {
        EXPECT_EQ(row.status, "ok") << row.broad;
      }
    }
    EXPECT_EQ(lost.size(), 1u);
    if (!lost.empty()) {
      EXPECT_EQ(lost[0].status, status);
    }
    EXPECT_EQ(result.findings.departures().size(), 1u) << departures(result.findings);
    const int rounds = 6 * (when > FakeCampaign::frames ? 4 : 3);
    EXPECT_EQ(samples["good"], rounds);
    EXPECT_EQ(samples["good twin"], rounds);
    EXPECT_EQ(samples["fine"], rounds);
    EXPECT_LT(samples["bad"], rounds);
  }
};

// In the check pass, in a worker's first pass, and in its samples: each instance starts to count
// anew, and the first pass goes over the same frames as the check.
constexpr int in_check = 2;
constexpr int in_samples = FakeCampaign::frames + 2;

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
        when, [](int, PairSink&) { pause(); }, "timed_out");
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
  fakes.fakes[0].info.origin = Origin::ours;  // the baseline, which has a twin
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
  Campaign campaign = fakes.campaign(6);
  campaign.groups[0].threads = {2};
  const RunResult result = run_campaign(campaign, fakes.out());
  EXPECT_TRUE(result.findings.ours_are_wrong());
  int wrong = 0;
  for (const RawRow& row : result.findings.rows()) {
    if (row.broad != "wide") continue;
    wrong += row.status == status_wrong;
    EXPECT_EQ(row.kind, RowKind::check);
  }
  EXPECT_EQ(wrong, 1);
}

// log(second / first) as the tables have it.
stats::MedianInterval ratio(const std::vector<FakeBroadPhase::Hook>& work, int squares) {
  FakeCampaign fakes;
  fakes.fakes = {fake("first", work[0]), fake("second", work[1])};
  const RunResult result = run_campaign(fakes.campaign(squares), fakes.out());
  SetTimes times;
  for (const RawRow& row : result.findings.rows()) times.add(row);
  EXPECT_EQ(times.baseline(), "first");
  return stats::median_interval(times.log_ratios("second", "first", true), confidence);
}

TEST(Contestants, OneThatSleepsTwiceAsLongIsSlower) {
  const auto ratio_of_sleeps = ratio(
      {[](int, PairSink&) { wait_a_little(1000); }, [](int, PairSink&) { wait_a_little(2000); }},
      12);
  EXPECT_GT(ratio_of_sleeps.low, 0);
}

void spin(int turns) {
  volatile int sum = 0;
  for (int i = 0; i < turns; ++i) sum = sum + i;
}

TEST(Contestants, OneWithAFewPercentMoreToDoIsSlower) {
  const auto spins =
      ratio({[](int, PairSink&) { spin(100'000); }, [](int, PairSink&) { spin(105'000); }}, 48);
  EXPECT_EQ(spins.n, 48u);
  EXPECT_GT(spins.low, 0);
}

TEST(Contestants, TheSameTwiceIsNotToldApart) {
  const auto same = [](int, PairSink&) { spin(100'000); };
  const auto twins = ratio({same, same}, 24);
  EXPECT_LT(twins.low, 0.02);
  EXPECT_GT(twins.high, -0.02);
}

}  // namespace
}  // namespace touchstone
