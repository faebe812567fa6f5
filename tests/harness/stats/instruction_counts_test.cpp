// Tests comparisons of counted instructions.
#include "harness/stats/instruction_counts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::stats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct InstructionCounts : testing::Test {
  TemporaryFolder folder;

  std::string csv(const std::string& name, const std::string& rows) const {
    return folder.write(name, "benchmark,queries,instructions\n" + rows).string();
  }
  std::string callgrind(const std::string& name, const std::string& sum) const {
    return folder
        .write(name,
               "# callgrind format\nversion: 1\ncmd:  ./" + name + "\npart: 1\nevents: Ir\n" + sum)
        .string();
  }
};

TEST_F(InstructionCounts, BeyondTheThresholdAreListedWorstFirst) {
  const std::string a = csv("a.csv", "x,256,100\ny,256,100\nz,256,100\n");
  const std::string b = csv("b.csv", "x,256,101\ny,256,102\nz,256,150\nnew,256,1\n");
  const InstructionComparison both = compare_instructions(a, b);
  std::vector<std::string> names;
  for (const InstructionCount& one : both.slower(0.015)) names.push_back(one.benchmark);
  EXPECT_THAT(names, ElementsAre("z", "y"));
  EXPECT_THAT(both.only_in_b, ElementsAre("new"));
  EXPECT_TRUE(compare_instructions(a, a).slower(1e-9).empty());
}

TEST_F(InstructionCounts, OfCallgrindAreOfAProgram) {
  const InstructionComparison both = compare_instructions(callgrind("old", "summary: 1000\n"),
                                                          callgrind("new", "summary: 1021\n"));
  ASSERT_EQ(both.counts.size(), 1U);
  EXPECT_DOUBLE_EQ(both.counts[0].ratio(), 1.021);
}

TEST_F(InstructionCounts, FaultsHaveTheirPlace) {
  const std::string a = csv("a.csv", "x,256,100\n");
  const auto fault = [&](const std::string& b) {
    return input_fault([&] { compare_instructions(a, b); });
  };
  EXPECT_THAT(fault(csv("b.csv", "y,256,100\n")), HasSubstr("b.csv: has no count of 'x'"));
  EXPECT_THAT(fault(csv("b.csv", "x,256,nan\n")), HasSubstr("b.csv:2: instructions: found nan"));
  EXPECT_THAT(fault(csv("b.csv", "x,256,1\nx,256,1\n")),
              HasSubstr("b.csv:3: benchmark: found 'x'"));
  EXPECT_THAT(fault(csv("b.csv", "")), HasSubstr("b.csv: has no count; expected one"));
  EXPECT_THAT(fault(callgrind("b", "")), HasSubstr("no file of Callgrind's"));
  EXPECT_THAT(fault(folder.write("b.csv", "x\n").string()), HasSubstr("has no counts"));
  EXPECT_THAT(fault((folder.path() / "none").string()), HasSubstr("none: has no counts"));
}

}  // namespace
}  // namespace touchstone::stats
