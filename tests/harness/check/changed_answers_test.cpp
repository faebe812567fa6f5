// Tests which answers two checks give otherwise, on files written by hand.
#include "harness/check/changed_answers.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/base/error.h"
#include "harness/check/graded_answers.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::check {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A row of grades.csv; what it does not say is right.
struct Row {
  std::string algorithm = "lib@1";
  int index = 0;
  std::string answer = "separated", verdict = "right";
  double error = 0;     // of the distance, as a part of the scale
  double distance = 1;  // exact, metres
  std::string task = "distance";
};

class ChangedAnswers : public testing::Test {
 protected:
  void write(const std::string& name, const std::vector<Row>& rows, const std::string& seed = "1") {
    std::filesystem::create_directories(folder.path() / name);
    std::string text =
        "algorithm,scalar,group,regime,index,kind_a,kind_b,task,exact,exact_lower,exact_upper,"
        "answer,status,end_verdict,scale,end_margin,end_distance_error,end_depth_error\n";
    for (const Row& row : rows) {
      const bool is_silent = row.verdict == "silent_error";
      text += fmt::format("{},double,gap,gap-1,{},box,box,{},separated,{},{},{},{},{},2,{},{},\n",
                          row.algorithm, row.index, row.task, row.distance, row.distance,
                          row.answer, row.verdict == "crashed" ? "garbage" : "ok", row.verdict,
                          is_silent ? "1" : "", is_silent ? "" : fmt::format("{}", 2 * row.error));
    }
    folder.write(name + "/grades.csv", text);
    write_facts(name, seed);
  }
  void write_facts(const std::string& name, const std::string& seed = "1") {
    folder.write(name + "/machine.csv", "name,value\nmode,0\nseed," + seed + "\n");
  }
  void write_families(const std::string& name, int right, int cases = 10) {
    std::filesystem::create_directories(folder.path() / name);
    folder.write(name + "/families.csv",
                 fmt::format("family,group,algorithm,form,round,cases,right\n"
                             "rays-face,rays,ray lib@1 double closest,as drawn,0,{},{}\n",
                             cases, right));
    write_facts(name);
  }
  AnswerComparison compared() {
    return compare_answers(folder.path() / "a", folder.path() / "b", wrong_share);
  }
  std::string fault() {
    return input_fault([&] { compared(); });
  }
  std::vector<std::string> became() {
    std::vector<std::string> all;
    for (const VersionChange& one : compared().changes) all.push_back(one.became);
    return all;
  }

  TemporaryFolder folder;
};

TEST_F(ChangedAnswers, WhatIsTheSameIsNoChange) {
  write("a", {{}, {.index = 1, .verdict = "silent_error"}, {.index = 2, .error = 2e-5}});
  write("b", {{}, {.index = 1, .verdict = "silent_error"}, {.index = 2, .error = 3e-5}});
  const AnswerComparison same = compared();
  EXPECT_FALSE(same.has_regressed());
  EXPECT_TRUE(same.changes.empty());
  ASSERT_EQ(same.counts.size(), 1U);
  EXPECT_EQ(same.counts[0].compared, 3);
  EXPECT_EQ(same.counts[0].library, "lib");
}

