// Tests of the scripts in plots/, through `touchstone show --figures`.
#include <string>

#include "tests/harness/commands/program.h"
#include "tests/harness/packed.h"
#include "tests/harness/stats/sample_file.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

// The command runs the first Python with matplotlib.
const std::string python = std::string(project_folder) + "/plots/python";

bool has_matplotlib() { return run_shell(python + " -c ''").status == 0; }

Ran plot(const std::string& arguments) { return run_program("show --figures " + arguments); }

// Makes scenes at three counts and two widths, with a peer, and narrow phases that fail and err.
FakeRun varied_run() {
  FakeRun run;
  for (const std::string scene : {"uniform", "rotating_gravity"}) {
    for (const int threads : {1, 2}) {
      for (const int bodies : {1000, 4000, 16000}) {
        FakeBlock block;
        block.scene = scene;
        block.bodies = bodies;
        block.threads = threads;
        block.scene_hash = scene + std::to_string(bodies);
        block.contestants = {{"sweep-one-axis", 1e-6 * bodies / threads},
                             {"naive", 1e-9 * bodies * bodies},
                             {"bullet-tree", 1.1e-6 * bodies}};
        run.blocks.push_back(block);
      }
    }
  }
  FakeBlock narrow;
  narrow.task = "distance";
  narrow.pair_kind = "box-sphere";
  narrow.contestants = {{"gjk", 100e-9}, {"bullet-gjk-epa", 130e-9, "00000000000000aa", "ok", 3}};
  run.blocks.push_back(narrow);
  return run;
}

TEST(Plots, EveryFigureInTheSameBytesTwice) {
  if (!has_matplotlib()) GTEST_SKIP() << "no matplotlib";
  const TemporaryFolder folder;
  const std::string results = varied_run().write(folder.path() / "r").string();
  for (const char* out : {"one", "two"}) {
    const Ran ran = plot(results + " --out " + (folder.path() / out).string());
    ASSERT_EQ(ran.status, 0) << ran.text;
  }
  for (const char* name :
       {"time_against_count", "broad", "speed_up", "phases", "winners", "agreement"}) {
    for (const char* ending : {".svg", ".pdf", ".png"}) {
      const std::string one = folder.read(std::string("one/") + name + ending);
      EXPECT_GT(one.size(), 1000u) << name << ending;
      EXPECT_TRUE(one == folder.read(std::string("two/") + name + ending)) << name << ending;
    }
  }
}

TEST(Plots, MapsOfAStressSweepInTheSameBytesTwice) {
  if (!has_matplotlib()) GTEST_SKIP() << "no matplotlib";
  const TemporaryFolder folder;
  const std::string sweep = (folder.path() / "sweep").string();
  const Ran made = run_program("check --narrow gjk,ode --axes gap --cases 2 --out " + sweep);
  ASSERT_EQ(made.status, 0) << made.text;
  const std::string own = folder.read("sweep/figures/stress_ours.svg");
  for (const char* out : {"one", "two"}) {
    const Ran ran = plot(sweep + " --out " + (folder.path() / out).string());
    ASSERT_EQ(ran.status, 0) << ran.text;
    EXPECT_TRUE(own == folder.read(std::string(out) + "/stress_ours.svg"));
    EXPECT_GT(folder.read(std::string(out) + "/stress_ours.png").size(), 1000u);
    // The second time the rows are packed, if the program that unpacks them is here.
    const std::filesystem::path rows = folder.path() / "sweep/stress.csv";
    if (std::filesystem::exists(rows) && run_shell("command -v zstd").status == 0) pack(rows);
  }
  EXPECT_EQ(folder.read("one/stress_ours.png"), folder.read("two/stress_ours.png"));
}

TEST(Plots, CellsWithACrossBesideWhoIsWrong) {
  if (!has_matplotlib()) GTEST_SKIP() << "no matplotlib";
  const TemporaryFolder folder;
  const std::string header =
      "group,cell,algorithm,origin,missed,false_hits,inexact,status,seconds\n";
  const std::string rows =
      "hit,box,first,ours,0,0,0,ok,1e-7\nhit,box,second,peer,3,0,0,ok,2e-7\n"
      "miss,box,first,ours,0,0,0,ok,2e-7\nmiss,box,second,peer,,,,unsupported,\n";
  folder.write("set_grades.csv", header + rows);
  folder.write("set_times.csv", header + rows);
  const std::string cells = folder.path().string();
  Ran ran = plot(cells);
  ASSERT_EQ(ran.status, 0) << ran.text;
  const std::string figure = folder.read("figures/cells.svg");
  EXPECT_THAT(figure, testing::HasSubstr("wrong at least once"));
  EXPECT_GT(folder.read("figures/cells.png").size(), 1000u);
  ran = plot(cells);
  EXPECT_TRUE(figure == folder.read("figures/cells.svg"));
  folder.write("set_times.csv", header + "hit,box,first,ours,0,0,0,unsupported,\n");
  ran = plot(cells);
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr("nothing was drawn"));
}

TEST(Plots, BadRequestsAreTold) {
  if (!has_matplotlib()) GTEST_SKIP() << "no matplotlib";
  const TemporaryFolder folder;
  const std::string none = (folder.path() / "none").string();
  Ran ran = plot(none);
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr(none));
  FakeRun run;
  ran = plot(run.write(folder.path() / "empty").string());
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr("nothing was drawn"));
}

}  // namespace
}  // namespace touchstone
