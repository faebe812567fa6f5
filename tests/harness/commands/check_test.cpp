// Tests of touchstone check.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <set>

#include "algorithms/registry.h"
#include "harness/base/clock.h"
#include "harness/files/cases.h"
#include "harness/kinds/pair/regimes/regimes.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class CheckCommand : public ::testing::Test {
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
    touchstone::expect_refusal("check " + arguments, text, folder);
  }

  TemporaryFolder folder;
};

TEST_F(CheckCommand, GradesOursAndFindsThemWithinTheirMargins) {
  const Ran ran = check("--narrow ours --broad ours --cases 3 --page " + path("page.md"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("None of our own algorithms is wrong beyond its margin."));
  std::set<std::string> names, of_regimes;
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (entry.info.origin == Origin::ours) names.insert(entry.info.name);
  }
  for (const kinds::Regime& regime : kinds::regimes()) of_regimes.insert(regime.name);
  EXPECT_EQ(column("grades.csv", "algorithm"), names);
  EXPECT_EQ(column("grades.csv", "regime"), of_regimes);
  EXPECT_THAT(column("grades.csv", "scalar"), ElementsAre("double", "float"));
  EXPECT_THAT(column("grades.csv", "task"),
              ElementsAre("distance", "intersect", "penetration", "signed"));
  EXPECT_THAT(column("grades.csv", "encoding"), ElementsAre("as_given"));
  EXPECT_EQ(column("summary.csv", "algorithm"), names);
  EXPECT_THAT(column("machine.csv", "name"), testing::IsSupersetOf({"seed", "commit", "compiler"}));
  EXPECT_THAT(folder.read("page.md"), HasSubstr("# Who is wrong where"));
  EXPECT_THAT(folder.read("page.md"), HasSubstr("`touchstone check --cases 3 "));
  for (const std::string& name : names) EXPECT_THAT(ran.text, HasSubstr(name));
}

TEST_F(CheckCommand, APeersDefectIsNoFailureAndIsReplayed) {
  if (registry::find<NarrowPhaseEntry>("libccd-gjk")->make == nullptr)
    GTEST_SKIP() << "libccd is not built";
  // libccd reports these gaps as overlaps.
  const Ran ran = check("--narrow libccd-gjk --broad none --regimes gap-1e-9 --cases 20");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(column("grades.csv", "verdict"), testing::Contains("silent_error"));
  const std::string file = path("out/failures/libccd-gjk-double-intersect.jsonl");
  const std::vector<files::Case> cases = files::read_cases(file);
  ASSERT_FALSE(cases.empty());
  const Ran again = run_program("query " + file +
                                " --narrow libccd-gjk,gjk --task intersect --scalar double --out " +
                                path("answers.csv"));
  EXPECT_EQ(again.status, 0) << again.text;
  const auto rows = read_rows(path("answers.csv"), {"algorithm", "answer"});
  for (std::size_t i = 0; i < rows.size(); i += 2) {
    EXPECT_EQ(rows[i][1], "overlapping");
    EXPECT_EQ(rows[i + 1][1], "separated");
  }
}

TEST_F(CheckCommand, ScoresOfAFile) {
  const std::string box = R"({"shape":{"type":"box","half_extents":[1,1,1]}})";
  folder.write("two.jsonl",
               R"({"id":"x","a":)" + box +
                   R"(,"b":{"shape":{"type":"sphere","radius":1},"translation":[3,0,0]}}
{"id":"y","a":)" + box +
                   R"(,"b":)" + box + "}\n");
  const Ran ran = run_program("check " + path("two.jsonl") + " --with gjk --scalar double" + out());
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("gave up  failed  wrong  score"));
  const auto rows = read_rows(path("out/summary.csv"), {"regime", "answers", "right", "score"});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0][0], "two");
  EXPECT_EQ(rows[0][2], rows[0][1]);
  EXPECT_EQ(rows[0][3], rows[0][1]);
  EXPECT_THAT(column("grades.csv", "grade"), ElementsAre("right"));
  const std::string proofs = path("proofs.jsonl");
  const Ran saved = run_program("check " + path("two.jsonl") + " --save-certificates " + proofs);
  EXPECT_EQ(saved.status, 0) << saved.text;
  const Ran verified = run_program("check --certificates " + proofs);
  EXPECT_THAT(verified.text, HasSubstr("2 certificates verified, 0 refused"));
}

