// touchstone run and draw, as a user runs them.
#include <map>
#include <string>

#include "tests/harness/commands/program.h"

namespace touchstone {
namespace {

class RunCommand : public testing::Test {
 protected:
  RunCommand() {
    folder_.write("s.toml",
                  "generator = 'uniform'\ncount = 40\nframes = 2\nshapes = ['box', 'sphere']\n");
    folder_.write("c.toml",
                  "scenes = 's.toml'\nbroad = ['naive', 'uniform-grid']\nnarrow = 'gjk'\n");
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  TemporaryFolder folder_;
};

TEST_F(RunCommand, RunsACampaignAndPrintsItsTables) {
  const Ran ran = run_program("run " + path("c.toml") + " --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr("Broad phases"));
  EXPECT_THAT(ran.text, testing::HasSubstr("Narrow phases, task intersect"));
  const auto rows =
      read_rows(folder_.path() / "out/raw.csv",
                {"scene", "bodies", "frame", "broad", "narrow", "scalar", "threads", "phase",
                 "seconds", "pair_count", "pair_hash", "contact_count", "status"});
  EXPECT_GT(rows.size(), 8u);
  EXPECT_FALSE(read_rows(folder_.path() / "out/machine.csv", {"name", "value"}).empty());
}

TEST_F(RunCommand, TakesASceneInsteadOfACampaign) {
  const Ran ran =
      run_program("--isa baseline run --scene " + path("s.toml") +
                  " --broad ours --narrow sat --task penetration --scalar double --threads 1,2"
                  " --count 30,60 --boxes tight,loose --out " +
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

TEST_F(RunCommand, DrawsAPicture) {
  const Ran ran = run_program("draw " + path("s.toml") +
                              " --frame 1 --width 64 --height 48 --out " + path("p.png"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr("40 bodies"));
  const std::string bytes = folder_.read("p.png");
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  expect_refusal("draw " + path("s.toml") + " --frame 2 --out " + path("q.png"), "frames 0 to 1",
                 folder_);
  expect_refusal("draw " + path("s.toml") + " --out " + path("q.jpg"), ".png", folder_);
  expect_refusal("draw " + path("s.toml") + " --out " + path("no/q.png"), "no/q.png", folder_);
  expect_refusal("draw " + path("none.json") + " --out " + path("q.png"), "none.json", folder_);
}

}  // namespace
}  // namespace touchstone
