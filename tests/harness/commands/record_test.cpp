// Tests of touchstone scene record.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/scene/box_frames.h"
#include "harness/scene/player.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

class Record : public testing::Test {
 protected:
  Record() : scene_(folder_.write("s.toml", "generator = \"uniform\"\ncount = 30\nframes = 4\n")) {}

  static int status_of(std::vector<std::string> arguments) {
    commands::CommandLine line("");
    commands::add_scene_record(line.add_command("record", ""));
    arguments.insert(arguments.begin(), "record");
    return line.run(arguments);
  }
  static void run(const std::vector<std::string>& arguments) {
    EXPECT_EQ(status_of(arguments), commands::exit_done);
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_;
  std::filesystem::path scene_;
};

TEST_F(Record, RecordingsAreTheSceneBoxes) {
  run({scene_.string(), "--out", path("r.aabbs")});
  run({scene_.string(), "--out", path("r.csv")});
  const scene::Scene scene = scene::load_scene(scene_),
                     recorded = scene::load_scene(path("r.aabbs"));
  const std::vector<scene::BoxFrame> frames = scene::read_box_frames(path("r.csv"));
  ASSERT_EQ(recorded.recording.size(), 4u);
  ASSERT_EQ(frames.size(), 4u);
  scene::ScenePlayer player(scene, scene::BoxKind::tight),
      replayed(recorded, scene::BoxKind::tight);
  do {
    const std::vector<Aabb> boxes(player.boxes().begin(), player.boxes().end());
    EXPECT_EQ(recorded.recording[static_cast<std::size_t>(player.frame())], boxes);
    EXPECT_EQ(frames[static_cast<std::size_t>(player.frame())].boxes, boxes);
    EXPECT_EQ(player.change().moved.size(), replayed.change().moved.size());
  } while (player.next() && replayed.next());
  EXPECT_EQ(scene::read_aabbs(path("r.aabbs")).scene, "s");
}

TEST_F(Record, BodiesThatComeAndGoAreRowsWithoutABox) {
  const auto scene =
      folder_.write("churn.toml", "generator = \"uniform\"\ncount = 30\nframes = 5\nchurn = 0.2\n");
  run({scene.string(), "--out", path("r.csv")});
  const std::vector<scene::BoxFrame> frames = scene::read_box_frames(path("r.csv"));
  const scene::Scene played = scene::load_scene(scene);
  scene::ScenePlayer player(played, scene::BoxKind::tight);
  for (const scene::BoxFrame& frame : frames) {
    const FrameChange change = player.change();
    EXPECT_TRUE(std::ranges::equal(frame.boxes, change.boxes));
    EXPECT_TRUE(std::ranges::equal(frame.moved, change.moved));
    EXPECT_TRUE(std::ranges::equal(frame.inserted, change.inserted));
    EXPECT_TRUE(std::ranges::equal(frame.removed, change.removed));
    player.next();
  }
  EXPECT_THROW(run({scene.string(), "--out", path("r.aabbs")}), base::InputError);
}

TEST_F(Record, TakesOverrides) {
  run({scene_.string(), "--out", path("r.aabbs"), "--count", "12", "--frames", "2", "--seed", "9",
       "--boxes", "loose"});
  const scene::Scene scene = scene::load_scene(scene_, {.count = 12, .seed = 9, .frames = 2});
  const scene::ScenePlayer player(scene, scene::BoxKind::loose);
  const scene::BoxRecording recording = scene::read_aabbs(path("r.aabbs"));
  ASSERT_EQ(recording.frames.size(), 2u);
  EXPECT_EQ(recording.frames[0], std::vector<Aabb>(player.boxes().begin(), player.boxes().end()));
  for (const auto& frame : recording.frames) {
    for (const Aabb& box : frame) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_LE(recording.world.min[axis], box.min[axis]);
        EXPECT_GE(recording.world.max[axis], box.max[axis]);
      }
    }
  }
}

TEST_F(Record, LeavesNothingBehindWhereItFails) {
  EXPECT_THROW(run({path("none.toml"), "--out", path("r.aabbs")}), base::InputError);
  EXPECT_THROW(run({scene_.string(), "--out", path("r.txt")}), base::InputError);
  EXPECT_THROW(run({scene_.string(), "--out", path("none/r.aabbs")}), base::InputError);
  EXPECT_THROW(run({scene_.string(), "--out", path("none/r.csv")}), base::InputError);
  EXPECT_EQ(status_of({scene_.string(), "--out", path("r.csv"), "--count", "0"}),
            commands::exit_bad_request);
  EXPECT_EQ(status_of({scene_.string(), "--out", path("r.csv"), "--boxes", "round"}),
            commands::exit_bad_request);
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"s.toml"});
}

TEST_F(Record, PosesAreReadAgain) {
  run({scene_.string(), "--poses", "--out", path("poses.csv")});
  EXPECT_THAT(folder_.read("poses.csv"), testing::StartsWith("frame,body,m00,m01"));
  EXPECT_THROW(status_of({scene_.string(), "--poses", "--out", path("poses.aabbs")}),
               base::InputError);
}

}  // namespace
}  // namespace touchstone
