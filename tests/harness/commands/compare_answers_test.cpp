// Tests of touchstone compare on checks and on counts of instructions, and of the recipe for CI.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "harness/base/names.h"
#include "tests/harness/commands/program.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CompareAnswers : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  // Checks a peer of spheres, whose sign is wrong in version 2.
  void check(const std::string& out, const std::string& version, const std::string& more = "") {
    const Ran ran = run_program(fmt::format(
        "check --regimes gap-1e-1,depth-1e-1,gap-1e-3 --cases 80 --scalar double --peer 'python3 "
        "{}/tests/harness/peer/hostile.py {} 0 lib {}' {} --out {}",
        project_folder, version == "2" ? "wrong-sign" : "none", version, more, path(out)));
    ASSERT_EQ(ran.status, 0) << ran.text;
  }
  Ran compare(const std::string& arguments) { return run_program("compare " + arguments); }
  TemporaryFolder folder_;
};

TEST_F(CompareAnswers, NewlyWrongIsStatusOne) {
  check("a", "1");
  check("b", "2");
  const Ran ran = compare(path("a") + " " + path("b") + " --markdown " + path("found.md") +
                          " --csv " + path("found.csv"));
  EXPECT_EQ(ran.status, 1) << ran.text;
  EXPECT_THAT(ran.text, AllOf(HasSubstr("Became wrong\n  "), HasSubstr("separated -> overlapping"),
                              HasSubstr("0 became right")));
  EXPECT_THAT(folder_.read("found.md"),
              AllOf(HasSubstr("### Answers: FAILED"), HasSubstr("| lib | double | 1 | 2 |"),
                    HasSubstr("**Became wrong**")));
  int wrong = 0;
  for (const auto& row : read_rows(path("found.csv"), {"became", "library", "from", "to"})) {
    EXPECT_EQ(row[1] + row[2] + row[3], "lib12");
    wrong += row[0] == "wrong" ? 1 : 0;
  }
  EXPECT_GT(wrong, 1);
}

TEST_F(CompareAnswers, NothingOrNewlyRightIsStatusZero) {
  check("a", "2");
  check("b", "3");
  const Ran right = compare(path("a") + " " + path("b") + " --markdown -");
  EXPECT_EQ(right.status, 0) << right.text;
  EXPECT_THAT(right.text, AllOf(HasSubstr("### Answers: passed"), HasSubstr("**Became right**"),
                                HasSubstr(" 0 became wrong")));
  const Ran same = compare(path("b") + " " + path("b"));
  EXPECT_EQ(same.status, 0) << same.text;
  EXPECT_THAT(same.text, AllOf(HasSubstr(" 0 became wrong, 0 lost, 0 became right, 0 changed"),
                               Not(HasSubstr("Became"))));
}

