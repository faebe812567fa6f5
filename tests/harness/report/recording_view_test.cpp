// A scene as the page plays it.
#include "harness/report/recording_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "harness/scene/box_frames.h"
#include "harness/scene/player.h"
#include "tests/harness/report/unpacked.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::report {
namespace {

using files::OrderedJson;

RecordingRequest request_for(const std::filesystem::path& scene) {
  RecordingRequest request;
  request.scene = scene;
  request.narrow = {registry::find<NarrowPhaseEntry>("gjk"),
                    registry::find<NarrowPhaseEntry>("sat")};
  return request;
}

// A ball that moves towards a box, touches it in the third frame and then overlaps it.
constexpr const char* approach = R"(
frames = 4
time_step = 1.0
body = [
  {shape = {type = "box", half_extents = [1, 1, 1]}, translation = [0, 0, 0], moving = false},
  {shape = {type = "sphere", radius = 0.5}, translation = [2.5, 0.75, 0], velocity = [-0.5, 0, 0]},
  {shape = {type = "cone", radius = 0.5, half_length = 1}, translation = [-0.4, -0.4, 1.5]},
]
)";

TEST(RecordingView, HasThePosesAndBoxesOfThePlayer) {
  const TemporaryFolder folder;
  const auto file = folder.write("approach.toml", approach);
  const OrderedJson view = recording_view(request_for(file));
  EXPECT_EQ(view["name"], "approach");
  EXPECT_EQ(view["frames"], 4);
  EXPECT_EQ(view["bodies"], 3);
  EXPECT_EQ(view["shapes"].size(), 3U);
  EXPECT_EQ(view["fixed"], OrderedJson({0}));
  EXPECT_FALSE(view["boxes_only"]);
  const std::vector<float> poses = frames_of(std::string(view["poses"]), 7 * 3);
  const std::vector<float> boxes = frames_of(std::string(view["boxes"]), 6 * 3);
  ASSERT_EQ(poses.size(), 4U * 3 * 7);
  ASSERT_EQ(boxes.size(), 4U * 3 * 6);
  const scene::Scene scene = scene::load_scene(file);
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  do {
    for (std::size_t body = 0; body < 3; ++body) {
      const std::size_t place = static_cast<std::size_t>(player.frame()) * 3 + body;
      const Pose& pose = player.poses()[body];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(poses[7 * place + axis], static_cast<float>(pose.translation[axis]));
        EXPECT_EQ(boxes[6 * place + axis], player.boxes()[body].min[axis]);
        EXPECT_EQ(boxes[6 * place + 3 + axis], player.boxes()[body].max[axis]);
      }
      EXPECT_EQ(poses[7 * place + 3], 1);  // nothing turns
    }
  } while (player.next());
}

TEST(RecordingView, HasTheVerdictsAndDistancesOfItsPairs) {
  const TemporaryFolder folder;
  const OrderedJson view = recording_view(request_for(folder.write("approach.toml", approach)));
  EXPECT_EQ(view["algorithms"], OrderedJson({"gjk", "sat"}));
  std::vector<int> of_ball;
  for (const OrderedJson& frame : view["pairs"]) {
    const auto bodies = numbers_of<std::uint32_t>(std::string(frame["bodies"]));
    const auto verdicts = bytes_of(std::string(frame["verdicts"]));
    const auto distances = numbers_of<double>(std::string(frame["distances"]));
    ASSERT_EQ(bodies.size(), 2 * distances.size());
    ASSERT_EQ(verdicts.size(), 2 * distances.size());
    int ball = -1;
    for (std::size_t i = 0; i < distances.size(); ++i) {
      const std::set<std::uint32_t> pair = {bodies[2 * i], bodies[2 * i + 1]};
      if (pair == std::set<std::uint32_t>{0, 1}) {
        ball = verdicts[2 * i];
        EXPECT_EQ(distances[i], of_ball.size() == 2 ? 0 : -0.5);
      } else {
        EXPECT_EQ(pair, (std::set<std::uint32_t>{0, 2}));
        EXPECT_EQ(verdicts[2 * i], 2);
        EXPECT_EQ(verdicts[2 * i + 1], 3);  // sat takes no cones
        EXPECT_NEAR(distances[i], -0.5, 1e-12);
      }
    }
    of_ball.push_back(ball);
  }
  EXPECT_EQ(of_ball, (std::vector<int>{-1, -1, 1, 2}));
}

