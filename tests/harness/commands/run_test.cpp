// Tests of touchstone run and draw, through the program.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <map>
#include <set>
#include <string>

#include "tests/harness/campaign/stopped_run.h"
#include "tests/harness/commands/program.h"

namespace touchstone {
namespace {

class RunCommand : public testing::Test {
 protected:
  RunCommand() {
    folder_.write("s.toml",
                  "generator = 'uniform'\ncount = 40\nframes = 2\nshapes = ['box', 'sphere']\n");
    folder_.write("c.toml",
                  "scenes = 's.toml'\nbroad = ['naive', 'uniform-grid']\nnarrow = 'gjk'\n"
                  "seconds = 0.3\n");
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  TemporaryFolder folder_;
};

TEST_F(RunCommand, RunsACampaignAndPrintsItsTables) {
  const Ran ran = run_program("run " + path("c.toml") + " --noisy --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, testing::ContainsRegex("by pairs +boxes .*, intersect "));
  EXPECT_THAT(ran.text, testing::Not(testing::HasSubstr("# Tables of the campaign")));
  EXPECT_THAT(folder_.read("out/tables.md"), testing::HasSubstr("# Tables of the campaign"));
  const Ran again = run_program("run " + path("c.toml") + " --tables --out " + path("out"));
  EXPECT_THAT(again.text, testing::HasSubstr("# Tables of the campaign"));
  const auto rows =
      read_rows(folder_.path() / "out/raw.csv",
                {"scene", "bodies", "frame", "broad", "narrow", "scalar", "threads", "phase",
                 "seconds", "pair_count", "pair_hash", "contact_count", "status"});
  EXPECT_GT(rows.size(), 8u);
  EXPECT_FALSE(read_rows(folder_.path() / "out/machine.csv", {"name", "value"}).empty());
}

// With few boxes a later group may measure what an earlier one did. If it measures anything else, it stays.
TEST_F(RunCommand, LeavesOutOfAFirstLookWhatIsMeasuredAlready) {
  const std::string group =
      "[[group]]\nscenes = 's.toml'\nbroad = ['naive', 'uniform-grid']\nnarrow = 'none'\n";
  const std::string few = group + "counts = 2000\n", many = group + "counts = 5000\n";
  const std::string naive = "exclude = [{broad = 'naive'}]\n";
  const auto blocks = [&](const std::string& groups, const std::string& option) {
    folder_.write("groups.toml", groups);
    const Ran ran = run_program("run " + path("groups.toml") + " --dry-run" + option);
    EXPECT_EQ(ran.status, 0) << ran.text;
    return (ran.text.find("block 0:") != std::string::npos) +
           (ran.text.find("block 1:") != std::string::npos);
  };
  EXPECT_EQ(blocks(few + many, ""), 2);
  EXPECT_EQ(blocks(few + many, " --quick"), 1);
  EXPECT_EQ(blocks(few + many + naive, " --quick"), 1);
  EXPECT_EQ(blocks(few + naive + many, " --quick"), 2);
  EXPECT_EQ(blocks(few + many + "limit = true\n", " --quick"), 2);
  EXPECT_EQ(blocks(few + many + "rebuild = true\n", " --quick"), 2);
}

TEST_F(RunCommand, TakesASceneInsteadOfACampaign) {
  const Ran ran = run_program(
      "--isa baseline run --scene " + path("s.toml") +
      " --broad naive,kd-tree --narrow sat --task penetration --scalar double --threads 2"
      " --count 30,60 --boxes tight,loose --seconds 0.3 --out " +
      path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  std::map<std::string, int> isa, bodies, boxes;
  for (const auto& row : read_rows(folder_.path() / "out/raw.csv", {"isa", "bodies", "boxes"})) {
    ++isa[row[0]];
    ++bodies[row[1]];
    ++boxes[row[2]];
  }
  EXPECT_EQ(isa.size(), 1u);
  EXPECT_EQ(isa.count("baseline"), 1u);
  EXPECT_EQ(bodies.size(), 2u);
  EXPECT_EQ(boxes.size(), 2u);
}

TEST_F(RunCommand, RefusesWhatIsWrongAndLeavesNothing) {
  const std::string out = " --out " + path("out");
  expect_refusal("run " + path("none.toml") + out, "none.toml", folder_);
  folder_.write("bad.toml", "scenes = 's.toml'\nbroad = 'nobody'\n");
  expect_refusal("run " + path("bad.toml") + out, "bad.toml:2:", folder_);
  folder_.write("late.toml", "scenes = ['s.toml', 'missing.toml']\n");
  expect_refusal("run " + path("late.toml") + out, "missing.toml", folder_);
  expect_refusal("run " + path("c.toml") + " --scene " + path("s.toml") + out, "--scene", folder_);
  expect_refusal("run --broad naive" + out, "--scene", folder_);
  folder_.write("motion.toml", "generator = 'bullets'\ncount = 20\nframes = 1\n");
  expect_refusal("run --scene " + path("motion.toml") + out, " --front --motion", folder_);
  expect_refusal("run --scene " + path("s.toml") + " --threads 0" + out, "--threads", folder_);
  expect_refusal("run --scene " + path("s.toml") + " --narrow nobody" + out, "'nobody'", folder_);
  expect_refusal("run --scene " + path("s.toml") + " --out /proc/nowhere", "/proc/nowhere",
                 folder_);
  expect_refusal("fly", "run", folder_);
}

TEST_F(RunCommand, AFileWhereTheFolderShouldBeIsTold) {
  folder_.write("out", "");
  const Ran ran = run_program("run " + path("c.toml") + " --out " + path("out"));
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr(path("out")));
}

TEST_F(RunCommand, ADryRunTellsCellsAndTimesAndLeavesNothing) {
  folder_.write("c.toml",
                "scenes = 's.toml'\ncounts = [20, 40]\nbroad = ['naive', 'uniform-grid']\n"
                "narrow = ['gjk', 'sat-faces']\nscalars = 'double'\nthreads = [1, 2]\nseconds = 7\n"
                "exclude = {narrow = 'gjk', threads = 2}\n");
  const auto before = folder_.names();
  const Ran ran = run_program("run " + path("c.toml") + " --dry-run --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_EQ(folder_.names(), before);
  EXPECT_THAT(ran.text, testing::HasSubstr("block 3: s, 40 bodies"));
  EXPECT_THAT(ran.text, testing::HasSubstr("broad phases: naive, uniform-grid"));
  EXPECT_THAT(ran.text, testing::HasSubstr("box-box: gjk double, sat-faces double"));
  EXPECT_THAT(ran.text, testing::HasSubstr("box-box: sat-faces double"));
  EXPECT_THAT(ran.text, testing::ContainsRegex("4 blocks, [0-9]+ cells; about [0-9.e+-]+ s for the "
                                               "check of every frame"));
  EXPECT_THAT(ran.text, testing::HasSubstr("about 28 s for the samples"));
}

// A process that uses a processor all the time.
class Spinner {
 public:
  Spinner() : pid_(fork()) {
    if (pid_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (volatile int turns = 0;;) turns = turns + 1;
    }
  }
  ~Spinner() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Spinner(const Spinner&) = delete;
  Spinner& operator=(const Spinner&) = delete;

 private:
  pid_t pid_;
};

TEST_F(RunCommand, StrictRefusesABusyMachine) {
  const Spinner spinner;
  expect_refusal("run " + path("c.toml") + " --strict --out " + path("out"),
                 "the machine is not quiet, and --strict was given: ", folder_);
}

class StoppedRun : public RunCommand {
 protected:
  // Makes a run of which half is gone, as after a kill.
  StoppedRun() {
    write_campaign("");
    const Ran ran = run_program(command(""));
    EXPECT_EQ(ran.status, 0) << ran.text;
    rows_ = read_rows(file("raw.csv"), {"kind"}).size();
    stop_run(folder_.path() / "out", 0.5);
  }
  void write_campaign(const std::string& more) {
    folder_.write("c.toml",
                  "scenes = 's.toml'\nbroad = ['naive', 'uniform-grid']\nnarrow = 'gjk'\n"
                  "scalars = 'double'\nthreads = 1\nsquares = 6\nseconds = 0.05\n" +
                      more);
  }
  std::string command(const std::string& flags) const {
    return "run " + path("c.toml") + " --out " + path("out") + " " + flags;
  }
  std::filesystem::path file(const std::string& name) const {
    return folder_.path() / "out" / name;
  }
  void replace(const std::string& name, const std::string& old, const std::string& text) {
    std::string all = folder_.read("out/" + name);
    const auto at = all.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    folder_.write("out/" + name, all.replace(at, old.size(), text));
  }
  // Expects a refusal that loses no unit of the files; a line that was cut off may go.
  void expect_refused(const std::string& text, const std::string& flags = "--resume") {
    const std::string raw = folder_.read("out/raw.csv");
    const std::string machine = folder_.read("out/machine.csv");
    const std::size_t whole =
        std::stoul(read_rows(file("progress.csv"), {"name", "value"}).at(1)[1]);
    const Ran ran = run_program(command(flags));
    EXPECT_EQ(ran.status, 2) << ran.text;
    EXPECT_THAT(ran.text, testing::HasSubstr(text));
    const std::string after = folder_.read("out/raw.csv");
    EXPECT_TRUE(raw.starts_with(after) && after.size() >= whole) << "rows are lost";
    EXPECT_EQ(folder_.read("out/machine.csv"), machine);
  }
  void expect_whole(const std::string& flags) {
    const Ran ran = run_program(command(flags));
    EXPECT_EQ(ran.status, 0) << ran.text;
    EXPECT_EQ(read_rows(file("raw.csv"), {"kind"}).size(), rows_);
    EXPECT_THAT(folder_.read("out/machine.csv"), testing::HasSubstr("finished,yes"));
  }
  std::size_t rows_ = 0;
};

TEST_F(StoppedRun, GoesOn) { expect_whole("--resume"); }

TEST_F(StoppedRun, GoesOnWhereNoRowWasWrittenYet) {
  folder_.write("out/raw.csv", "campaign,ki");
  std::filesystem::remove(file("departures.csv"));
  std::filesystem::remove(file("progress.csv"));
  expect_whole("--resume");
}

TEST_F(StoppedRun, IsOverwrittenOnRequestOnly) {
  expect_refused("--overwrite", "");
  expect_whole("--overwrite");
  expect_whole("");  // the run was finished
}

TEST_F(StoppedRun, ResumeAndOverwriteExcludeEachOther) {
  expect_refused("--overwrite", "--resume --overwrite");
}

TEST_F(StoppedRun, AFinishedOneIsLeftAsItIs) {
  expect_whole("--resume");
  const std::string raw = folder_.read("out/raw.csv");
  expect_whole("--resume");
  EXPECT_TRUE(folder_.read("out/raw.csv") == raw) << "rows changed";
}

TEST_F(StoppedRun, AnotherFolderIsRefused) {
  expect_refusal("run " + path("c.toml") + " --resume --out " + path("elsewhere"),
                 path("elsewhere/machine.csv") + ": is not there", folder_);
}

TEST_F(StoppedRun, AnotherMachineIsRefused) {
  replace("machine.csv", "memory,", "memory,1 kB or ");
  expect_refused("memory was '1 kB or ");
}

TEST_F(StoppedRun, AnotherBuildIsRefused) {
  replace("machine.csv", "program,", "program,0");
  expect_refused("program was '0");
}

TEST_F(StoppedRun, AnotherCommitBesideTheSameProgramIsNot) {
  replace("machine.csv", "\ncommit,", "\ncommit,0");
  expect_whole("--resume");
  EXPECT_THAT(folder_.read("out/machine.csv"), testing::HasSubstr("\ncommit,0"));
}

TEST_F(StoppedRun, AnotherIsaIsRefused) {
  replace("machine.csv", "instructions_in_use,", "instructions_in_use,no ");
  expect_refused("instructions_in_use was 'no ");
}

TEST_F(StoppedRun, AnotherSceneIsRefused) {
  const std::string scene = folder_.read("s.toml");
  folder_.write("s.toml", scene + "seed = 77\n");
  expect_refused("scene s, 40 bodies was '");
  folder_.write("s.toml", scene);
  expect_whole("--resume");
}

TEST_F(StoppedRun, AnotherCampaignIsRefused) {
  write_campaign("name = 'd'\n");
  expect_refused("campaign was 'c' and is 'd'");
  write_campaign("width = 0.3\n");
  expect_refused("campaign_hash was '");
  write_campaign("");
  expect_whole("--resume");
}

TEST_F(StoppedRun, RowsOfAnotherVersionAreRefused) {
  replace("raw.csv", ",noise,words,", ",noise,wards,");  // as long: lengths are compared
  expect_refused("raw.csv:1: other columns than this program writes");
}

TEST_F(StoppedRun, ARowThatIsNoneIsRefused) {
  replace("raw.csv", ",check,", ",chekc,");
  expect_refused("raw.csv: its first ");
}

TEST_F(StoppedRun, TwoAtOnceAreRefused) {
  const int folder = open((folder_.path() / "out").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_GE(folder, 0);
  ASSERT_EQ(flock(folder, LOCK_EX), 0);
  expect_refused("another run is at work");
  close(folder);
  expect_whole("--resume");
}

TEST_F(RunCommand, RunsConcavePhasesOnAScene) {
  folder_.write("gears.toml",
                "generator = 'uniform'\ncount = 20\nframes = 2\noverlaps = 5\n"
                "shapes = [{type = 'gear', teeth = 5}]\n");
  folder_.write("gears_run.toml",
                "scenes = 'gears.toml'\nbroad = 'packed-rtree'\nconcave = 'fused'\n"
                "tasks = 'contacts'\nthreads = [1, 2]\nseconds = 0.3\n");
  const Ran ran = run_program("run " + path("gears_run.toml") + " --noisy --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  std::map<std::string, std::set<std::string>> hashes;  // by frame
  std::set<std::string> sampled;
  for (const auto& row : read_rows(folder_.path() / "out/raw.csv",
                                   {"narrow", "kind", "threads", "frame", "outcome_hash",
                                    "part_pairs", "disagreements", "pair_kind"})) {
    if (row[0].empty()) continue;
    EXPECT_EQ(row[0], "fused");
    EXPECT_EQ(row[7], "solid-solid");
    EXPECT_GT(std::stoi(row[5]), 0);
    if (row[1] == "sample") {
      sampled.insert(row[2]);
    } else {
      EXPECT_EQ(row[6], "0");
      hashes[row[3]].insert(row[4]);
    }
  }
  EXPECT_EQ(sampled, (std::set<std::string>{"1", "2"}));
  ASSERT_EQ(hashes.size(), 2u);
  for (const auto& [frame, of_frame] : hashes) EXPECT_EQ(of_frame.size(), 1u) << frame;
  const Ran drawn = run_program("scene draw " + path("gears.toml") + " --out " + path("gears.png"));
  EXPECT_EQ(drawn.status, 0) << drawn.text;
  EXPECT_THAT(drawn.text, testing::HasSubstr("20 bodies"));
}

TEST_F(RunCommand, DrawsAPicture) {
  const Ran ran = run_program("scene draw " + path("s.toml") +
                              " --frame 1 --width 64 --height 48 --out " + path("p.png"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr("40 bodies"));
  const std::string bytes = folder_.read("p.png");
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  expect_refusal("scene draw " + path("s.toml") + " --frame 2 --out " + path("q.png"),
                 "frames 0 to 1", folder_);
  expect_refusal("scene draw " + path("s.toml") + " --out " + path("q.jpg"), ".png", folder_);
  expect_refusal("scene draw " + path("s.toml") + " --out " + path("no/q.png"), "no/q.png",
                 folder_);
  expect_refusal("scene draw " + path("none.json") + " --out " + path("q.png"), "none.json",
                 folder_);
}

}  // namespace
}  // namespace touchstone