TEST_F(CompareAnswers, OfLibrariesThatAreBuiltInAreCompared) {
  for (const char* out : {"a", "b"}) {
    ASSERT_EQ(run_program("check --groups gap --cases 2 --with gjk --out " + path(out)).status, 0);
  }
  const Ran ran = compare(path("a") + " " + path("b"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("gjk"));
}

TEST_F(CompareAnswers, WhatCannotBeComparedIsRefused) {
  check("a", "1");
  check("b", "1", "--seed 9");
  expect_refusal("compare " + path("a") + " " + path("b"),
                 "b/machine.csv: seed: found '9'; expected '1'", folder_);
  expect_refusal("compare " + path("a") + " " + path("none"), "none: has neither grades.csv",
                 folder_);
  expect_refusal("compare " + path("a") + " " + path("a") + " --noisy", "--noisy was given",
                 folder_);
  expect_refusal("compare " + path("a") + " " + path("a") + " --markdown " + path("no/where.md"),
                 "where.md", folder_);
  std::string grades = folder_.read("a/grades.csv");
  folder_.write("a/grades.csv", grades.substr(0, grades.size() - 30));
  expect_refusal("compare " + path("a") + " " + path("a"), "a/grades.csv:", folder_);
}

TEST_F(CompareAnswers, CountsOfInstructionsHaveALimit) {
  const std::string head = "benchmark,queries,instructions\n";
  folder_.write("a.csv", head + "narrow/x,256,100\nnarrow/y,256,200\n");
  folder_.write("b.csv", head + "narrow/x,256,102\nnarrow/y,256,200\n");
  const std::string both = path("a.csv") + " " + path("b.csv");
  EXPECT_EQ(compare(both).status, 0) << "3 % are allowed";
  const Ran ran = compare(both + " --threshold 0.01 --markdown " + path("found.md"));
  EXPECT_EQ(ran.status, 1) << ran.text;
  EXPECT_THAT(ran.text,
              AllOf(HasSubstr("narrow/x"), HasSubstr("+2.00 %"), Not(HasSubstr("narrow/y"))));
  EXPECT_THAT(folder_.read("found.md"), HasSubstr("### Instructions: FAILED"));
  expect_refusal("compare " + both + " --max-error 1", "--max-error was given", folder_);
}

// The steps of datasets/adapters/gate.yml that are lines of the shell, without those that install and build this program.
std::vector<std::string> steps_of_gate() {
  std::ifstream file(std::string(project_folder) + "/datasets/adapters/gate.yml");
  std::vector<std::string> steps;
  bool is_open = false;
  for (std::string line; std::getline(file, line);) {
    constexpr std::string_view indent = "          ";
    if (is_open && line.starts_with(indent)) {
      steps.back() += line.substr(indent.size()) + "\n";
    } else if ((is_open = line.ends_with("run: |"))) {
      steps.emplace_back();
    }
  }
  return steps;
}

class Gate : public CompareAnswers {
 protected:
  Gate() {
    for (const char* side : {"old", "new", "touchstone"}) {
      std::filesystem::create_directory(folder_.path() / side);
    }
    const std::string example =
        std::string(project_folder) + "/datasets/adapters/examples/spheres.c";
    for (const char* side : {"old", "new"}) {
      std::filesystem::copy_file(example, folder_.path() / side / "spheres.c");
    }
    std::string pairs;
    for (int i = 1; i <= 20; ++i) {
      pairs += fmt::format(
          R"({{"a":{{"shape":{{"type":"sphere","radius":1}}}},"b":{{"shape":{{"type":"sphere",)"
          R"("radius":1}},"translation":[{},0.5,0]}}}})"
          "\n",
          0.2 * i);
    }
    folder_.write("new/pairs.jsonl", pairs);
    folder_.write("touchstone/touchstone", "#!/bin/sh\nexec " TOUCHSTONE_PROGRAM " \"$@\"\n");
    std::filesystem::permissions(folder_.path() / "touchstone/touchstone",
                                 std::filesystem::perms::owner_all);
  }
  // Changes the library.
  void edit(const std::string& from, const std::string& to) {
    std::string text = folder_.read("new/spheres.c");
    ASSERT_NE(text.find(from), std::string::npos);
    base::replace_all(text, from, to);
    folder_.write("new/spheres.c", text);
  }
  // Runs the steps, and returns their statuses.
  std::vector<int> statuses() {
    folder_.write("summary.md", "");
    std::vector<int> all;
    text_.clear();
    for (const std::string& step : steps_of_gate()) {
      folder_.write("step.sh", step);
      const Ran ran = run_shell("cd " + folder_.path().string() +
                                " && GITHUB_STEP_SUMMARY=summary.md sh -e step.sh");
      all.push_back(ran.status);
      text_ += ran.text;
    }
    return all;
  }
  std::string text_;
};

TEST_F(Gate, IsGreenAndTurnsRed) {
  if (run_shell("command -v valgrind").status != 0) GTEST_SKIP() << "valgrind is not installed";
  EXPECT_THAT(statuses(), testing::ElementsAre(0, 0, 0)) << text_;
  EXPECT_THAT(folder_.read("summary.md"),
              AllOf(HasSubstr("### Answers: passed"), HasSubstr("### Instructions: passed")));
  edit("apart - (ra + rb), n[0]", "apart - (ra + rb + 0.001), n[0]");
  EXPECT_THAT(statuses(), testing::ElementsAre(0, 1, 0)) << text_;
  EXPECT_THAT(folder_.read("summary.md"), HasSubstr("### Answers: FAILED"));
  edit("ra + rb + 0.001", "ra + rb");
  edit("  double ra, rb,", "  for (volatile int i = 0; i < 1000; ++i) {}\n    double ra, rb,");
  EXPECT_THAT(statuses(), testing::ElementsAre(0, 0, 1)) << text_;
  EXPECT_THAT(folder_.read("summary.md"), HasSubstr("### Instructions: FAILED"));
}

}  // namespace
}  // namespace touchstone
