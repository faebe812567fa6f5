#include "harness/check/axes/stress_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <map>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "tests/harness/check/planted.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Balls of radius 1, apart and overlapping in turn, on both sides of each other. From the value 2
// on the second is further to the right, where the planted algorithms do harm, in half of the
// slots.
RegimeCase draw_balls(RegimeDraw& draw) {
  const std::uint64_t slot = slot_of(draw.index);
  const double gap = slot % 2 == 0 ? 0.5 : -0.5;
  const double side = draw.regime.parameter >= 2 && slot / 2 % 2 == 0 ? 1 : -1;
  RegimeCase c{along_x(ball(1), ball(1), side * (2 + gap)), "ball"};
  c.pair.pose_b.translation.y() = draw.random.uniform(-0.25, 0.25);
  return c;
}

// Never ends, and is busy all the time.
class Busy final : public NarrowPhase {
 public:
  void bind(std::span<const Shape>) override {}
  void solve(Task, const PairBatch&, std::span<Outcome> outcomes) override {
    for (volatile int forever = 1; forever == 1;) {
    }
    outcomes[0] = {};
  }
};

NarrowPhaseEntry busy(const std::string& name, Origin origin) {
  NarrowPhaseEntry entry = planted<Harm::none>(name, origin);
  entry.make = [](const NarrowPhaseSettings&) -> std::unique_ptr<NarrowPhase> {
    return std::make_unique<Busy>();
  };
  return entry;
}

class StressRun : public ::testing::Test {
 protected:
  StressRequest request_for(const std::vector<const NarrowPhaseEntry*>& narrow) {
    StressRequest request;
    request.narrow = narrow;
    request.scalars = {Precision::float64};
    request.cells = cells_of(list);
    request.cases = 8;
    request.time_limit = 0.02;
    request.out = folder.path() / "out";
    return request;
  }
  std::string read(const std::string& name) const { return folder.read("out/" + name); }
  // Over all tasks and values.
  static std::int64_t count(const StressResult& result, StressOutcome outcome) {
    return result.reaches.at(0).counts[static_cast<std::size_t>(outcome)];
  }

  TemporaryFolder folder;
  Axis balls = {.name = "balls",
                .unit = "steps",
                .what = "balls",
                .values = {{"1", 1}, {"2", 2}, {"3", 3}},
                .draw = draw_balls};
  std::vector<const Axis*> list = {&balls};
};

TEST_F(StressRun, AnAlgorithmThatIsRight) {
  const NarrowPhaseEntry entry = planted<Harm::none>("good", Origin::ours);
  const StressRequest request = request_for({&entry});
  const StressResult result = run_stress(request);
  EXPECT_THAT(result.broken, IsEmpty());
  EXPECT_EQ(count(result, StressOutcome::right), 3 * 3 * 8);
  EXPECT_EQ(result.reaches.at(0).answers, 3 * 3 * 8);
  EXPECT_THAT(result.reaches.at(0).first, Each(std::nullopt));
  EXPECT_THAT(result.failures, IsEmpty());
  EXPECT_THAT(stress_text(request, result, 120),
              HasSubstr("none of our own algorithms is silently wrong, crashes or hangs"));
}

struct HarmCase {
  Harm harm;
  NarrowPhaseEntry (*entry)(const std::string&, Origin);
  StressOutcome outcome;
  std::int64_t counted;  // of the four harmed slots in two values: all tasks, or some
  std::int64_t skipped;

  friend void PrintTo(const HarmCase& harm, std::ostream* out) {
    *out << to_string(harm.outcome) << static_cast<int>(harm.harm);
  }
};

class StressHarm : public StressRun, public ::testing::WithParamInterface<HarmCase> {};

