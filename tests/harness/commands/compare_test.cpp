// Tests of touchstone compare and tables, through the program.
#include <string>

#include "tests/harness/commands/program.h"
#include "tests/harness/stats/sample_file.h"

namespace touchstone {
namespace {

class CompareCommand : public testing::Test {
 protected:
  CompareCommand() {
    run_.square_spread = 0.005;
    run_.write(folder_.path() / "a");
    run_.seed = 2;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  // Writes run_ as B and compares.
  Ran compare(const std::string& options = "") {
    run_.write(folder_.path() / "b");
    return run_program("compare " + path("a") + " " + path("b") + " " + options);
  }
  TemporaryFolder folder_;
  FakeRun run_ = fake_run();
};

TEST_F(CompareCommand, TheSameIsStatusZero) {
  const Ran ran = compare("--csv " + path("cells.csv"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr("5 cells: 0 slower, 0 undecided, 5 same"));
  const auto rows = read_rows(folder_.path() / "cells.csv", {"algorithm", "verdict"});
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"sweep-one-axis", "same"}));
  // raw.csv files are accepted like folders.
  EXPECT_EQ(run_program("compare " + path("a/raw.csv") + " " + path("b/raw.csv")).status, 0);
}

TEST_F(CompareCommand, ARegressionIsStatusOne) {
  run_.blocks[0].contestants[1].seconds *= 1.05;
  EXPECT_EQ(compare().status, 1);
  EXPECT_THAT(compare().text, testing::HasSubstr("SLOWER"));
  EXPECT_EQ(compare("--threshold 0.1").status, 0);
  // In the other direction it is faster.
  EXPECT_EQ(run_program("compare " + path("b") + " " + path("a")).status, 0);
}

TEST_F(CompareCommand, WhatIsTheSameIsPrintedOnRequestOnly) {
  run_.blocks[0].contestants[1].seconds *= 1.05;
  const std::string few = compare().text;
  EXPECT_THAT(few,
              testing::ContainsRegex("SLOWER in B.*\n  1.0[0-9 ().to]+  uniform-grid, uniform"));
  EXPECT_THAT(few, testing::Not(testing::HasSubstr("naive")));
  EXPECT_THAT(compare("--all").text, testing::HasSubstr("naive"));
}

TEST_F(CompareCommand, ASummaryIsMadeOfTheRowsWhereNoneWasKept) {
  folder_.write("a/departures.csv", "block,row,algorithm,ours,known,where,what,reproduction\n");
  const Ran shown = run_program("show " + path("a"));
  EXPECT_EQ(shown.status, 0) << shown.text;
  EXPECT_THAT(shown.text, testing::HasSubstr("HOW FAST"));
  EXPECT_THAT(shown.text, testing::HasSubstr("Touchstone, fake: Test CPU"));
}

TEST_F(CompareCommand, OtherPairsAreStatusOne) {
  run_.blocks[0].contestants[1].pair_hash = "00000000000000bb";
  EXPECT_EQ(compare().status, 1);
  EXPECT_THAT(compare().text, testing::HasSubstr("The answers changed"));
}

TEST_F(CompareCommand, WhatIsNotComparableIsStatusTwoAndTold) {
  run_.machine["processor"] = "Another CPU";
  Ran ran = compare();
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.text, testing::HasSubstr("processor: 'Test CPU' in A, 'Another CPU' in B"));
  EXPECT_EQ(compare("--any-machine").status, 0);
  run_.isa = "baseline";
  EXPECT_EQ(compare("--any-machine").status, 2);
  std::filesystem::remove(folder_.path() / "b/machine.csv");
  ran = run_program("compare " + path("a") + " " + path("b"));
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.text, testing::HasSubstr("no machine.csv"));
}

TEST_F(CompareCommand, TooLittleIsStatusThree) {
  run_.processes = 1;
  run_.squares = 2;
  const Ran ran = compare();
  EXPECT_EQ(ran.status, 3) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr("5 undecided"));
  EXPECT_THAT(ran.text, testing::HasSubstr("Undecided\n  too few squares (12 + 2)"));
  EXPECT_THAT(ran.text, testing::HasSubstr("touchstone compare --exe OLD --exe NEW "));
}