// Two linked rings that do not touch, whose hulls overlap, and a box in one of them.
TEST(RecordingView, AsksConcavePhasesAboutMeshes) {
  const TemporaryFolder folder;
  const OrderedJson view = recording_view(request_for(folder.write("rings.toml", R"(
body = [
  {shape = {type = "torus", around = 16, across = 8, tube_radius = 0.2}},
  {shape = {type = "torus", around = 16, across = 8, tube_radius = 0.2}, rotation = [1, 0, 0, 0, 0, -1, 0, 1, 0], translation = [1, 0, 0]},
  {shape = {type = "box", half_extents = [0.3, 0.3, 0.3]}, translation = [-1, 0, 0]},
]
)")));
  EXPECT_EQ(view["shapes"][0]["faces"].size(), 256U);
  const std::vector<std::string> names = view["algorithms"];
  const auto at = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  ASSERT_LT(at("fused"), names.size());
  ASSERT_LT(at("part-pairs wide-bvh"), names.size());
  const OrderedJson& frame = view["pairs"][0];
  const auto bodies = numbers_of<std::uint32_t>(std::string(frame["bodies"]));
  const auto verdicts = bytes_of(std::string(frame["verdicts"]));
  const auto distances = numbers_of<double>(std::string(frame["distances"]));
  ASSERT_EQ(distances.size(), 2U);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const bool linked = bodies[2 * i + 1] == 1;
    EXPECT_EQ(verdicts[i * names.size() + at("fused")], linked ? 0 : 2);
    EXPECT_EQ(verdicts[i * names.size() + at("part-pairs wide-bvh")], linked ? 0 : 2);
    EXPECT_EQ(verdicts[i * names.size() + at("gjk")], 3);  // it is not asked
    EXPECT_EQ(std::isnan(distances[i]), !linked);
    if (linked) {
      EXPECT_NEAR(distances[i], 0.6, 0.1);
    }
  }
}

TEST(RecordingView, StopsAfterTheMostFrames) {
  const TemporaryFolder folder;
  RecordingRequest request = request_for(folder.write("approach.toml", approach));
  request.most_frames = 2;
  const OrderedJson view = recording_view(request);
  EXPECT_EQ(view["frames"], 2);
  EXPECT_EQ(view["frames_of_scene"], 4);
  EXPECT_EQ(view["pairs"].size(), 2U);
  // The hash is that of the whole scene, as in the rows that are measured on it.
  EXPECT_EQ(view["hash"], scene::scene_hash(scene::load_scene(request.scene)));
}

TEST(RecordingView, HasBodiesThatComeAndGo) {
  const TemporaryFolder folder;
  RecordingRequest request = request_for(
      folder.write("churn.toml", "generator = \"uniform\"\ncount = 50\nframes = 3\nchurn = 0.1\n"));
  const OrderedJson view = recording_view(request);
  const std::size_t bodies = view["bodies"];
  EXPECT_GT(bodies, 50U);
  const std::vector<float> boxes = frames_of(std::string(view["boxes"]), 6 * bodies);
  ASSERT_EQ(boxes.size(), 3 * 6 * bodies);
  for (std::size_t frame = 0; frame < 3; ++frame) {
    std::size_t present = 0;
    for (std::size_t body = 0; body < bodies; ++body) {
      const std::size_t place = 6 * (frame * bodies + body);
      if (boxes[place] <= boxes[place + 3]) ++present;
    }
    EXPECT_EQ(present, 50U);
  }
}

TEST(RecordingView, OfBoxesAloneHasNoVerdicts) {
  const TemporaryFolder folder;
  const std::vector<Aabb> first = {{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}};
  const std::vector<Aabb> second = {first[0], {{5, 5, 5}, {6, 6, 6}}};
  scene::write_aabbs({"boxes", "test", {{0, 0, 0}, {6, 6, 6}}, {first, second}},
                     folder.path() / "boxes.aabbs");
  RecordingRequest request = request_for(folder.path() / "boxes.aabbs");
  const OrderedJson view = recording_view(request);
  EXPECT_TRUE(view["boxes_only"]);
  EXPECT_EQ(view["bodies"], 2);
  EXPECT_EQ(view["algorithms"], OrderedJson::array());
  EXPECT_EQ(view["poses"], "");
  EXPECT_EQ(numbers_of<std::uint32_t>(std::string(view["pairs"][0]["bodies"])).size(), 2U);
  EXPECT_EQ(std::string(view["pairs"][1]["bodies"]), "");
  request.most_frames = 1;
  const OrderedJson first_alone = recording_view(request);
  EXPECT_EQ(first_alone["frames"], 1);
  EXPECT_EQ(first_alone["frames_of_scene"], 2);
  EXPECT_EQ(first_alone["pairs"].size(), 1U);
}

}  // namespace
}  // namespace touchstone::report
