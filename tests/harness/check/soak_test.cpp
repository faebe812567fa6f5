// Tests that a soak counts faults of planted algorithms, and resumes.
#include "harness/check/soak/soak.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/base/error.h"
#include "tests/harness/check/planted.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SoakRun : public ::testing::Test {
 protected:
  check::SoakRequest request_for(const std::vector<const NarrowPhaseEntry*>& narrow) {
    check::SoakRequest request;
    request.narrow = narrow;
    request.regimes = {&balls, &others};
    request.pairs = 4000;
    request.time_limit = 0.5;
    request.out = folder.path();
    return request;
  }

  TemporaryFolder folder;
  check::Regime balls = balls_regime(), others = balls_regime("others");
};

TEST_F(SoakRun, TouchingWithinBoundsThatDoNotHoldIsWrong) {
  const NarrowPhaseEntry wrong = planted<Harm::touches_elsewhere>("wrong", Origin::ours);
  const check::SoakRequest request = request_for({&wrong});
  const check::SoakResult result = check::run_soak(request);
  EXPECT_EQ(result.counts.at({0, Precision::float64, 0}).silent, 1000);
  EXPECT_TRUE(result.ours_are_wrong(request));
}

TEST_F(SoakRun, CountsWhatIsTrueAndWhoIsWrong) {
  const NarrowPhaseEntry good = planted<Harm::none>("good", Origin::ours);
  const NarrowPhaseEntry wrong = planted<Harm::wrong_side>("wrong", Origin::ours);
  const NarrowPhaseEntry shy = planted<Harm::gives_up>("shy", Origin::ours);
  const check::SoakRequest request = request_for({&good, &wrong, &shy});
  const check::SoakResult result = check::run_soak(request);
  EXPECT_EQ(result.drawn, 4000);
  ASSERT_EQ(result.counts.size(), 6u);
  for (std::size_t regime = 0; regime < 2; ++regime) {
    const auto& count = [&](std::size_t entry) -> const check::SoakCount& {
      return result.counts.at({entry, Precision::float64, regime});
    };
    for (std::size_t entry = 0; entry < 3; ++entry) {
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
  EXPECT_TRUE(result.ours_are_wrong(request));
  EXPECT_THAT(folder.names(),
              ElementsAre("families.csv", "files.txt", "jobs.csv", "machine.csv", "progress.csv",
                          "soak.csv", "wrong-double-balls.jsonl", "wrong-double-others.jsonl"));
}

TEST_F(SoakRun, ACrashIsLostAndTheRestGoesOn) {
  const NarrowPhaseEntry entry = planted<Harm::crashes>("crashes", Origin::peer);
  check::SoakRequest request = request_for({&entry});
  request.pairs = 1;  // one whole job is the least
  const check::SoakResult result = check::run_soak(request);
  EXPECT_EQ(result.drawn, 1000);
  EXPECT_GT(result.counts.begin()->second.lost, 0);
  EXPECT_FALSE(result.ours_are_wrong(request));
}

TEST_F(SoakRun, GoesOnWhereItEnded) {
  const NarrowPhaseEntry wrong = planted<Harm::wrong_side>("wrong", Origin::ours);
  check::SoakRequest request = request_for({&wrong});
  request.pairs = 3000;
  check::run_soak(request);
  request.pairs = 4000;
  request.resume = true;
  EXPECT_EQ(check::run_soak(request).drawn, 4000);
  const std::string resumed = folder.read("soak.csv");
  request.resume = false;
  check::run_soak(request);
  EXPECT_EQ(folder.read("soak.csv"), resumed);
}

TEST_F(SoakRun, AKillLosesNoFinishedJob) {
  const NarrowPhaseEntry wrong = planted<Harm::wrong_side>("wrong", Origin::ours);
  check::SoakRequest request = request_for({&wrong});
  check::run_soak(request);
  const std::string jobs = folder.read("jobs.csv"), sums = folder.read("soak.csv");
  request.pairs = 3000;
  check::run_soak(request);
  // A kill leaves a torn row, and sums that are older than the jobs.
  std::string machine = folder.read("machine.csv");
  folder.write("machine.csv", machine.replace(machine.find("finished,yes"), 12, "finished,no"));
  folder.write("jobs.csv", folder.read("jobs.csv") + "wrong,dou");
  folder.write("soak.csv", "");
  request.pairs = 4000;
  request.resume = true;
  check::run_soak(request);
  EXPECT_EQ(folder.read("jobs.csv"), jobs);
  EXPECT_EQ(folder.read("soak.csv"), sums);
}

TEST_F(SoakRun, OnlyGoesOnWithItsOwn) {
  const NarrowPhaseEntry good = planted<Harm::none>("good", Origin::ours);
  const NarrowPhaseEntry other = planted<Harm::none>("other", Origin::ours);
  check::SoakRequest request = request_for({&good});
  request.resume = true;
  EXPECT_THAT(input_fault([&] { check::run_soak(request); }),
              HasSubstr("is not there; expected the folder of a soak"));
  request.resume = false;
  check::run_soak(request);
  request.resume = true;
  request.seed = 2;
  EXPECT_THAT(input_fault([&] { check::run_soak(request); }),
              HasSubstr("seed was '1' and is '2' now"));
  request.seed = 1;
  request.narrow = {&other};
  EXPECT_THAT(input_fault([&] { check::run_soak(request); }),
              HasSubstr("narrow was 'good' and is 'other' now"));
  request.narrow = {&good, &other};
  EXPECT_THAT(input_fault([&] { check::run_soak(request); }),
              HasSubstr("narrow was 'good' and is 'good other' now"));
  request.narrow = {&good};
  request.out = "/dev/null/x";
  request.resume = false;
  EXPECT_THAT(input_fault([&] { check::run_soak(request); }), HasSubstr("cannot be made"));
}

}  // namespace
}  // namespace touchstone