TEST_P(StressHarm, IsToldApart) {
  const HarmCase& harm = GetParam();
  for (const Origin origin : {Origin::ours, Origin::peer}) {
    const NarrowPhaseEntry entry = harm.entry("bad", origin);
    const StressRequest request = request_for({&entry});
    const StressResult result = run_stress(request);
    EXPECT_EQ(count(result, harm.outcome), harm.counted);
    EXPECT_EQ(result.reaches[0].skipped, harm.skipped);
    EXPECT_EQ(count(result, StressOutcome::right), 3 * 3 * 8 - harm.counted - harm.skipped);
    // The first value is mild.
    EXPECT_EQ(result.reaches[0].first_of(harm.outcome), 1u);
    const bool is_fault = harm.outcome != StressOutcome::honest;
    EXPECT_EQ(!result.broken.empty(), is_fault && origin == Origin::ours);
    EXPECT_EQ(!result.failures.empty(), is_fault);
    for (const FailureCase& failure : result.failures) {
      EXPECT_THAT(read_cases(failure.file), Not(IsEmpty()));
      EXPECT_THAT(failure.id, HasSubstr("/sphere-sphere/ball/"));
    }
    const EnvelopeTable which = is_fault ? EnvelopeTable::wrong : EnvelopeTable::honest;
    const std::string word = harm.outcome == StressOutcome::crashed ? " crashes" : "";
    EXPECT_THAT(
        table(request, result.reaches, which),
        ElementsAre(ElementsAre("algorithm", "balls"), ElementsAre("bad double", "2" + word)));
    const bool other_side = harm.harm == Harm::wrong_side || !word.empty();
    EXPECT_THAT(table(request, result.reaches, EnvelopeTable::side).at(1),
                ElementsAre("bad double", other_side ? "2" + word : "-"));
    EXPECT_THAT(stress_page(request, result, "touchstone stress", "figures"),
                HasSubstr("| bad double | 2" + word + " |"));
    EXPECT_THAT(read("envelope.csv"), HasSubstr(to_string(harm.outcome)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Harms, StressHarm,
    ::testing::Values(
        HarmCase{Harm::wrong_side, planted<Harm::wrong_side>, StressOutcome::silent, 24, 0},
        HarmCase{Harm::wrong_depth, planted<Harm::wrong_depth>, StressOutcome::silent, 8, 0},
        HarmCase{Harm::bad_bounds, planted<Harm::bad_bounds>, StressOutcome::silent, 24, 0},
        HarmCase{Harm::nan, planted<Harm::nan>, StressOutcome::silent, 8, 0},
        HarmCase{Harm::gives_up, planted<Harm::gives_up>, StressOutcome::honest, 24, 0},
        // After three in a task and value the rest is skipped: of slots 0, 1, 4 those from 5 on.
        HarmCase{Harm::crashes, planted<Harm::crashes>, StressOutcome::crashed, 18, 18}));

TEST_F(StressRun, AHangThatIsBusyOrAsleepEndsAtItsLimit) {
  for (const NarrowPhaseEntry& entry :
       {busy("busy", Origin::ours), planted<Harm::hangs>("asleep", Origin::ours)}) {
    StressRequest request = request_for({&entry});
    request.cells = {cells_of(list)[1]};
    request.cases = 1;
    const StressResult result = run_stress(request);
    EXPECT_EQ(count(result, StressOutcome::hung), 3) << entry.info.name;
    EXPECT_THAT(result.broken, Contains(HasSubstr("1 of 1 hung at balls 2")));
  }
}

TEST_F(StressRun, ApproximateAndBoundsAreJudgedAsTheyState) {
  NarrowPhaseEntry approximate = planted<Harm::wrong_side>("bad", Origin::ours);
  approximate.traits.approximate = true;
  const StressRequest request = request_for({&approximate});
  // Those that are apart and called overlapping are excused; the others are not.
  EXPECT_EQ(count(run_stress(request), StressOutcome::silent), 12);
  NarrowPhaseEntry bound = planted<Harm::wrong_depth>("bad", Origin::ours);
  bound.traits.depth_is_bound = true;
  const StressRequest with_bound = request_for({&bound});
  EXPECT_EQ(count(run_stress(with_bound), StressOutcome::silent), 4);  // the distances
}

// --- what is interrupted is gone on with --------------------------------------------------------

class StressResume : public StressRun {
 protected:
  StressResume() {
    balls.values.clear();
    for (int i = 1; i <= 8; ++i) balls.values.push_back({std::to_string(i), 1.0 * i});
    request = request_for({&slow, &bad});
  }

  // Kills a sweep when it has done so many cells.
  void kill_after(std::size_t cells) {
    const pid_t child = fork();
    if (child == 0) {
      std::freopen("/dev/null", "w", stderr);
      run_stress(request);
      _exit(0);
    }
    const std::string wanted = "\ncells,";
    const Stopwatch watch;
    while (watch.seconds() < 60) {
      const std::string progress = read("progress.csv");
      const auto at = progress.find(wanted);
      if (at != std::string::npos && std::stoul(progress.substr(at + wanted.size())) >= cells)
        break;
      usleep(1000);
    }
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it was done before it could be killed";
  }

  NarrowPhaseEntry slow = planted<Harm::none, 300>("slow", Origin::ours);
  NarrowPhaseEntry bad = planted<Harm::wrong_side>("bad", Origin::peer);
  StressRequest request;
};

TEST_F(StressResume, NoRowIsLostOrDoubled) {
  kill_after(2);
  // A cell that was being written when the process was killed.
  std::ofstream(request.out / "stress.csv", std::ios::app) << "balls,7,bad,dou";
  std::ofstream(request.out / "cells.csv", std::ios::app) << "balls,7,8,0,0\n";
  request.resume = true;
  const StressResult resumed = run_stress(request);
  std::map<std::string, std::string> found;
  for (const char* name : {"stress.csv", "cells.csv", "envelope.csv"}) found[name] = read(name);
  const std::string cases = read("failures/bad-double-intersect.jsonl");
  EXPECT_THAT(cases, Not(IsEmpty()));
  request.resume = false;
  run_stress(request);
  for (const auto& [name, text] : found) EXPECT_EQ(text, read(name)) << name;
  EXPECT_EQ(cases, read("failures/bad-double-intersect.jsonl"));
  EXPECT_EQ(resumed.cells.size(), 8u);

  // What is done is not done again, and tells the same.
  request.resume = true;
  run_stress(request);
  for (const auto& [name, text] : found) EXPECT_EQ(text, read(name)) << name;
}

TEST_F(StressResume, AnotherRequestIsRefused) {
  request.narrow = {&bad};
  run_stress(request);
  const std::string before = read("stress.csv");
  request.resume = true;
  const auto refuse = [&](const std::function<void(StressRequest&)>& change,
                          const std::string& text) {
    StressRequest other = request;
    change(other);
    EXPECT_THAT(input_fault([&] { run_stress(other); }),
                testing::AllOf(HasSubstr("progress.csv: "), HasSubstr(text)));
  };
  refuse([](StressRequest& r) { r.seed = 2; }, "had seed '1', and this one has '2'");
  refuse([](StressRequest& r) { r.cases = 9; }, "cases '8'");
  refuse([&](StressRequest& r) { r.narrow = {&slow}; }, "narrow 'bad'");
  refuse([](StressRequest& r) { r.scalars = {Precision::float32}; }, "scalars 'double'");
  refuse([](StressRequest& r) { r.time_limit = 3; }, "time_limit");
  refuse([](StressRequest& r) { r.cells.erase(r.cells.begin()); }, "axes 'balls'");
  refuse([](StressRequest& r) { r.out /= "none"; }, "no such file");
  EXPECT_EQ(read("stress.csv"), before);
  std::filesystem::resize_file(request.out / "stress.csv", 10);
  EXPECT_THAT(input_fault([&] { run_stress(request); }),
              HasSubstr("stress.csv: 10 bytes; expected"));
}

}  // namespace
}  // namespace touchstone
