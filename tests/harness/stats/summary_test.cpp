// Tests of the summary of a run, on made-up results.
#include "harness/stats/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/harness/stats/sample_file.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::stats {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class SummaryOf : public testing::Test {
 protected:
  // A scene that was asked everything, and one that broad phases alone were asked.
  SummaryOf() {
    run_.spread = 0;
    FakeBlock boxes;
    boxes.contestants = {{"sweep-one-axis", 1e-3}, {"uniform-grid", 2e-3}, {"bullet-tree", 4e-3}};
    run_.blocks.push_back(boxes);
    boxes.scene = "home";
    run_.blocks.push_back(boxes);
    FakeBlock pairs;
    pairs.scene = "home";
    pairs.task = "distance";
    pairs.pair_kind = "box-box";
    pairs.contestants = {{"gjk", 100e-9}, {"bullet-gjk-epa", 50e-9}};
    run_.blocks.push_back(pairs);
    pairs.pair_kind = "hull-hull";
    pairs.contestants = {{"gjk", 200e-9}, {"bullet-gjk-epa", 800e-9}};
    run_.blocks.push_back(pairs);
  }
  std::string text(const ReportSetting& setting = {},
                   const std::vector<record::Departure>& departures = {}) {
    const Results results = read_results(run_.write(folder_.path() / "r"));
    return summary(results, make_tables(results, setting.noise), departures, folder_.path() / "r",
                   setting);
  }
  TemporaryFolder folder_;
  FakeRun run_;
};

TEST_F(SummaryOf, AQuietRunPutsTheWholeSceneInFrontAndSaysWhereLibrariesLead) {
  const std::string all = text();
  EXPECT_THAT(all, HasSubstr("Touchstone, fake: Test CPU, avx2. None of 480 samples was disturbed"))
      << all;
  EXPECT_THAT(all,
              ContainsRegex("home +3 +2 +1 +0 +0 +LIBRARIES LEAD IN 1 OF 3\n"
                            "  libraries lead  distance box-box 0.50 \\(bullet-gjk-epa\\)\n"
                            "  by pairs        boxes 4.00 \\(4.00 to 4.00\\), distance 2.8[0-9] "))
      << all;
  EXPECT_THAT(all, ContainsRegex("Which boxes overlap +1 +1 +0 +0 +0 +4.00 \\(4.00 to 4.00\\)  "
                                 "sweep-one-axis leads bullet-tree\n"))
      << all;
  EXPECT_LT(all.find("\nhome "), all.find("\nWhich boxes overlap "));
  EXPECT_THAT(all, AllOf(HasSubstr("  libraries   none\n"), HasSubstr("  ours        none\n"),
                         Not(HasSubstr("NOT TRUSTED")), HasSubstr("touchstone show ")));
  EXPECT_LE(std::ranges::count(all, '\n'), 25);
}

TEST_F(SummaryOf, ANoisyRunNamesNoWinner) {
  run_.noisy_squares = 3;  // of 4
  const std::string all = text();
  EXPECT_THAT(all, AllOf(HasSubstr("TOO NOISY TO COMPARE  other programs disturbed 75 %"),
                         HasSubstr("Answers were checked"), HasSubstr("HOW RIGHT"),
                         Not(HasSubstr("HOW FAST")), Not(HasSubstr("lead"))))
      << all;
  EXPECT_THAT(text({.noise = Noise::kept}), HasSubstr("HOW FAST"));
}

TEST_F(SummaryOf, FewerThanSixUndisturbedSquaresGiveNoRatio) {
  run_.processes = 1;
  run_.squares = 5;
  const std::string all = text();
  EXPECT_THAT(all, ContainsRegex("Which boxes overlap +1 +0 +0 +1 +0 +-  sweep-one-axis = "));
  EXPECT_THAT(all, HasSubstr("by pairs        boxes not decided, distance not decided\n"));
  EXPECT_THAT(
      all,
      HasSubstr("NOT TRUSTED of 4, counted as unclear: 4 (fewer than six undisturbed squares)"));
  const Results results = read_results(folder_.path() / "r");
  const Tables tables = make_tables(results, Noise::left_out);
  EXPECT_TRUE(tables.winners.empty());
  EXPECT_EQ(tables.undecided, 4u);
  EXPECT_THAT(tables_markdown(tables), HasSubstr("No winner in 4 more"));
}

// The one that was disturbed in every round may have been the fastest.
TEST_F(SummaryOf, OneThatWasAlwaysDisturbedLeavesItsInputOpen) {
  run_.blocks[0].contestants.push_back({"packed-rtree", 1e-4});
  run_.blocks[0].contestants.back().noisy = true;
  EXPECT_THAT(text(), ContainsRegex("Which boxes overlap +1 +0 +0 +1 +0 +-  "));
}