TEST_F(CheckCommand, Filters) {
  const Ran ran = check(
      "--narrow gjk,sat --scalar float --group touching --regimes gap-1e-3 --cases 2 --broad none "
      "--seed 7");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(column("grades.csv", "algorithm"), ElementsAre("gjk", "sat"));
  EXPECT_THAT(column("grades.csv", "scalar"), ElementsAre("float"));
  EXPECT_THAT(column("grades.csv", "group"), ElementsAre("gap", "touching"));
  EXPECT_THAT(column("grades.csv", "index"), ElementsAre("0", "1"));
  EXPECT_THAT(folder.read("out/machine.csv"), HasSubstr("seed,7\n"));
}

TEST_F(CheckCommand, TheSameSeedGivesTheSameRows) {
  const std::string common = "--narrow gjk --broad none --group random --cases 4 --seed ";
  ASSERT_EQ(check(common + "5 --threads 1").status, 0);
  const std::string rows = folder.read("out/grades.csv");
  ASSERT_EQ(check(common + "5 --threads 3").status, 0);
  EXPECT_EQ(folder.read("out/grades.csv"), rows);
  ASSERT_EQ(check(common + "6").status, 0);
  EXPECT_NE(folder.read("out/grades.csv"), rows);
}

TEST_F(CheckCommand, BroadPhasesAlone) {
  const Ran ran = check("--narrow none --broad ours");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("broad phases find all pairs of all"));
}

TEST_F(CheckCommand, CertificatesAreSavedAndVerified) {
  const std::string file = path("proofs.jsonl");
  Ran ran = run_program("check --save-certificates " + file + " --group gap --cases 2");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("certificates in " + file));
  ran = run_program("check --certificates " + file);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr(" certificates verified, 0 refused"));
  std::string text = folder.read("proofs.jsonl");
  text.replace(text.find("\"separated\""), 11, "\"overlapping\"");
  folder.write("proofs.jsonl", text);
  ran = run_program("check --certificates " + file);
  EXPECT_EQ(ran.status, 1) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr(file + ":1: gap-"));
  EXPECT_THAT(ran.text, HasSubstr(", 1 refused"));
}

TEST_F(CheckCommand, KilledInTheMiddleAndGoneOnWith) {
  const std::string arguments =
      "check --narrow gjk,mpr --broad none --group gap,depth --cases 20" + out();
  const pid_t child = fork();
  if (child == 0) {
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, STDOUT_FILENO);
    dup2(null, STDERR_FILENO);
    execl("/bin/sh", "sh", "-c", ("exec " TOUCHSTONE_PROGRAM " " + arguments).c_str(), nullptr);
    _exit(127);
  }
  const base::Stopwatch watch;
  const auto jobs_done = [&] {
    const std::string text = folder.names().empty() ? "" : folder.read("out/progress.csv");
    const auto at = text.find("\nunits,");
    return at == std::string::npos ? 0 : std::stoi(text.substr(at + 7));
  };
  while (jobs_done() < 3 && watch.seconds() < 60) usleep(500);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  ASSERT_GE(jobs_done(), 3);
  ASSERT_LT(jobs_done(), 18) << "all jobs were done before the process was killed";
  const Ran resumed = run_program(arguments + " --resume");
  EXPECT_EQ(resumed.status, 0) << resumed.text;
  const std::string rows = folder.read("out/grades.csv");
  EXPECT_EQ(run_program(arguments).status, 0);
  EXPECT_EQ(folder.read("out/grades.csv"), rows);
  const Ran other = run_program(arguments + " --resume --seed 2");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.text, HasSubstr("seed was '1' and is '2' now"));
  EXPECT_EQ(folder.read("out/grades.csv"), rows);
}

TEST_F(CheckCommand, CountsVerdicts) {
  const Ran ran = check("--count 2000 --with gjk,mpr --regimes gap-1e-3 --seed 3");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(column("soak.csv", "algorithm"), ElementsAre("gjk", "mpr"));
  EXPECT_THAT(column("soak.csv", "drawn"), ElementsAre("2000"));
  EXPECT_THAT(column("soak.csv", "seed"), ElementsAre("3"));
  for (const char* option : {"--cases 3", "--seconds 1", "--page x.md", "--broad ours",
                             "--save-certificates x.jsonl", "--axes gap"}) {
    expect_refusal(std::string("--count 1000 ") + option + out(), "excludes --");
  }
  expect_refusal("--count 1000 --kind box" + out(), "expected some of another kind than box");
}

