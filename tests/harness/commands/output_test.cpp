// Tests of what the commands print, of signals, and of names that would leave their folders.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "tests/harness/commands/program.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::Not;

class Output : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  // Plans a soak of one shard.
  void plan(const std::string& out) {
    folder.write("soak.toml", "[soak]\npairs = 1000\nregimes = 'gap-1e-3'\nnarrow = 'gjk'\n");
    const Ran ran = run_program("shards plan " + path("soak.toml") + " --shards 1 --out " + out);
    EXPECT_EQ(ran.status, 0) << ran.text;
    planned = ran.text;
  }

  TemporaryFolder folder;
  std::string planned;
};

TEST_F(Output, AFullDiskIsNoticed) {
  plan(path("plan"));
  folder.write("c.jsonl",
               R"({"id":"x","a":{"shape":{"type":"sphere","radius":1},"translation":[0,0,0],)"
               R"("quaternion_wxyz":[1,0,0,0]},"b":{"shape":{"type":"sphere","radius":1},)"
               R"("translation":[3,0,0],"quaternion_wxyz":[1,0,0,0]}})"
               "\n");
  for (const std::string& command :
       {std::string("list"), "shards status " + path("plan"), std::string("--help"),
        "query " + path("c.jsonl") + " --narrow gjk --task distance --out " + path("o.csv"),
        "show --tables " + std::string(project_folder) + "/results/reference --out " +
            path("tables")}) {
    const Ran ran = run_shell("{ " TOUCHSTONE_PROGRAM " " + command + " >/dev/full; }");
    EXPECT_EQ(ran.status, 2) << command;
    EXPECT_THAT(ran.text, HasSubstr("No space left on device")) << command;
  }
}

TEST_F(Output, ControlCharactersAreEscaped) {
  plan(path("plan"));
  std::string facts = folder.read("plan/plan.csv");
  folder.write("plan/plan.csv", facts.replace(facts.find("name,soak"), 9, "name,\033]0;x\007"));
  Ran ran = run_program("shards status " + path("plan"));
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_THAT(ran.text, Not(HasSubstr("\033")));
  ran = run_program("shards status '" + path("\033]0;title\007") + "'");
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("\\x1b]0;title\\x07"));
  EXPECT_THAT(ran.text, Not(HasSubstr("\033")));
}

TEST_F(Output, CommandsToCopyAreQuoted) {
  plan("'" + path("two words") + "'");
  const std::string word = "'" + path("two words") + "'";
  EXPECT_THAT(planned, HasSubstr("touchstone shards status " + word + "\n"));
  EXPECT_THAT(planned, HasSubstr("touchstone shards merge " + word + " --out"));
  EXPECT_THAT(planned, HasSubstr("'" + path("two words") + "/slurm.sh'\n"));
  EXPECT_EQ(run_program("shards status " + word).status, 0);
}

TEST_F(Output, ANameThatLeavesTheResultsIsRefused) {
  const std::string name = "name = '../../../../../../../../" + path("away").substr(1) + "'\n";
  const std::string soak = "[soak]\npairs = 1000\nregimes = 'gap-1e-3'\nnarrow = 'gjk'\n";
  const std::string check = "[check]\ncases = 1\nregimes = 'gap-1e-3'\nnarrow = 'gjk'\n";
  folder.write("s.toml", "[[body]]\nshape = 'sphere'\nradius = 1.0\n");
  const std::string trade = "[trade]\nscene = 's.toml'\n";
  const std::string cells = "[[group]]\nkind = 'rays'\n";
  const std::string run = "scenes = 's.toml'\nbroad = 'naive'\n";
  for (const std::string& work : {soak, check, trade, cells, run}) {
    const std::string file = folder.write("w.toml", name + work).string();
    const Ran ran = run_program("run " + file);
    EXPECT_EQ(ran.status, 2) << work << ran.text;
    EXPECT_THAT(ran.text, HasSubstr("w.toml:1: name: found '../")) << work;
    EXPECT_THAT(ran.text, HasSubstr("expected a name for a folder")) << work;
  }
  for (const std::string& bad : {std::string("/tmp/x"), std::string(".."), std::string(101, 'x'),
                                 std::string("\\u001b]0;x")}) {
    folder.write("w.toml", "name = \"" + bad + "\"\n" + soak);
    EXPECT_EQ(run_program("run " + path("w.toml")).status, 2) << bad;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "away"));
}

TEST_F(Output, FoldersAreLookedAtBeforeTheWork) {
  folder.write("s.toml", "generator = 'uniform'\ncount = 100\n");
  folder.write("file", "mine");
  const Ran ran =
      run_program("advise --front " + path("s.toml") + " --seconds 100000 --out " + path("file"));
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("is no folder"));
  EXPECT_EQ(folder.read("file"), "mine");
}

// Both signals end the work alike, and it can be resumed.
TEST_F(Output, SignalsEndCasesWhereNothingIsLost) {
  folder.write("s.toml", "generator = 'uniform'\ncount = 50\nframes = 2\n");
  const std::vector<std::string> works = {
      "run --scene " + path("s.toml") +
          " --broad naive,uniform-grid --narrow none --seconds 100000",
      "check --narrow gjk --broad none --group gap,depth --cases 20 --seconds 100000",
      "check --narrow gjk --count 100000000", "check --axes --narrow gjk --cases 100"};
  for (const std::string& work : works) {
    for (const int signal : {SIGINT, SIGTERM}) {
      const std::string name =
          "out-" + std::to_string(&work - works.data()) + "-" + std::to_string(signal);
      const std::string command = work + " --threads 1 --out " + path(name);
      const pid_t child = fork();
      if (child == 0) {
        const int said = open(path("said").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(said, STDOUT_FILENO);
        dup2(said, STDERR_FILENO);
        execl("/bin/sh", "sh", "-c", ("exec " TOUCHSTONE_PROGRAM " " + command).c_str(), nullptr);
        _exit(127);
      }
      // A slow machine may see it only when more than one is done.
      const auto is_one_done = [&] {
        const std::string progress = folder.read(name + "/progress.csv");
        const auto at = progress.find("units,");
        return at != std::string::npos && progress[at + 6] >= '1' && progress[at + 6] <= '9';
      };
      while (!is_one_done() && waitpid(child, nullptr, WNOHANG) == 0) usleep(1000);
      kill(child, signal);
      int status = 0;
      ASSERT_EQ(waitpid(child, &status, 0), child) << folder.read("said");
      EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 2) << command << status;
      EXPECT_THAT(folder.read("said"),
                  HasSubstr("touchstone: interrupted; what was done until then is kept"));
      EXPECT_THAT(folder.read(name + "/machine.csv"), HasSubstr("finished,no"));
      if (!work.starts_with("run")) continue;
      EXPECT_THAT(folder.read("said"),
                  testing::ContainsRegex("Stopped in the (check|samples) of block 1 of 1, s, 50 "
                                         "bodies.*Go on: touchstone run --scene .* --resume\n"));
      EXPECT_THAT(run_program("show " + path(name)).text, HasSubstr("Stopped in the "));
    }
  }
}

}  // namespace
}  // namespace touchstone