TEST_F(SummaryOf, InputsInWhichNoLibraryIsRightAreCountedAndHaveNoRatio) {
  run_.blocks[3].contestants[1].disagreements = 3;
  const std::string all = text();
  EXPECT_THAT(all, ContainsRegex("home +3 +1 +1 +0 +1 "));
  EXPECT_THAT(all, HasSubstr("distance 0.50 (0.50 to 0.50) on 50 % of the pairs\n"));
  EXPECT_THAT(all, HasSubstr("  libraries   bullet-gjk-epa 24 of 800 (home)\n")) << all;
  run_.blocks[2].contestants[1].disagreements = 1;
  EXPECT_THAT(text(), HasSubstr("distance no library is right\n"));
  const Tables tables = make_tables(read_results(folder_.path() / "r"), Noise::left_out);
  ASSERT_EQ(tables.narrow_best.size(), 2u);
  EXPECT_TRUE(std::isnan(tables.narrow_best[0].right_peer.ratio.median));
  EXPECT_TRUE(std::isnan(tables.narrow_best[0].right_peer.ratio.low));
  EXPECT_THAT(tables_markdown(tables), HasSubstr("| no library is right |"));
}

TEST_F(SummaryOf, AStoppedRunJudgesNothingThatWasNotChecked) {
  const ReportSetting stopped = {
      .stopped = Stop{"the check of block 1 of 2, home", "touchstone run c.toml --resume"}};
  EXPECT_THAT(text(stopped), HasSubstr("of what was checked before the stop\n"));
  run_.blocks.clear();
  const std::string all = text(stopped);
  EXPECT_THAT(all, HasSubstr("Stopped in the check of block 1 of 2, home. Go on: touchstone run "
                             "c.toml --resume\n"));
  EXPECT_THAT(all,
              AllOf(HasSubstr("Nothing was timed."), Not(HasSubstr("HOW")), Not(HasSubstr("none"))))
      << all;
}

TEST_F(SummaryOf, AnAlgorithmOfTheUserHasALineOfItsOwn) {
  EXPECT_THAT(text({.own = {"uniform-grid"}}),
              HasSubstr("YOURS     uniform-grid, 2 inputs: 2.00 x the time of the fastest other of "
                        "ours (2.00 .. 2.00; sweep-one-axis); 0.50 x the time of the fastest "
                        "library (0.50 .. 0.50; bullet-tree)\n"));
  run_.blocks.resize(1);
  run_.blocks[0].contestants[1].pair_hash = "00000000000000bb";
  EXPECT_THAT(text({.own = {"uniform-grid"}}), HasSubstr("; NOT RIGHT in 1\n"));
  run_.blocks[0].contestants = {{"uniform-grid", 2e-3}};
  EXPECT_THAT(text({.own = {"uniform-grid"}}), HasSubstr(" ms; nothing right stands beside it\n"));
}

TEST_F(SummaryOf, WrongLibrariesComeFirstAndWhatIsByDesignStandsApart) {
  FakeBlock depth;
  depth.task = "penetration";
  depth.pair_kind = "box-box";
  depth.contestants = {{"gjk", 100e-9},
                       {"sat-faces", 50e-9, "00000000000000aa", "ok", 2},
                       {"bullet-mpr", 50e-9, "00000000000000aa", "ok", 0, ",,,,,,,", "0.6"},
                       {"mpr", 90e-9, "00000000000000aa", "ok", 1}};
  run_.blocks = {depth};
  record::Departure by_design;
  by_design.algorithm = "sat-faces double";
  by_design.ours = by_design.known = true;
  by_design.what = "2 of 50 answers differ from exact's; approximate by design";
  EXPECT_THAT(text({}, {by_design}), HasSubstr("  libraries   bullet-mpr off by 0.6 of the size\n"
                                               "  ours        mpr 8 of 400 (uniform)\n"
                                               "  by design   sat-faces 16 of 400 (uniform)\n"));
}

TEST_F(SummaryOf, ASuspectInputIsNamedAndCountedAsUnclear) {
  run_.blocks[0].suspect = true;
  const std::string all = text();
  EXPECT_THAT(all, ContainsRegex("Which boxes overlap +1 +0 +0 +1 +0 +-  "));
  EXPECT_THAT(
      all, HasSubstr("NOT TRUSTED of 4, counted as unclear: 1 (an algorithm differed from its own "
                     "copy): uniform boxes\n"));
}

TEST_F(SummaryOf, AWinnerThatIsNotToldApartIsWrittenAsEqual) {
  run_.spread = 0.01;
  run_.blocks.resize(1);
  run_.blocks[0].contestants = {{"sweep-one-axis", 1e-3}, {"uniform-grid", 1e-3}};
  run_.write(folder_.path() / "r");
  const Tables tables = make_tables(read_results(folder_.path() / "r"), Noise::left_out);
  EXPECT_THAT(tables_markdown(tables),
              ContainsRegex("broad phases \\| (sweep-one-axis = uniform-grid|uniform-grid = "
                            "sweep-one-axis) \\| - \\|"));
}

}  // namespace
}  // namespace touchstone::stats
