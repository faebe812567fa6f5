// Tests of touchstone check --axes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "algorithms/registry.h"
#include "harness/files/cases.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CheckAxes : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  std::string out() const { return " --out " + path("out"); }
  Ran check(const std::string& arguments) const {
    return run_program("check " + arguments + out());
  }
  std::set<std::string> column(const std::string& file, const std::string& name) const {
    std::set<std::string> values;
    for (const auto& row : read_rows(path("out/" + file), {name})) values.insert(row[0]);
    return values;
  }
  void expect_refusal(const std::string& arguments, const std::string& text) {
    const bool has_axes = arguments.find("--axes") != std::string::npos;
    touchstone::expect_refusal("check " + arguments + (has_axes ? "" : " --axes") + out(), text,
                               folder);
  }

  TemporaryFolder folder;
};

TEST_F(CheckAxes, OursHoldAndThePageSaysSo) {
  const Ran ran =
      check("--narrow ours --axes gap,parallel --scalar double --quick --page " + path("page.md"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("none of our own algorithms is silently wrong"));
  EXPECT_EQ(column("stress.csv", "axis"), (std::set<std::string>{"gap", "parallel"}));
  EXPECT_THAT(column("stress.csv", "scalar"), ElementsAre("double"));
  EXPECT_EQ(column("cells.csv", "cases").size(), 1u);
  const std::string page = folder.read("page.md");
  EXPECT_THAT(page, HasSubstr("# Where each algorithm breaks"));
  EXPECT_THAT(page, HasSubstr("--axes gap,parallel"));
  EXPECT_THAT(page, HasSubstr("| gap | 1e0 | 1e-16 | parts of the size |"));
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (entry.info.origin != Origin::ours) continue;
    EXPECT_TRUE(column("envelope.csv", "algorithm").contains(entry.info.name) ||
                entry.info.name == "ellipsoid");
  }
}

TEST_F(CheckAxes, APeersWorstErrorsAreReplayed) {
  if (registry::find<NarrowPhaseEntry>("libccd-gjk")->make == nullptr)
    GTEST_SKIP() << "libccd is not built";
  const Ran ran = check("--narrow libccd-gjk --axes gap --cases 8");
  EXPECT_EQ(ran.status, 0) << ran.text;
  const std::string file = path("out/failures/libccd-gjk-double-intersect.jsonl");
  ASSERT_FALSE(files::read_cases(file).empty());
  const Ran again = run_program("query " + file +
                                " --narrow libccd-gjk,gjk --task intersect --scalar double --out " +
                                path("answers.csv"));
  EXPECT_EQ(again.status, 0) << again.text;
  const auto rows = read_rows(path("answers.csv"), {"algorithm", "answer"});
  ASSERT_FALSE(rows.empty());
  for (std::size_t i = 0; i < rows.size(); i += 2) {
    EXPECT_EQ(rows[i][1], "overlapping");
    EXPECT_EQ(rows[i + 1][1], "separated");
  }
}

TEST_F(CheckAxes, TheSameSeedGivesTheSameRows) {
  const std::string common = "--narrow gjk,mpr --axes depth --cases 3 --seed ";
  ASSERT_EQ(check(common + "5 --threads 1").status, 0);
  const std::string rows = folder.read("out/stress.csv");
  ASSERT_EQ(check(common + "5 --threads 3").status, 0);
  EXPECT_EQ(folder.read("out/stress.csv"), rows);
  ASSERT_EQ(check(common + "6").status, 0);
  EXPECT_NE(folder.read("out/stress.csv"), rows);
}

TEST_F(CheckAxes, ProofsOfItsCasesAreSavedAndVerified) {
  const std::string proofs = path("proofs.jsonl");
  const std::string drawn = "check --kind pair --axes gap,coplanar --cases 2 ";
  const Ran ran = run_program(drawn + "--save-certificates " + proofs);
  EXPECT_EQ(ran.status, 0) << ran.text;
  const Ran verified = run_program("check --certificates " + proofs);
  EXPECT_EQ(verified.status, 0) << verified.text;
  EXPECT_THAT(verified.text, HasSubstr(" certificates verified, 0 refused"));
  EXPECT_THAT(folder.read("proofs.jsonl"), HasSubstr("\"id\":\"stress-coplanar-"));
}

TEST_F(CheckAxes, BadRequests) {
  expect_refusal("--narrow what", "no narrow phase is called 'what'");
  expect_refusal("--narrow none", "no algorithm that is named has cases of these axes");
  expect_refusal("--axes what",
                 "no axis is called 'what'; expected some of scale-down, scale-up, ");
  expect_refusal("--scalar half", "--scalar");
  expect_refusal("--narrow exact --scalar float", "'exact' does not compute in float");
  expect_refusal("--seed x", "--seed");
  for (const char* value : {"0", "-1", "x"}) {
    expect_refusal(std::string("--cases=") + value, "--cases");
    expect_refusal(std::string("--threads=") + value, "--threads");
    expect_refusal(std::string("--time-limit=") + value, "--time-limit");
  }
  expect_refusal("--cases 3 --quick", "--quick");
  expect_refusal("--cases 100001", "--cases: found 100001; expected at most 100000 with --axes");
  for (const char* option :
       {"--regimes gap-1e-3", "--group gap", "--seconds 1", "--broad ours", "--count 1000"}) {
    expect_refusal(option, "--axes excludes --");
  }
  touchstone::expect_refusal("check --quick", "--quick requires --axes", folder);
  expect_refusal("--resume", "machine.csv: is not there");
  folder.write("file", "");
  touchstone::expect_refusal("check --quick --axes gap --out " + path("file/out"), "cannot be made",
                             folder);
}

}  // namespace
}  // namespace touchstone
