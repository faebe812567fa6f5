// Tests of touchstone scene simulate.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/scene/scene.h"
#include "harness/simulate/simulate.h"
#include "tests/harness/commands/program.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

class SimulateCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (!simulate::lacking().empty()) GTEST_SKIP() << simulate::lacking();
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  TemporaryFolder folder_;
};

TEST_F(SimulateCommand, WritesALogAndASceneToMeasureOn) {
  const std::string tower =
      (std::filesystem::path(project_folder) / "datasets/simulated/tower.toml").string();
  const std::string command = "scene simulate " + tower + " --seconds 0.5 --fps 30 --out ";
  const Ran ran = run_program(command + path("a.csv"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("a.csv: 100 of 101 bodies fell, 16 frames"));
  EXPECT_THAT(ran.text, HasSubstr("touchstone run --scene " + path("a.toml")));
  const scene::Scene scene = scene::load_scene(path("a.toml"));
  EXPECT_EQ(scene.frames, 16);
  EXPECT_EQ(scene.bodies.size(), 101u);
  EXPECT_EQ(scene.tracks.bodies.size(), 100u);
  EXPECT_DOUBLE_EQ(scene.motion.time_step, 1.0 / 30);
  EXPECT_EQ(run_program(command + path("b.csv")).status, 0);
  EXPECT_EQ(folder_.read("a.csv"), folder_.read("b.csv")) << "another process, the same bits";
}

TEST_F(SimulateCommand, RefusesWhatMakesNoSense) {
  folder_.write("s.toml", "[[body]]\nshape = {type = \"sphere\", radius = 1}\n");
  const std::string command = "scene simulate " + path("s.toml");
  expect_refusal(command, "--out", folder_);
  expect_refusal(command + " --out " + path("s.txt"), "a name ending in .csv", folder_);
  expect_refusal(command + " --out " + path("s.csv"), "s.toml", folder_);
  expect_refusal(command + " --seconds 1 --from 1 --out " + path("t.csv"), "--from", folder_);
  expect_refusal(command + " --seconds 0 --out " + path("t.csv"), "--seconds", folder_);
  expect_refusal(command + " --seconds 1e5 --out " + path("t.csv"), "frames", folder_);
  expect_refusal(command + " --gravity -1 --out " + path("t.csv"), "--gravity", folder_);
  expect_refusal("scene simulate " + path("none.toml") + " --out " + path("t.csv"), "none.toml",
                 folder_);
  folder_.write("flat.toml", "[[body]]\nshape = {type = \"sphere\", radius = 0}\n");
  expect_refusal("scene simulate " + path("flat.toml") + " --out " + path("t.csv"),
                 "flat.toml: body 0 has no volume", folder_);
}

TEST(SimulateWithoutBullet, SaysWhatIsMissing) {
  if (simulate::lacking().empty()) GTEST_SKIP() << "Bullet is there";
  const TemporaryFolder folder;
  folder.write("s.toml", "[[body]]\nshape = {type = \"sphere\", radius = 1}\n");
  const std::string path = folder.path().string();
  expect_refusal("scene simulate " + path + "/s.toml --out " + path + "/t.csv",
                 "bodies cannot fall: " + simulate::lacking(), folder);
}

}  // namespace
}  // namespace touchstone
