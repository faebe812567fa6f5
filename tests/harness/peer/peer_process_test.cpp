// Tests of programs behind pipes.
#include "harness/peer/peer_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <fstream>
#include <optional>

#include "harness/process/child_process.h"
#include "tests/harness/process/no_child_is_left.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone::peer {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string hostile(const std::string& fault) {
  return "python3 " + std::string(project_folder) + "/tests/harness/peer/hostile.py " + fault +
         " 0";
}

const std::string question = R"({"id":"x","a":{"shape":{"radius":1},"translation":[0,0,0]},)"
                             R"("b":{"shape":{"radius":1},"translation":[3,0,0]}})"
                             "\n";

// How a program with this fault ends when it is asked; nothing if it answers.
std::optional<std::string> ending_of(const std::string& fault, const ProgramLimits& limits = {}) {
  PeerProcess process({hostile(fault), ""}, limits);
  process.exchange("hello\n", 1);
  try {
    process.exchange(question, 1, 60);
    return std::nullopt;
  } catch (const ProgramEnded& error) {
    return error.what();
  }
}

TEST(PeerProcess, ExchangesMoreThanPipesHold) {
  PeerProcess process({"cat", ""});
  EXPECT_THAT(process.exchange("a\nb\n", 2), ElementsAre("a", "b"));
  std::string text;
  constexpr std::size_t count = 20'000;
  for (std::size_t i = 0; i < count; ++i) text += std::string(100, 'x') + std::to_string(i) + "\n";
  const std::vector<std::string> lines = process.exchange(text, count);
  ASSERT_EQ(lines.size(), count);
  EXPECT_EQ(lines.back(), std::string(100, 'x') + "19999");
}

TEST(PeerProcess, RunsInItsFolderAndTakesWholeShellLines) {
  const TemporaryFolder folder;
  PeerProcess process({"pwd && echo two; cat", folder.path()});
  EXPECT_THAT(process.exchange("", 2),
              ElementsAre(std::filesystem::canonical(folder.path()).string(), "two"));
}

TEST(PeerProcess, SaysHowAProgramEnded) {
  EXPECT_EQ(ending_of("none"), std::nullopt);
  EXPECT_EQ(ending_of("exit"), "the program left with status 3");
  EXPECT_EQ(ending_of("signal"), "the program was killed by signal 11 (Segmentation fault)");
  EXPECT_EQ(ending_of("closed-output"), "the program closed its output");
  PeerProcess absent({"/nowhere/at-all", ""});
  EXPECT_THROW(absent.exchange("", 1), ProgramEnded);
  expect_no_child_is_left();
}

TEST(PeerProcess, LimitsMemoryAndLines) {
  EXPECT_EQ(ending_of("memory", {.memory = std::size_t{100} << 20}),
            "the program took more than 100 MiB of memory");
  EXPECT_THROW(ending_of("endless-line", {.line = 100'000}), process::Garbage);
  expect_no_child_is_left();
}

TEST(PeerProcess, GivesUpAfterItsTime) {
  PeerProcess process({hostile("silent-start"), ""});
  EXPECT_THROW(process.exchange("hello\n", 1, 0.2), ProgramEnded);
  EXPECT_THROW(process.exchange("hello\n", 1), ProgramEnded) << "it is over";
}

// Asks a program that starts others, and returns whether any lives when this process goes on.
TEST(PeerProcess, EndsAllThatAProgramStarted) {
  const TemporaryFolder folder;
  const std::string pids = (folder.path() / "pids").string();
  {
    // One is in the group of the program, one in a session of its own.
    PeerProcess process({"sleep 600 & echo $! > " + pids + "; setsid sleep 600 & echo $! >> " +
                             pids + "; echo started; cat",
                         ""});
    process.exchange("", 1);
  }
  std::ifstream file(pids);
  int count = 0;
  for (pid_t pid = 0; file >> pid; ++count) EXPECT_EQ(kill(pid, 0), -1) << pid;
  EXPECT_EQ(count, 2);
  expect_no_child_is_left();
}

TEST(PeerProcess, ABombOfProcessesEndsWithIt) {
  {
    PeerProcess process({hostile("fork-bomb"), ""});
    process.exchange("hello\n", 1);
    EXPECT_EQ(process.exchange(question, 1).size(), 1U);
  }
  expect_no_child_is_left();
}

}  // namespace
}  // namespace touchstone::peer
