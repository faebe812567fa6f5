// Tests of the launcher, with stubs for cmake, ninja, apt and the programs that ninja makes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/harness/commands/program.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

struct CommandRow {
  std::string program, name, heading;
};

const std::vector<CommandRow> command_table = {
#define TOUCHSTONE_COMMAND(program, name, takes, heading, about) {#program, #name, heading},
#include "harness/commands/commands.inl"
};

// The commands within others, such as "scene draw".
const std::vector<std::string> nested = {
#define TOUCHSTONE_NESTED(command, name, takes, about) #command " " #name,
#include "harness/commands/commands.inl"
};

const std::vector<std::string> old_names = {
#define TOUCHSTONE_RENAMED(name, line) #name,
#include "harness/commands/commands.inl"
};

// What a line of the launcher had built, and what it ran then.
struct Launched {
  int status = -1;
  std::string text;
  std::set<std::string> asked;  // targets of ninja
  std::string ran;              // the line of the program that was run at last
};

class Launcher : public testing::Test {
 protected:
  Launcher() {
    make_folders(
        {"bin", "tree/harness/commands", "tree/plots/page", "tree/algorithms", "tree/tests"});
    fs::copy(project("tests/CMakeLists.txt"), path("tree/tests/CMakeLists.txt"));
    fs::copy(project("touchstone"), path("tree/touchstone"));
    fs::copy(project("harness/commands/commands.inl"), path("tree/harness/commands/commands.inl"));
    fs::create_directory_symlink(project("datasets"), path("tree/datasets"));
    for (const std::string name : {"node", "npm", "apt-get"}) write_program("bin/" + name, "");
    write_program("bin/sudo", R"("$@")");
    write_program("bin/ctest", R"(echo "ctest $*" >>"$LOG/ran")");
    write_program("bin/cmake", "mkdir -p build/release && touch build/release/build.ninja");
    // Only what it is asked for is there when it has ended.
    write_program("bin/ninja", R"(
      folder=$2/harness
      shift 4  # -C FOLDER -j PROCESSORS
      rm -rf "$folder" && mkdir -p "$folder"
      printf '%s\n' "$@" >>"$LOG/asked"
      for target; do
        printf '#!/bin/sh\necho "%s $*" >>"$LOG/ran"\n' "$target" >"$folder/$target"
        chmod +x "$folder/$target"
      done)");
    write_program("tree/plots/python", R"([[ $1 == -c ]] || echo "python $*" | tee -a "$LOG/ran")");
    write_program("tree/plots/page/make", R"(mkdir -p "${1%/*}" && touch "$1")");
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  static std::string project(const std::string& name) {
    return std::string(project_folder) + "/" + name;
  }
  void make_folders(const std::vector<std::string>& names) const {
    for (const std::string& name : names) fs::create_directories(path(name));
  }
  void write_program(const std::string& name, const std::string& text) const {
    folder_.write(name, "#!/bin/bash\n" + text + "\n");
    fs::permissions(path(name), fs::perms::owner_all);
  }

  // Runs the launcher; with `typed`, on a terminal where somebody answers so.
  Launched launch(const std::string& words, const std::string& typed = "") const {
    for (const char* name : {"asked", "ran"}) fs::remove(folder_.path() / name);
    std::string command = "./touchstone " + words;
    if (!typed.empty())
      command = "printf '" + typed + "' | script -qec '" + command + "' /dev/null";
    const Ran ran =
        run_shell("cd " + path("tree") + " && export LOG=" + path("") + " PATH=" + path("bin") +
                  ":$PATH TOUCHSTONE_PRESET=release && " + command);
    Launched launched{ran.status, ran.text, {}, {}};
    std::istringstream asked(folder_.read("asked"));
    for (std::string target; std::getline(asked, target);) launched.asked.insert(target);
    std::istringstream lines(folder_.read("ran"));
    for (std::string line; std::getline(lines, line);) launched.ran = line;
    return launched;
  }

  // Expects that the line is done by a program that was built for it.
  void expect_built(const std::string& words, const std::set<std::string>& programs) const {
    const Launched launched = launch(words);
    EXPECT_EQ(launched.status, 0) << words << "\n" << launched.text;
    EXPECT_TRUE(std::ranges::includes(launched.asked, programs))
        << words << " had built only " << testing::PrintToString(launched.asked);
    EXPECT_NE(launched.ran, "") << words;
  }

  TemporaryFolder folder_;
};

const std::set<std::string> first = {"touchstone"};
const std::set<std::string> both = {"touchstone", "touchstone_more"};

// The lines of the table of commands in README.md.
std::vector<std::string> lines_of_readme() {
  std::vector<std::string> lines;
  std::ifstream file(std::string(project_folder) + "/README.md");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("| `")) continue;
    std::string cell = line.substr(2, line.find('|', 2) - 2);
    for (std::smatch found; std::regex_search(cell, found, std::regex("`([a-z][^`/]*)`"));) {
      std::string words = found[1];
      std::erase_if(words, [](char c) { return c == '[' || c == ']'; });
      lines.push_back(words);
      cell = found.suffix();
    }
  }
  return lines;
}

TEST_F(Launcher, BuildsWhatEveryCommandOfTheReadmeRuns) {
  std::map<std::string, std::string> program;
  for (const CommandRow& row : command_table) program[row.name] = row.program;
  std::vector<std::string> lines = lines_of_readme();
  lines.emplace_back("test");
  std::set<std::string> seen;
  for (const std::string& line : lines) {
    const std::string name = line.substr(0, line.find(' '));
    ASSERT_TRUE(program.contains(name)) << "'" << line << "' of README.md is not in commands.inl";
    seen.insert(name);
    if (name == "setup") continue;
    std::set<std::string> programs = program[name] == "touchstone_more" ? both : first;
    if (name == "test") programs = {"all"};
    if (name == "bench") programs = {"touchstone_bench"};
    expect_built(line, programs);
  }
  for (const CommandRow& row : command_table)
    EXPECT_TRUE(seen.contains(row.name)) << row.name << " of commands.inl";
}

TEST_F(Launcher, BuildsTheSecondProgramWhereTheFirstHandsOver) {
  for (const std::string& words : nested) expect_built(words + " x", both);
  expect_built("check --axes", both);
  const Launched more = launch("--more --isa avx2 run 'a file.toml' --report");
  EXPECT_EQ(more.asked, both);
  EXPECT_EQ(more.ran, "touchstone_more --isa avx2 run a file.toml --report");
  // The standard comparison does not wait for it, and its program knows whom to ask for it.
  const std::string stub = folder_.read("bin/ninja");
  write_program("bin/ninja", stub + R"(
    echo 'echo "$TOUCHSTONE_LAUNCHER"' >>"$folder/touchstone")");
  const Launched standard = launch("run --quick");
  EXPECT_EQ(standard.asked, first);
  EXPECT_EQ(standard.ran, "touchstone run --quick");
  EXPECT_THAT(standard.text, HasSubstr(path("tree/touchstone") + "\n"));
}

TEST_F(Launcher, LetsTheFirstProgramPrintTheVersion) {
  const Launched version = launch("--version");
  EXPECT_EQ(version.asked, first);
  EXPECT_EQ(version.ran, "touchstone --version");
}

TEST_F(Launcher, HelpsWithoutBuilding) {
  const std::string line =
      "cd / && LOG=" + path("") + " PATH=/usr/bin:/bin " + path("tree/touchstone") + " ";
  const Ran ran = run_shell(line + "--help");
  EXPECT_EQ(ran.status, 0);
  std::set<std::string> headings;
  for (const CommandRow& row : command_table) {
    headings.insert(row.heading);
    EXPECT_THAT(ran.text, HasSubstr("\n" + row.heading + "\n"));
    EXPECT_THAT(ran.text, HasSubstr("\n  " + row.name + " "));
    const Ran of_one = run_shell(line + row.name + " --help");
    EXPECT_EQ(of_one.status, 0) << of_one.text;
    EXPECT_NE(of_one.text, "") << row.name;
  }
  for (const std::string& words : nested) {
    const Ran of_one = run_shell(line + words + " --help");
    EXPECT_EQ(of_one.status, 0) << of_one.text;
    EXPECT_THAT(of_one.text, HasSubstr("Usage: ./touchstone " + words + " ")) << words;
  }
  EXPECT_EQ(headings.size(), 5u);
  EXPECT_FALSE(fs::exists(path("tree/build")));
}

TEST_F(Launcher, RefusesUnknownCommandsBeforeItBuilds) {
  const auto refuse = [&](const std::string& words, const std::string& text) {
    const Launched launched = launch(words);
    EXPECT_EQ(launched.status, 2) << words;
    EXPECT_THAT(launched.text, HasSubstr(text)) << words;
  };
  refuse("runn", "touchstone: no command 'runn'; did you mean run?\n");
  refuse("--isa avx2 qeury x", "no command 'qeury'; did you mean query?");
  refuse("xyzzy", "no command 'xyzzy'; expected one of: run compare ");
  refuse("", "found no command");
  refuse("scene drw x", "no command 'drw' of `scene`; did you mean draw?");
  refuse("shards xyzzy", "no command 'xyzzy' of `shards`; expected one of: plan status merge\n");
  refuse("scene --isa avx2", "`scene` takes a command of its own; expected one of: draw ");
  refuse("test harness/none",
         "no room 'harness/none' has tests; expected one of: algorithms/core ");
  for (const std::string& name : old_names) refuse(name + " x", "`" + name + "` is now `");
  refuse("--isa avx2 test", "found '--isa' before `test`");
  std::ofstream(path("tree/harness/commands/commands.inl"), std::ios::app)
      << "TOUCHSTONE_RENAMED(asks, \"query FILE --in MESH\")\n";
  refuse("asks x", "touchstone: `asks` is now `./touchstone query FILE --in MESH`\n");
  std::ofstream(path("tree/harness/commands/commands.inl"), std::ios::app)
      << "TOUCHSTONE_COMMAND(touchstone, two words)\n";
  refuse("run", "found 'TOUCHSTONE_COMMAND(touchstone, two words)'; expected a row");
  EXPECT_FALSE(fs::exists(path("tree/build")));
}

// Launcher and program say the same, but for the path of the launcher.
TEST_F(Launcher, SaysTheNewLineOfAnOldOne) {
  const std::vector<std::pair<std::string, std::string>> lines = {
      {"stress --axes gap --cases 2", "check --axes gap --cases 2"},
      {"stress --axes=gap", "check --axes=gap"},
      {"stress --cases 2", "check --axes --cases 2"},
      {"soak --narrow gjk --pairs 1000", "check --narrow gjk --count 1000"},
      {"soak --pairs=1000", "check --count=1000"},
      {"soak", "check --count"},
      {"--isa avx2 trade 'my scene.toml' --motion", "advise 'my scene.toml' --motion --front"},
      {"plot results --out it\\'s", "show results --out 'it'\\''s' --figures"},
      {"draw a.toml --out a.png", "scene draw a.toml --out a.png"},
      {"merge d --partial", "shards merge d --partial"},
      {"tables", "show RESULTS --tables`; without RESULTS or with --check it is `reproduce"}};
  for (const auto& [old, line] : lines) {
    const std::string said = "` is now `./touchstone " + line + "`\n";
    EXPECT_THAT(launch(old).text, HasSubstr(said)) << old;
    const Ran ran = run_program(old);
    EXPECT_EQ(ran.status, 2) << old;
    EXPECT_THAT(ran.text, HasSubstr("` is now `touchstone " + line + "`\n")) << old;
  }
}

TEST_F(Launcher, BuildsAndRunsTheTestsOfARoom) {
  const Launched launched = launch("test harness/stats/ --stop-on-failure");
  EXPECT_EQ(launched.asked, (std::set<std::string>{"test_harness_stats"}));
  EXPECT_THAT(launched.ran, HasSubstr(" -R ^harness/stats/ --no-tests=error --stop-on-failure"));
  EXPECT_EQ(launch("test -R x").asked, (std::set<std::string>{"all"}));
}

TEST_F(Launcher, WaitsForBuildsAloneAndSaysForWhose) {
  ASSERT_EQ(launch("list").status, 0);
  write_program("hold", R"(
    exec 8>>tree/build/release/.lock
    flock 8
    echo 'process 7 since 10:00:00, ./touchstone check' >tree/build/release/.lock
    LOG=$PWD PATH=$PWD/bin:$PATH tree/touchstone run >out 2>&1 8>&- &
    until [[ -s out ]]; do sleep 0.05; done
    exec 8>&-
    wait $!)");
  EXPECT_EQ(run_shell("cd " + path("") + " && ./hold").status, 0);
  EXPECT_THAT(folder_.read("out"), HasSubstr("process 7 since 10:00:00, ./touchstone check\n"));
  EXPECT_THAT(folder_.read("out"), HasSubstr("Ctrl-C stops waiting"));
  // A program that runs holds nothing.
  write_program("bin/ninja", R"(
    printf '#!/bin/sh\nflock -n "${0%%/harness*}/.lock" echo free\n' >"$2/harness/touchstone")");
  EXPECT_THAT(launch("run").text, HasSubstr("free\n"));
}

TEST_F(Launcher, SaysHowFarABuildIs) {
  const std::string stub = folder_.read("bin/ninja");
  write_program("bin/ninja", stub + "\nfor ((i = 1; i <= 40; ++i)); do echo \"[$i/40] x.o\"; done");
  const Launched launched = launch("list");
  EXPECT_THAT(launched.text, HasSubstr("touchstone: building 40 files\n"));
  EXPECT_THAT(launched.text, HasSubstr("touchstone: built 20 of 40 files in "));
  EXPECT_THAT(launched.text, HasSubstr("touchstone: built 40 of 40 files in "));
  EXPECT_THAT(launched.text, Not(HasSubstr("x.o")));
  write_program("bin/ninja", stub + "\necho '[1/2] x.o'; echo 'x.cpp:1:2: warning: i < size()'");
  const Launched warned = launch("list");
  EXPECT_EQ(warned.status, 0);
  EXPECT_THAT(warned.text,
              HasSubstr("x.cpp:1:2: warning: i < size()\ntouchstone: the compiler warns"));
  EXPECT_NE(warned.ran, "");
  write_program("bin/ninja", "echo '[1/2] x.o'; echo 'x.cpp:1: error'; exit 1");
  const Launched failed = launch("list");
  EXPECT_EQ(failed.status, 2);
  EXPECT_THAT(failed.text, HasSubstr("x.cpp:1: error\ntouchstone: the build failed"));
  EXPECT_EQ(failed.ran, "");
}

TEST_F(Launcher, SaysThatAnInstallationWasInterrupted) {
  write_program("tree/plots/python", "exit 127");
  write_program("bin/apt-get",
                "echo \"E: dpkg was interrupted, run 'dpkg --configure -a'\"; exit 100");
  const Launched launched = launch("show results --figures");
  EXPECT_EQ(launched.status, 2);
  EXPECT_THAT(launched.text, HasSubstr("missing: python3-matplotlib\n"));
  EXPECT_THAT(launched.text, HasSubstr("dpkg --configure -a` ends it, then try again"));
}

TEST_F(Launcher, AsksOnATerminalBeforeItInstalls) {
  ASSERT_EQ(launch("list").status, 0);
  write_program("bin/apt-get", R"(
    case "$*" in
      *--assume-no*) echo "After this operation, ${SIZE:-1,312 MB} of additional disk space will be used." ;;
      install*) echo "apt-get $*" >>"$LOG/installed" && touch "$LOG/there" ;;
    esac)");
  write_program("tree/plots/python", R"([[ $1 != -c || -e $LOG/there ]])");
  const std::string figures = "show results --figures";
  const std::string question = "Install 1 package (1,312 MB, about 2 minutes) with apt? [Y/n] ";
  struct Case {
    std::string words, typed;
    bool asks, installs;
  };
  for (const Case& c :
       {Case{figures, "n\\n", true, false}, Case{figures, "no\\n", true, false},
        Case{figures, "maybe\\n", true, false}, Case{figures, "\\004", true, false},
        Case{figures, "\\n", true, true}, Case{figures, "Yes\\n", true, true},
        Case{figures + " --yes", "n\\n", false, true},
        Case{"--yes " + figures, "n\\n", false, true}, Case{figures, "", false, true},
        Case{"setup", "n\\n", true, false}, Case{"setup", "y\\n", true, true}}) {
    for (const char* name : {"there", "installed"}) fs::remove(path(name));
    const Launched launched = launch(c.words, c.typed);
    EXPECT_EQ(launched.text.find(question) != std::string::npos, c.asks) << launched.text;
    EXPECT_EQ(fs::exists(path("installed")), c.installs) << c.words << c.typed << launched.text;
    EXPECT_EQ(launched.status, c.installs || c.words == "setup" ? 0 : 2) << launched.text;
    EXPECT_EQ(launched.text.find("nothing is installed") == std::string::npos, c.installs);
    const std::string done = "installing 1 package through apt: 1,312 MB";
    EXPECT_EQ(launched.text.find(done) != std::string::npos, c.installs);
    EXPECT_THAT(launched.ran, Not(HasSubstr("--yes")));
  }
  // A unit that apt counts in, and none at all.
  const std::map<std::string, std::string> sizes = {{"9.5 GB", "(9.5 GB, about 15 minutes)"},
                                                    {"1.3 GB", "(1.3 GB, about 2 minutes)"},
                                                    {"900 kB", "(900 kB, about a minute)"},
                                                    {"much", "1 package with apt?"}};
  for (const auto& [size, text] : sizes) {
    fs::remove(path("there"));
    ::setenv("SIZE", size.c_str(), 1);
    EXPECT_THAT(launch(figures, "n\\n").text, HasSubstr(text));
    ::unsetenv("SIZE");
  }
  ::setenv("TOUCHSTONE_YES", "1", 1);
  EXPECT_THAT(launch(figures, "n\\n").text, Not(HasSubstr("[Y/n]")));
  ::unsetenv("TOUCHSTONE_YES");
  EXPECT_TRUE(fs::exists(path("there")));
}

TEST_F(Launcher, AsksOnceForAllThatSetupInstalls) {
  ASSERT_EQ(launch("list").status, 0);
  std::string text = folder_.read("tree/touchstone");
  const std::string sign = "program:npm";
  text.replace(text.find(sign), sign.size(), "program:npm-of-no-machine");
  folder_.write("tree/touchstone", text);
  write_program("bin/apt-get", R"([[ "$*" != *install*-y* ]] || echo "$*" >>"$LOG/installed")");
  write_program("tree/plots/python", R"([[ -e $LOG/installed ]])");
  const Launched launched = launch("setup", "y\\n");
  EXPECT_EQ(launched.status, 0) << launched.text;
  EXPECT_THAT(launched.text, HasSubstr("missing: python3-matplotlib npm"));
  EXPECT_THAT(launched.text, HasSubstr("Install 2 packages with apt? [Y/n] "));
  EXPECT_THAT(launched.text, HasSubstr("going on without pages: npm"));
  EXPECT_THAT(folder_.read("installed"), HasSubstr(" python3-matplotlib npm\n"));
}

}  // namespace
}  // namespace touchstone
