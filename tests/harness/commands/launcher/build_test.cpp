// Tests of what the programs say that they were built from, and that they refuse each other if it differs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "tests/harness/commands/program.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A folder with sources, and the file that the build writes of them.
class WrittenBuild : public testing::Test {
 protected:
  WrittenBuild() {
    fs::create_directories(folder_.path() / "s/algorithms");
    fs::create_directories(folder_.path() / "s/harness/base");
    folder_.write("s/algorithms/a.cpp", "1");
    folder_.write("s/harness/base/b.h", "2");
    folder_.write("s/CMakeLists.txt", "3");
    folder_.write("s/CMakePresets.json", "4");
    folder_.write("facts", "flags");
  }

  Ran write(const std::string& option = "") const {
    return in_folder("cmake -D SOURCE=$PWD/s -D FACTS=$PWD/facts -D OUT=$PWD/out.cpp " + option +
                     " -P " + project_folder + "/harness/record/write_build.cmake");
  }
  Ran in_folder(const std::string& command) const {
    return run_shell("cd " + folder_.path().string() +
                     " && export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null && " +
                     command);
  }
  Ran commit(const std::string& folder) const {
    return in_folder(
        "cd " + folder +
        " && git init -q . && git add . && git -c user.name=x -c user.email=x@y commit "
        "-q --allow-empty -m x && git rev-parse HEAD");
  }

  struct Facts {
    std::string commit, tree, sources, id;
  };
  Facts facts() const {
    const Ran ran = write();
    EXPECT_EQ(ran.status, 0) << ran.text;
    const std::string text = folder_.read("out.cpp");
    std::smatch found;
    EXPECT_TRUE(
        std::regex_search(text, found, std::regex(R"re(\{"(.*)", "(.*)", "(.*)", "(.*)"\})re")))
        << text;
    return {found[1], found[2], found[3], found[4]};
  }

  TemporaryFolder folder_;
};

TEST_F(WrittenBuild, NamesTheSources) {
  const Facts one = facts();
  EXPECT_TRUE(std::regex_match(one.sources, std::regex("[0-9a-f]{16}"))) << one.sources;
  folder_.write("s/harness/README.md", "page");
  EXPECT_EQ(facts().sources, one.sources);
  folder_.write("s/harness/base/b.h", "22");
  const Facts changed = facts();
  EXPECT_NE(changed.sources, one.sources);
  EXPECT_NE(changed.id, one.id);
  folder_.write("s/harness/base/b.h", "2");
  EXPECT_EQ(facts().sources, one.sources);
  folder_.write("s/harness/base/c.h", "");
  EXPECT_NE(facts().sources, one.sources);
  fs::remove(folder_.path() / "s/harness/base/c.h");
  folder_.write("facts", "other flags");
  EXPECT_EQ(facts().sources, one.sources);
  EXPECT_NE(facts().id, one.id);
}

TEST_F(WrittenBuild, NamesTheCommitOfItsOwnRepositoryAlone) {
  EXPECT_EQ(facts().commit, "unknown");
  EXPECT_EQ(facts().tree, "unknown");
  if (in_folder("git --version").status != 0) GTEST_SKIP() << "git is not installed";
  ASSERT_EQ(commit(".").status, 0);  // something else's
  EXPECT_EQ(facts().commit, "unknown");
  const Ran own = commit("s");
  ASSERT_EQ(own.status, 0) << own.text;
  const Facts clean = facts();
  EXPECT_EQ(clean.commit + "\n", own.text);
  EXPECT_EQ(clean.tree, "clean");
  folder_.write("s/README.md", "a page");
  EXPECT_EQ(facts().tree, "clean");
  folder_.write("s/algorithms/a.cpp", "11");
  EXPECT_EQ(facts().tree, "changed");
  folder_.write("s/algorithms/a.cpp", "1");
  folder_.write("s/algorithms/new.cpp", "");
  EXPECT_EQ(facts().tree, "changed");
  fs::remove(folder_.path() / "s/algorithms/new.cpp");
  const Ran later = commit("s");
  EXPECT_EQ(facts().commit + "\n", later.text);
  EXPECT_NE(later.text, own.text);
  EXPECT_EQ(facts().id, clean.id);
}