TEST_F(CheckCommand, FilesSayTheSameAsOptions) {
  folder.write("count.toml",
               "[check]\ncount = 2000\nwith = 'gjk'\nregimes = 'gap-1e-3'\nseed = 3\n");
  folder.write("axes.toml", "[check]\naxes = 'gap'\ncases = 1\nnarrow = 'gjk'\n");
  folder.write("both.toml", "[check]\naxes = 'all'\ncount = 2000\n");
  for (const auto& [file, options, rows] :
       {std::array<std::string, 3>{
            "count.toml", "--count 2000 --with gjk --regimes gap-1e-3 --seed 3", "jobs.csv"},
        {"axes.toml", "--axes gap --cases 1 --narrow gjk", "stress.csv"}}) {
    const Ran ran = run_program("run " + path(file) + " --out " + path("file"));
    EXPECT_EQ(ran.status, 0) << ran.text;
    EXPECT_EQ(check(options).status, 0);
    EXPECT_EQ(folder.read("file/" + rows), folder.read("out/" + rows)) << file;
  }
  touchstone::expect_refusal("run " + path("both.toml") + out(), "expected it without `axes`",
                             folder);
}

// `show` prints what the work ended with.
TEST_F(CheckCommand, ItsSummaryIsShownAgain) {
  for (const char* options : {"--narrow gjk --broad none --cases 1 --group gap",
                              "--narrow gjk --axes gap --cases 1", "--count 1000 --narrow gjk"}) {
    const Ran ran = check(options);
    const Ran shown = run_program("show " + path("out"));
    EXPECT_EQ(shown.status, 0) << shown.text;
    EXPECT_THAT(shown.text, HasSubstr(path("out")));
    EXPECT_THAT(ran.text, HasSubstr(shown.text)) << options;
  }
  // A file of somebody else stays.
  folder.write("out/files.txt", "");
  folder.write("out/summary.txt", "mine");
  const Ran ran = check("--narrow gjk --broad none --cases 1 --group gap");
  EXPECT_EQ(ran.status, 0);
  EXPECT_THAT(ran.text, HasSubstr("summary.txt is not of this program, and stays as it is"));
  EXPECT_EQ(folder.read("out/summary.txt"), "mine");
  touchstone::expect_refusal("show " + path("none"), "none: is not there", folder);
  touchstone::expect_refusal("show " + path(""), "holds no summary.txt", folder);
  touchstone::expect_refusal("show " + path("out") + " --out x",
                             "--out was given; expected it with", folder);
}

TEST_F(CheckCommand, BadRequests) {
  expect_refusal("--narrow what" + out(), "no narrow phase is called 'what'");
  expect_refusal("--broad what" + out(), "no broad phase is called 'what'");
  expect_refusal("--regimes what" + out(), "no regime is called 'what'; expected some of gap-");
  expect_refusal("--group what" + out(),
                 "no group of regimes is called 'what'; expected some of gap, depth, ");
  expect_refusal("--scalar half" + out(), "--scalar");
  expect_refusal("--narrow exact --scalar float" + out(), "'exact' does not compute in float");
  expect_refusal("--seed x" + out(), "--seed");
  for (const char* value : {"0", "-1", "x"}) {
    expect_refusal(std::string("--cases=") + value + out(), "--cases");
    expect_refusal(std::string("--seconds=") + value + out(), "--seconds");
    expect_refusal(std::string("--threads=") + value + out(), "--threads");
    expect_refusal(std::string("--time-limit=") + value + out(), "--time-limit");
  }
  expect_refusal("--resume" + out(), "machine.csv: is not there");
  expect_refusal("--certificates " + path("none.jsonl"), "none.jsonl: No such file");
  expect_refusal("--certificates x.jsonl --seed 2", "--certificates");
  expect_refusal("--save-certificates " + path("no/x.jsonl"), "No such file");
  expect_refusal("--page " + path("no/page.md") + out(), "No such file");
  folder.write("file", "");
  expect_refusal("--cases 1 --group random --out " + path("file/out"), "cannot be made");
  folder.write("bad.jsonl", "{}\n");
  expect_refusal("--certificates " + path("bad.jsonl"), "bad.jsonl:1: ");
}

}  // namespace
}  // namespace touchstone