TEST_F(CompareCommand, BadRequests) {
  expect_refusal("compare " + path("a"), "expected two", folder_);
  expect_refusal("compare " + path("a") + " " + path("none"), "none", folder_);
  expect_refusal("compare " + path("a") + " " + path("a") + " --threshold 0", "--threshold",
                 folder_);
  expect_refusal("compare --exe true", "expected it twice", folder_);
  expect_refusal("compare --exe true --exe true " + path("none.toml"), "none.toml", folder_);
  folder_.write("broken.csv", run_.raw() + "one,more\n");
  const Ran ran = run_program("compare " + path("a") + " " + path("broken.csv"));
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.text, testing::HasSubstr("broken.csv:"));
  EXPECT_THAT(ran.text, testing::HasSubstr("2 fields; expected 44"));
  EXPECT_THAT(run_program("compare --help").text, testing::HasSubstr("3  undecided"));
}

TEST_F(CompareCommand, ProgramsAreRunInTurns) {
  // The programs write made-up results, B's being 10 % slower, and log their names.
  for (const bool is_a : {true, false}) {
    const std::string name = is_a ? "prog-a" : "prog-b";
    if (!is_a) {
      for (FakeBlock& block : run_.blocks) {
        for (FakeContestant& c : block.contestants) c.seconds *= 1.1;
      }
    }
    run_.write(folder_.path() / (name + "-results"));
    folder_.write(name, "#!/bin/sh\nprintf " + name.substr(5) + " >>" + path("order") +
                            "\n[ \"$1 $3\" = 'run --out' ] || exit 9\ncp " +
                            path(name + "-results") + "/* \"$4\"\n");
    std::filesystem::permissions(folder_.path() / name, std::filesystem::perms::owner_all);
  }
  folder_.write("c.toml", "");
  const std::string request = "compare --exe " + path("prog-a") + " --exe " + path("prog-b") +
                              " --out " + path("out") + " ";
  const Ran ran = run_program(request + "--runs 8 " + path("c.toml"));
  EXPECT_EQ(ran.status, 1) << ran.text;
  EXPECT_EQ(folder_.read("order"), "abbaabbaabbaabba");
  EXPECT_THAT(ran.text, testing::HasSubstr("5 cells: 5 slower"));
  // These are too few runs for an interval.
  EXPECT_EQ(run_program(request + "--runs 3 " + path("c.toml")).status, 3);
  // This program fails.
  folder_.write("prog-b", "#!/bin/sh\nexit 2\n");
  const Ran failed = run_program(request + path("c.toml"));
  EXPECT_EQ(failed.status, 2);
  EXPECT_THAT(failed.text, testing::HasSubstr("ended with status 2"));
  EXPECT_EQ(
      run_program("compare --exe /none/a --exe /none/b " + path("c.toml") + " --out " + path("out"))
          .status,
      2);
}

TEST_F(CompareCommand, TablesAreWrittenAndChecked) {
  const Ran written = run_program("show --tables " + path("a") + " --band 1.1");
  EXPECT_EQ(written.status, 0) << written.text;
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "a/tables.md"));
  run_.write(folder_.path() / "b");
  const std::string check = "reproduce " + path("a") + " --results " + path("b");
  Ran ran = run_program(check);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text,
              testing::HasSubstr(
                  "3 cells: 3 pass, 0 fail, 0 differ on this machine, 0 undecided; 0 answers"));
  run_.blocks[0].contestants[1].seconds *= 2;
  run_.write(folder_.path() / "b");
  ran = run_program(check);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr("3 cells: 2 pass, 0 fail, 1 differ on this machine"));
  run_.blocks[0].contestants[1].seconds *= 2;
  run_.write(folder_.path() / "b");
  ran = run_program(check);
  EXPECT_EQ(ran.status, 1) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr("3 cells: 2 pass, 1 fail, 0 differ on this machine"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "b/tables.md"));
  expect_refusal("reproduce " + path("b") + " --results " + path("b"), "b/ratios.csv", folder_);
  expect_refusal("show --tables " + path("none"), "none", folder_);
  // The campaign of the reference is not one of the project's.
  expect_refusal("reproduce " + path("a"), "fake.toml", folder_);
}

}  // namespace
}  // namespace touchstone