TEST_F(WrittenBuild, IsWrittenOnlyIfItChanges) {
  ASSERT_EQ(write().status, 0);
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(folder_.path() / "out.cpp", long_ago);
  ASSERT_EQ(write().status, 0);
  EXPECT_LT(fs::last_write_time(folder_.path() / "out.cpp"), long_ago + std::chrono::minutes(1));
  EXPECT_EQ(write("-D CHECK=1").status, 0);
  folder_.write("s/algorithms/a.cpp", "edited while it is compiled");
  const Ran ran = write("-D CHECK=1");
  EXPECT_NE(ran.status, 0);
  EXPECT_THAT(ran.text, HasSubstr("changed while they were compiled"));
}

// The two executables.
class TwoPrograms : public testing::Test {
 protected:
  static fs::path more() { return fs::path(TOUCHSTONE_PROGRAM).parent_path() / "touchstone_more"; }
  TemporaryFolder folder_;
};

TEST_F(TwoPrograms, OfOneBuildWorkTogether) {
  const Ran ran = run_program("check --help");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("--seed"));
}

TEST_F(TwoPrograms, OfTwoBuildsRefuseEachOther) {
  const Ran ran = run_shell(more().string() + " --of-build=0123456789abcdef check --help");
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.text, HasSubstr("touchstone_more: was built from other sources than the program "
                                  "that runs it (build "));
  EXPECT_THAT(ran.text, HasSubstr("and not 0123456789abcdef); expected both of one build"));
}

// A program that is older than the word would not know it, and refuse.
TEST_F(TwoPrograms, TheFirstNamesItsBuild) {
  fs::copy(TOUCHSTONE_PROGRAM, folder_.path() / "touchstone");
  const std::string line = (folder_.path() / "touchstone").string() + " check --seed '1 2'";
  const Ran alone = run_shell(line);
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.text, HasSubstr("touchstone_more: cannot be run (No such file or directory); "
                                    "expected the second program of this build"));
  folder_.write("touchstone_more", "#!/bin/sh\nprintf '%s|' \"$@\"\n");
  fs::permissions(folder_.path() / "touchstone_more", fs::perms::owner_all);
  const Ran ran = run_shell(line);
  EXPECT_TRUE(
      std::regex_match(ran.text, std::regex(R"(--of-build=[0-9a-f]{16}\|check\|--seed\|1 2\|)")))
      << ran.text;
}

// The launcher builds the second program before it runs it.
TEST_F(TwoPrograms, TheFirstHandsOverThroughTheLauncher) {
  folder_.write("launcher", "#!/bin/sh\nprintf '%s|' \"$@\" \"$TOUCHSTONE_LAUNCHER\"\n");
  fs::permissions(folder_.path() / "launcher", fs::perms::owner_all);
  const std::string launcher =
      "TOUCHSTONE_LAUNCHER=" + (folder_.path() / "launcher").string() + " ";
  for (const std::string words : {"check|--seed|1", "run|file.toml", "run|--scene|a.toml",
                                  "run|--report", "run|--plan|d|--shard|1"}) {
    std::string line = words;
    std::ranges::replace(line, '|', ' ');
    EXPECT_EQ(run_shell(launcher + TOUCHSTONE_PROGRAM + " " + line).text, "--more|" + words + "||");
  }
}

// The first program lists less than the second, but all that the standard comparison measures.
TEST_F(TwoPrograms, PlanTheSameStandardComparison) {
  const auto plan = [](const std::string& program) {
    const Ran ran = run_shell(program + " run --quick --dry-run");
    EXPECT_EQ(ran.status, 0) << ran.text;
    std::istringstream lines(ran.text);
    std::string sets;
    for (std::string line; std::getline(lines, line);) {
      if (line.find(" s for the ") == std::string::npos && !line.starts_with("  check: about"))
        sets += line + "\n";
    }
    return sets;
  };
  const std::string sets = plan(TOUCHSTONE_PROGRAM);
  EXPECT_THAT(sets, HasSubstr("gjk-lanes"));
  EXPECT_EQ(sets, plan(more().string()));
}

}  // namespace
}  // namespace touchstone
