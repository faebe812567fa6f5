// Tests whole sweeps with planted algorithms on one axis.
#include "harness/check/axes/stress_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <map>

#include "harness/base/error.h"
#include "tests/harness/check/planted.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Never ends, and uses the processor all the time.
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
  check::StressRequest request_for(const std::vector<const NarrowPhaseEntry*>& narrow) {
    check::StressRequest request;
    request.narrow = narrow;
    request.scalars = {Precision::float64};
    request.cells = check::cells_of(list);
    request.cases = 8;
    request.time_limit = 0.02;
    request.out = folder.path() / "out";
    return request;
  }
  std::string read(const std::string& name) const { return folder.read("out/" + name); }
  // Sums over all tasks and values.
  static std::int64_t count(const check::StressResult& result, grade::AnswerClass outcome) {
    return result.reaches.at(0).counts[static_cast<std::size_t>(outcome)];
  }

  TemporaryFolder folder;
  check::StressAxis balls = balls_axis(3);
  std::vector<const check::StressAxis*> list = {&balls};
};

TEST_F(StressRun, AnAlgorithmThatIsRight) {
  const NarrowPhaseEntry entry = planted<Harm::none>("good", Origin::ours);
  const check::StressRequest request = request_for({&entry});
  const check::StressResult result = check::run_stress(request);
  EXPECT_THAT(result.broken, IsEmpty());
  EXPECT_EQ(count(result, grade::AnswerClass::right), 3 * 3 * 8);
  EXPECT_EQ(result.reaches.at(0).answers, 3 * 3 * 8);
  EXPECT_THAT(result.reaches.at(0).first, Each(std::nullopt));
  EXPECT_THAT(result.failures, IsEmpty());
  EXPECT_THAT(check::stress_text(request, result, 120),
              HasSubstr("none of our own algorithms is silently wrong, crashes or hangs"));
}

struct StressHarmCase {
  Harm harm;
  NarrowPhaseEntry (*entry)(const std::string&, Origin);
  grade::AnswerClass outcome;
  std::int64_t counted;  // queries of the four harmed slots in two values, over all tasks or some
  std::int64_t skipped;

  friend void PrintTo(const StressHarmCase& harm, std::ostream* out) {
    *out << to_string(harm.outcome) << static_cast<int>(harm.harm);
  }
};

class StressHarm : public StressRun, public ::testing::WithParamInterface<StressHarmCase> {};

TEST_P(StressHarm, IsToldApart) {
  const StressHarmCase& harm = GetParam();
  for (const Origin origin : {Origin::ours, Origin::peer}) {
    const NarrowPhaseEntry entry = harm.entry("bad", origin);
    const check::StressRequest request = request_for({&entry});
    const check::StressResult result = check::run_stress(request);
    EXPECT_EQ(count(result, harm.outcome), harm.counted);
    EXPECT_EQ(result.reaches[0].skipped, harm.skipped);
    EXPECT_EQ(count(result, grade::AnswerClass::right), 3 * 3 * 8 - harm.counted - harm.skipped);
    // The first value is mild.
    EXPECT_EQ(result.reaches[0].first_of(harm.outcome), 1u);
    const bool is_fault = harm.outcome != grade::AnswerClass::honest;
    EXPECT_EQ(!result.broken.empty(), is_fault && origin == Origin::ours);
    EXPECT_EQ(!result.failures.empty(), is_fault);
    for (const check::FailureCase& failure : result.failures) {
      EXPECT_THAT(files::read_cases(failure.file), Not(IsEmpty()));
      EXPECT_THAT(failure.id, HasSubstr("/sphere-sphere/ball/"));
    }
    const check::EnvelopeTable which =
        is_fault ? check::EnvelopeTable::wrong : check::EnvelopeTable::honest;
    const std::string word = harm.outcome == grade::AnswerClass::crashed ? " crashes" : "";
    EXPECT_THAT(
        check::table(request, result.reaches, which).rows(),
        ElementsAre(ElementsAre("algorithm", "balls"), ElementsAre("bad double", "2" + word)));
    const bool other_side = harm.harm == Harm::wrong_side || !word.empty();
    EXPECT_THAT(check::table(request, result.reaches, check::EnvelopeTable::side).rows().at(1),
                ElementsAre("bad double", other_side ? "2" + word : "-"));
    EXPECT_THAT(check::stress_page(request, result, "touchstone check --axes", "figures"),
                HasSubstr("| bad double | 2" + word + " |"));
    EXPECT_THAT(read("envelope.csv"), HasSubstr(to_string(harm.outcome)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Harms, StressHarm,
    ::testing::Values(
        StressHarmCase{Harm::wrong_side, planted<Harm::wrong_side>, grade::AnswerClass::silent, 24,
                       0},
        StressHarmCase{Harm::wrong_depth, planted<Harm::wrong_depth>, grade::AnswerClass::silent, 8,
                       0},
        StressHarmCase{Harm::bad_bounds, planted<Harm::bad_bounds>, grade::AnswerClass::silent, 24,
                       0},
        StressHarmCase{Harm::nan, planted<Harm::nan>, grade::AnswerClass::silent, 8, 0},
        StressHarmCase{Harm::gives_up, planted<Harm::gives_up>, grade::AnswerClass::honest, 24, 0},
        // After three crashes in a task and value the rest is skipped: slots 0, 1 and 4 crash,
        // those from 5 on are not asked.
        StressHarmCase{Harm::crashes, planted<Harm::crashes>, grade::AnswerClass::crashed, 18,
                       18}));

TEST_F(StressRun, AHangThatIsBusyOrAsleepEndsAtItsLimit) {
  for (const NarrowPhaseEntry& entry :
       {busy("busy", Origin::ours), planted<Harm::hangs>("asleep", Origin::ours)}) {
    check::StressRequest request = request_for({&entry});
    request.cells = {check::cells_of(list)[1]};
    request.cases = 1;
    const check::StressResult result = check::run_stress(request);
    EXPECT_EQ(count(result, grade::AnswerClass::hung), 3) << entry.info.name;
    EXPECT_THAT(result.broken, Contains(HasSubstr("1 of 1 hung at balls 2")));
  }
}

TEST_F(StressRun, ApproximateAndBoundsAreJudgedAsTheyState) {
  NarrowPhaseEntry approximate = planted<Harm::wrong_side>("bad", Origin::ours);
  approximate.traits.approximate = true;
  const check::StressRequest request = request_for({&approximate});
  // A pair that is apart and called overlapping is excused; the reverse is not.
  EXPECT_EQ(count(check::run_stress(request), grade::AnswerClass::silent), 12);
  NarrowPhaseEntry bound = planted<Harm::wrong_depth>("bad", Origin::ours);
  bound.traits.depth_is_bound = true;
  const check::StressRequest with_bound = request_for({&bound});
  EXPECT_EQ(count(check::run_stress(with_bound), grade::AnswerClass::silent), 4);  // the distances
}

}  // namespace
}  // namespace touchstone
