// Tests that a check with --count counts faults of planted algorithms, and resumes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/base/error.h"
#include "harness/check/check_run.h"
#include "tests/harness/check/planted.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class CountRun : public ::testing::Test {
 protected:
  check::CheckRequest request_for(const std::vector<const NarrowPhaseEntry*>& narrow) {
    check::CheckRequest request(check::CheckMode::count);
    ask(request, narrow);
    draw(request, balls);
    draw(request, others);
    request.count = 4000;
    request.time_limit = 0.5;
    request.out = folder.path();
    return request;
  }

  using Verdicts = std::map<kinds::RegimeKey, kinds::VerdictCount>;
  static const Verdicts& verdicts(const check::CheckReport& result) {
    return result.of<kinds::CountChecker>().verdicts();
  }

  TemporaryFolder folder;
  kinds::Regime balls = balls_regime(), others = balls_regime("others");
};

TEST_F(CountRun, TouchingWithinBoundsThatDoNotHoldIsWrong) {
  const NarrowPhaseEntry wrong = planted<Harm::touches_elsewhere>("wrong", Origin::ours);
  const check::CheckRequest request = request_for({&wrong});
  const check::CheckReport result = check::run_check(request);
  EXPECT_EQ(verdicts(result).at({0, Precision::float64, 0}).silent, 1000);
  EXPECT_THAT(result.ours_wrong(), Not(IsEmpty()));
}

TEST_F(CountRun, CountsWhatIsTrueAndWhoIsWrong) {
  const NarrowPhaseEntry good = planted<Harm::none>("good", Origin::ours);
  const NarrowPhaseEntry wrong = planted<Harm::wrong_side>("wrong", Origin::ours);
  const NarrowPhaseEntry shy = planted<Harm::gives_up>("shy", Origin::ours);
  const check::CheckRequest request = request_for({&good, &wrong, &shy});
  const check::CheckReport result = check::run_check(request);
  EXPECT_EQ(result.jobs, 4);
  ASSERT_EQ(verdicts(result).size(), 6u);
  for (std::uint32_t regime = 0; regime < 2; ++regime) {
    const auto& count = [&](std::uint32_t entry) -> const kinds::VerdictCount& {
      return verdicts(result).at({entry, Precision::float64, regime});
    };
    for (std::uint32_t entry = 0; entry < 3; ++entry) {
      EXPECT_EQ(count(entry).pairs, 2000);
      EXPECT_EQ(count(entry).separated, 1000);
      EXPECT_EQ(count(entry).overlapping, 1000);
      EXPECT_EQ(count(entry).lost, 0);
    }
    EXPECT_EQ(count(0).silent + count(0).honest, 0);
    EXPECT_EQ(count(0).first_wrong, -1);
    EXPECT_EQ(count(1).silent, 1000);
    EXPECT_EQ(count(1).first_wrong, 0);
    EXPECT_EQ(count(2).silent, 0);
    EXPECT_EQ(count(2).honest, 1000);
  }
  EXPECT_THAT(result.ours_wrong(), Not(IsEmpty()));
  EXPECT_THAT(folder.names(), ElementsAre("failures", "families.csv", "files.txt", "jobs.csv",
                                          "machine.csv", "progress.csv", "soak.csv"));
  // A case of each regime, made as small as it still fails.
  EXPECT_EQ(files::read_cases(folder.path() / "failures/wrong-double-intersect.jsonl").size(), 2u);
  const std::string text = check::summary_text(result, 120);
  EXPECT_THAT(text, HasSubstr("wrong double on balls: of 2000 pairs 1000 silently wrong"));
}

TEST_F(CountRun, ACrashIsLostAndTheRestGoesOn) {
  const NarrowPhaseEntry entry = planted<Harm::crashes>("crashes", Origin::peer);
  check::CheckRequest request = request_for({&entry});
  request.count = 1;  // one whole job is the least
  const check::CheckReport result = check::run_check(request);
  EXPECT_EQ(result.jobs, 1);
  EXPECT_GT(verdicts(result).begin()->second.lost, 0);
  EXPECT_THAT(result.ours_wrong(), IsEmpty());
}

TEST_F(CountRun, GoesOnWhereItEnded) {
  const NarrowPhaseEntry wrong = planted<Harm::wrong_side>("wrong", Origin::ours);
  check::CheckRequest request = request_for({&wrong});
  request.count = 3000;
  check::run_check(request);
  request.count = 4000;
  request.resume = true;
  EXPECT_EQ(check::run_check(request).jobs, 4);
  const std::string resumed = folder.read("soak.csv");
  request.resume = false;
  check::run_check(request);
  EXPECT_EQ(folder.read("soak.csv"), resumed);
}

TEST_F(CountRun, AKillLosesNoFinishedJob) {
  const NarrowPhaseEntry wrong = planted<Harm::wrong_side>("wrong", Origin::ours);
  check::CheckRequest request = request_for({&wrong});
  check::run_check(request);
  const std::string jobs = folder.read("jobs.csv"), sums = folder.read("soak.csv");
  request.count = 3000;
  check::run_check(request);
  // A kill leaves a torn row, and sums that are older than the jobs.
  std::string machine = folder.read("machine.csv");
  folder.write("machine.csv", machine.replace(machine.find("finished,yes"), 12, "finished,no"));
  folder.write("jobs.csv", folder.read("jobs.csv") + "wrong,dou");
  folder.write("soak.csv", "");
  request.count = 4000;
  request.resume = true;
  check::run_check(request);
  EXPECT_EQ(folder.read("jobs.csv"), jobs);
  EXPECT_EQ(folder.read("soak.csv"), sums);
}

TEST_F(CountRun, OnlyGoesOnWithItsOwn) {
  const NarrowPhaseEntry good = planted<Harm::none>("good", Origin::ours);
  const NarrowPhaseEntry other = planted<Harm::none>("other", Origin::ours);
  check::CheckRequest request = request_for({&good});
  request.resume = true;
  EXPECT_THAT(input_fault([&] { check::run_check(request); }),
              HasSubstr("is not there; expected the folder of a check"));
  request.resume = false;
  check::run_check(request);
  request.resume = true;
  request.seed = 2;
  EXPECT_THAT(input_fault([&] { check::run_check(request); }),
              HasSubstr("seed was '1' and is '2' now"));
  request.seed = 1;
  ask(request, {&other});
  EXPECT_THAT(input_fault([&] { check::run_check(request); }),
              HasSubstr("contestants was 'pair good double' and is 'pair other double' now"));
  ask(request, {&good, &other});
  EXPECT_THAT(
      input_fault([&] { check::run_check(request); }),
      HasSubstr(
          "contestants was 'pair good double' and is 'pair good double, pair other double' now"));
  ask(request, {&good});
  request.out = "/dev/null/x";
  request.resume = false;
  EXPECT_THAT(input_fault([&] { check::run_check(request); }), HasSubstr("cannot be made"));
}

}  // namespace
}  // namespace touchstone