TEST_F(ChangedAnswers, BecomeWrongRightAndLost) {
  write("a", {{.index = 0},
              {.index = 1},
              {.index = 2},
              {.index = 3},
              {.index = 4, .answer = "touching", .verdict = "silent_error"},
              {.index = 5, .answer = "unknown", .verdict = "honest_failure"},
              {.index = 6, .verdict = "crashed"}});
  write("b",
        {{.algorithm = "lib@2", .index = 0, .answer = "touching", .verdict = "silent_error"},
         {.algorithm = "lib@2", .index = 1, .error = 0.01},
         {.algorithm = "lib@2", .index = 2, .verdict = "crashed"},
         {.algorithm = "lib@2", .index = 3, .answer = "unknown", .verdict = "honest_failure"},
         {.algorithm = "lib@2", .index = 4},
         {.algorithm = "lib@2", .index = 5},
         {.algorithm = "lib@2", .index = 6, .answer = "unknown", .verdict = "honest_failure"}});
  EXPECT_THAT(became(), ElementsAre("wrong", "wrong", "wrong", "lost", "right", "right", "other"));
  const AnswerComparison all = compared();
  EXPECT_TRUE(all.has_regressed());
  EXPECT_EQ(all.counts[0].version_a, "1");
  EXPECT_EQ(all.counts[0].version_b, "2");
  EXPECT_EQ(all.changes[2].after, "garbage");
  EXPECT_DOUBLE_EQ(all.changes[1].error_after, 0.01);
  // A looser limit forgives the distance, and not the side.
  const AnswerComparison loose = compare_answers(folder.path() / "a", folder.path() / "b", 0.1);
  EXPECT_EQ(loose.counts[0].wrong, 2);
}

TEST_F(ChangedAnswers, WhatIsNoLongerAskedIsLost) {
  write("a", {{.index = 0}, {.index = 1}});
  write("b", {{.index = 0}, {.index = 2}});
  const AnswerComparison less = compared();
  EXPECT_TRUE(less.has_regressed());
  ASSERT_EQ(less.changes.size(), 1U);
  EXPECT_EQ(less.changes[0].after, "not asked");
  EXPECT_THAT(less.remarks, ElementsAre("1 answers of lib are in B alone"));
}

TEST_F(ChangedAnswers, OfOtherKindsAreCounts) {
  write_families("a", 9);
  write_families("b", 9);
  EXPECT_FALSE(compared().has_regressed());
  write_families("b", 10);
  EXPECT_FALSE(compared().has_regressed());
  EXPECT_THAT(became(), ElementsAre("right"));
  write_families("b", 7);
  EXPECT_TRUE(compared().has_regressed());
  EXPECT_EQ(compared().counts[0].wrong, 2);
  EXPECT_EQ(compared().changes[0].after, "7 of 10 right");
  write_families("b", 7, 8);
  EXPECT_THAT(fault(), HasSubstr("b/families.csv:2: cases: found 8; expected 10"));
}

TEST_F(ChangedAnswers, OfOtherCasesAreRefused) {
  write("a", {{}});
  write("b", {{}}, "2");
  EXPECT_THAT(fault(), HasSubstr("b/machine.csv: seed: found '2'; expected '1'"));
  write("b", {{.distance = 3}});
  EXPECT_THAT(fault(), HasSubstr("b/grades.csv:2: found gap-1/0, box and box, 3 to 3 m apart"));
}

TEST_F(ChangedAnswers, FaultsHaveTheirPlace) {
  write("a", {{}});
  EXPECT_THAT(fault(), HasSubstr("b: has neither grades.csv nor families.csv"));
  write("b", {{.algorithm = "other@1"}});
  EXPECT_THAT(fault(), HasSubstr("b/grades.csv: has no answers of lib"));
  write("b", {{}, {.algorithm = "lib@2"}});
  EXPECT_THAT(fault(), HasSubstr("b/grades.csv:3: found version 2 of lib beside 1"));
  write("b", {});
  EXPECT_THAT(fault(), HasSubstr("has no answers of lib"));
  folder.write("b/grades.csv", "algorithm,scalar\nlib@1,double\n");
  EXPECT_THAT(fault(), HasSubstr("b/grades.csv:"));
  write("a", {});
  write("b", {});
  EXPECT_THAT(fault(), HasSubstr("b/grades.csv: has no answers"));
}

TEST(GradedAnswers, NamesHaveVersions) {
  using Names = std::pair<std::string, std::string>;
  EXPECT_EQ(library_and_version("mujoco@3.9.0"), Names("mujoco", "3.9.0"));
  EXPECT_EQ(library_and_version("ray bvh@0.9 double closest"),
            Names("ray bvh double closest", "0.9"));
  EXPECT_EQ(library_and_version("gjk"), Names("gjk", ""));
}

}  // namespace
}  // namespace touchstone::check
