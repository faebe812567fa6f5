// Tests whole checks with --axes with planted algorithms on one axis.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <map>

#include "harness/base/error.h"
#include "harness/check/check_run.h"
#include "harness/kinds/pair/envelope.h"
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

class AxesRun : public ::testing::Test {
 protected:
  check::CheckRequest request_for(const std::vector<const NarrowPhaseEntry*>& narrow) {
    check::CheckRequest request(check::CheckMode::axes);
    request.scalars = {Precision::float64};
    ask(request, narrow);
    for (const kinds::Regime& value : values) draw(request, value);
    request.cases = 8;
    request.time_limit = 0.02;
    request.out = folder.path() / "out";
    return request;
  }
  std::string read(const std::string& name) const { return folder.read("out/" + name); }
  static std::vector<kinds::Reach> reaches_of(const check::CheckReport& result) {
    return result.of<kinds::AxisChecker>().reaches();
  }
  // Sums over all tasks and values.
  static std::int64_t count(const check::CheckReport& result, grade::AnswerClass outcome) {
    return reaches_of(result).at(0).counts[static_cast<std::size_t>(outcome)];
  }

  TemporaryFolder folder;
  kinds::Axis balls = balls_axis(3);
  std::vector<kinds::Regime> values = kinds::regimes_of(balls);
};

TEST_F(AxesRun, AnAlgorithmThatIsRight) {
  const NarrowPhaseEntry entry = planted<Harm::none>("good", Origin::ours);
  const check::CheckRequest request = request_for({&entry});
  const check::CheckReport result = check::run_check(request);
  EXPECT_THAT(result.ours_wrong(), IsEmpty());
  EXPECT_EQ(count(result, grade::AnswerClass::right), 3 * 3 * 8);
  EXPECT_EQ(reaches_of(result).at(0).answers, 3 * 3 * 8);
  EXPECT_THAT(reaches_of(result).at(0).first, Each(std::nullopt));
  EXPECT_THAT(result.of<kinds::AxisChecker>().failures(), IsEmpty());
  EXPECT_THAT(check::summary_text(result, 120),
              HasSubstr("none of our own algorithms is silently wrong, crashes or hangs"));
}

struct AxisHarmCase {
  Harm harm;
  NarrowPhaseEntry (*entry)(const std::string&, Origin);
  grade::AnswerClass outcome;
  std::int64_t counted;  // queries of the four harmed slots in two values, over all tasks or some
  std::int64_t skipped;

  friend void PrintTo(const AxisHarmCase& harm, std::ostream* out) {
    *out << to_string(harm.outcome) << static_cast<int>(harm.harm);
  }
};

class AxisHarm : public AxesRun, public ::testing::WithParamInterface<AxisHarmCase> {};

TEST_P(AxisHarm, IsToldApart) {
  const AxisHarmCase& harm = GetParam();
  for (const Origin origin : {Origin::ours, Origin::peer}) {
    const NarrowPhaseEntry entry = harm.entry("bad", origin);
    const check::CheckRequest request = request_for({&entry});
    const check::CheckReport result = check::run_check(request);
    EXPECT_EQ(count(result, harm.outcome), harm.counted);
    EXPECT_EQ(reaches_of(result)[0].skipped, harm.skipped);
    EXPECT_EQ(count(result, grade::AnswerClass::right), 3 * 3 * 8 - harm.counted - harm.skipped);
    // The first value is mild.
    EXPECT_EQ(reaches_of(result)[0].first_of(harm.outcome), 1u);
    const bool is_fault = harm.outcome != grade::AnswerClass::honest;
    EXPECT_EQ(!result.ours_wrong().empty(), is_fault && origin == Origin::ours);
    EXPECT_EQ(!result.of<kinds::AxisChecker>().failures().empty(), is_fault);
    for (const kinds::FailureCase& failure : result.of<kinds::AxisChecker>().failures()) {
      EXPECT_THAT(files::read_cases(failure.file), Not(IsEmpty()));
      EXPECT_THAT(failure.id, HasSubstr("/sphere-sphere/ball/"));
    }
    const kinds::EnvelopeTable which =
        is_fault ? kinds::EnvelopeTable::wrong : kinds::EnvelopeTable::honest;
    const std::string word = harm.outcome == grade::AnswerClass::crashed ? " crashes" : "";
    EXPECT_THAT(
        kinds::table(result.of<kinds::AxisChecker>().subjects(), reaches_of(result), which).rows(),
        ElementsAre(ElementsAre("algorithm", "balls"), ElementsAre("bad double", "2" + word)));
    const bool other_side = harm.harm == Harm::wrong_side || !word.empty();
    EXPECT_THAT(kinds::table(result.of<kinds::AxisChecker>().subjects(), reaches_of(result),
                             kinds::EnvelopeTable::side)
                    .rows()
                    .at(1),
                ElementsAre("bad double", other_side ? "2" + word : "-"));
    EXPECT_THAT(check::page_text(result, "touchstone check --axes", "figures"),
                HasSubstr("| bad double | 2" + word + " |"));
    EXPECT_THAT(read("envelope.csv"), HasSubstr(to_string(harm.outcome)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Harms, AxisHarm,
    ::testing::Values(
        AxisHarmCase{Harm::wrong_side, planted<Harm::wrong_side>, grade::AnswerClass::silent, 24,
                     0},
        AxisHarmCase{Harm::wrong_depth, planted<Harm::wrong_depth>, grade::AnswerClass::silent, 8,
                     0},
        AxisHarmCase{Harm::bad_bounds, planted<Harm::bad_bounds>, grade::AnswerClass::silent, 24,
                     0},
        AxisHarmCase{Harm::nan, planted<Harm::nan>, grade::AnswerClass::silent, 8, 0},
        AxisHarmCase{Harm::gives_up, planted<Harm::gives_up>, grade::AnswerClass::honest, 24, 0},
        // After three crashes in a task and value the rest is skipped: slots 0, 1 and 4 crash,
        // those from 5 on are not asked.
        AxisHarmCase{Harm::crashes, planted<Harm::crashes>, grade::AnswerClass::crashed, 18, 18}));

TEST_F(AxesRun, AHangThatIsBusyOrAsleepEndsAtItsLimit) {
  for (const NarrowPhaseEntry& entry :
       {busy("busy", Origin::ours), planted<Harm::hangs>("asleep", Origin::ours)}) {
    check::CheckRequest request = request_for({&entry});
    request.families.clear();
    draw(request, values[1]);
    request.cases = 1;
    const check::CheckReport result = check::run_check(request);
    EXPECT_EQ(count(result, grade::AnswerClass::hung), 3) << entry.info.name;
    EXPECT_THAT(result.ours_wrong(), Contains(HasSubstr("1 of 1 hung at balls 2")));
  }
}

TEST_F(AxesRun, ApproximateAndBoundsAreJudgedAsTheyState) {
  NarrowPhaseEntry approximate = planted<Harm::wrong_side>("bad", Origin::ours);
  approximate.traits.approximate = true;
  const check::CheckRequest request = request_for({&approximate});
  // A pair that is apart and called overlapping is excused; the reverse is not.
  EXPECT_EQ(count(check::run_check(request), grade::AnswerClass::silent), 12);
  NarrowPhaseEntry bound = planted<Harm::wrong_depth>("bad", Origin::ours);
  bound.traits.depth_is_bound = true;
  const check::CheckRequest with_bound = request_for({&bound});
  EXPECT_EQ(count(check::run_check(with_bound), grade::AnswerClass::silent), 4);  // the distances
}

}  // namespace
}  // namespace touchstone
