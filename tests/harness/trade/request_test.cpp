// Tests of a trade's request and of its grids.
#include "harness/trade/trade_request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/files/toml_table.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/trade/trade_scenes.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

const std::string scene_text =
    "generator = \"uniform\"\ncount = 40\nshapes = [\"box\", \"sphere\"]\noverlaps = 5\n";

std::vector<std::string> names(const trade::GridPoints& grid) {
  std::vector<std::string> all;
  for (const trade::TradePoint& point : grid.points) all.push_back(point.configuration.name());
  return all;
}

TEST(TradeRequest, WhatIsWrittenIsReadAsTheSame) {
  const TemporaryFolder folder;
  folder.write("scene.toml", scene_text);
  const auto file = folder.write("a.toml", R"(
name = "mine \"quoted\""
seed = 7
[trade]
scene = "scene.toml"
count = 50
frames = 3
task = "penetration"
threads = 1
error = "p99"
seconds = 12.5
[[trade.grid]]
representations = ["as-given", {box = "sphere"}]
boxes = ["tight", "fat-0.25"]
broad = ["sweep-one-axis", "naive"]
narrow = ["closed-form+gjk", "mpr"]
scalars = ["double", "float"]
[[trade.grid]]
narrow = "gjk"
tolerances = [1e-3, 1e-9]
max_iterations = [1, 8]
)");
  EXPECT_TRUE(files::has_key(file, "trade"));
  EXPECT_FALSE(files::has_key(file, "trade.seed"));  // that is no array of tables
  const trade::TradeRequest request = trade::read_trades(file).at(0);
  EXPECT_EQ(request.seed, 7u);
  EXPECT_EQ(request.task, Task::penetration);
  EXPECT_EQ(request.measure, trade::ErrorMeasure::p99);
  EXPECT_EQ(request.overrides.count, 50);
  ASSERT_EQ(request.grids.size(), 2u);
  EXPECT_EQ(request.grids[1].max_iterations[1], 8);

  std::filesystem::create_directory(folder.path() / "out");
  const std::string text =
      trade::trade_toml(request, folder.path() / "out", "A comment\nof two lines");
  const trade::TradeRequest again = trade::read_trades(folder.write("out/b.toml", text)).at(0);
  EXPECT_EQ(trade::trade_toml(again, folder.path() / "out", "A comment\nof two lines"), text);
  EXPECT_EQ(again.name, request.name);
  EXPECT_EQ(again.seconds, request.seconds);
  const scene::Scene scene = scene::load_scene(again.scene, again.overrides);
  const trade::SceneFrames frames(scene, 3);
  trade::StandInLibrary library(frames, simple_representing());
  const trade::GridPoints before = trade::expand(request.grids, frames, library, request.task);
  const trade::GridPoints after = trade::expand(again.grids, frames, library, again.task);
  EXPECT_EQ(names(before), names(after));
  EXPECT_EQ(before.left_out, after.left_out);
  EXPECT_GT(before.points.size(), 20u);

  // Each point is written as advice is, as one configuration.
  for (const trade::TradePoint& point : before.points) {
    trade::TradeRequest one = request;
    one.grids = {trade::grid_of(point.configuration)};
    const trade::TradeRequest read =
        trade::read_trades(
            folder.write("out/one.toml", trade::trade_toml(one, folder.path() / "out", "")))
            .at(0);
    const trade::GridPoints only = trade::expand(read.grids, frames, library, read.task);
    ASSERT_EQ(only.points.size(), 1u);
    EXPECT_EQ(only.points[0].configuration.name(), point.configuration.name());
  }
}

TEST(TradeRequest, BadInputIsToldWithItsPlace) {
  const TemporaryFolder folder;
  const auto fault = [&](const std::string& text) {
    const auto file = folder.write("bad.toml", text);
    return folder.without_path(input_fault([&] { trade::read_trades(file); }));
  };
  const std::string head = "[trade]\nscene = \"s.toml\"\n";
  EXPECT_THAT(fault("[trade]\n"), HasSubstr("bad.toml:1: trade: scene: missing"));
  EXPECT_THAT(fault(head + "taks = \"distance\"\n"), HasSubstr("bad.toml:3"));
  EXPECT_THAT(fault(head + "task = \"touch\"\n"), HasSubstr("bad.toml:3: trade: task"));
  EXPECT_THAT(fault(head + "error = \"none\"\n"), HasSubstr("bad.toml:3: trade: error"));
  const std::string grid = head + "[[trade.grid]]\n";
  for (const char* line :
       {"boxes = \"fat\"", "boxes = \"fat-0\"", "boxes = []", "broad = \"nobody\"",
        "broad = \"none\"", "narrow = \"gjk+nobody\"", "narrow = \"all\"", "narrow = 3",
        "scalars = \"half\"", "tolerances = 2", "max_iterations = 0", "representations = \"blob\"",
        "representations = {cube = \"sphere\"}", "representations = {halfspace = \"sphere\"}",
        "color = 1"}) {
    EXPECT_THAT(fault(grid + line + "\n"), HasSubstr("bad.toml:4")) << line;
  }
}

TEST(TradeGrid, WhatMakesNoSenseIsLeftOutWithItsReason) {
  const scene::Scene scene = scene_of(scene_text);
  const trade::SceneFrames frames(scene, 3);
  trade::StandInLibrary library(frames, simple_representing());
  trade::TradeGrid grid = grid_with("sat");
  grid.narrow = {trade::parse_chain("sat"),       trade::parse_chain("sat+gjk"),
                 trade::parse_chain("gjk"),       trade::parse_chain("gjk+sat"),
                 trade::parse_chain("certified"), {}};
  grid.scalars = {Precision::float64, Precision::float32};
  grid.representations = {{}, all_as(proxies::Form::capsule)};
  const trade::GridPoints intersect = trade::expand({&grid, 1}, frames, library, Task::intersect);
  EXPECT_EQ(intersect.points.size(), 6u);  // sat+gjk and gjk in both scalars, certified, none
  EXPECT_EQ(std::ranges::count_if(intersect.left_out,
                                  [](const auto& reason) {
                                    return reason.first.starts_with("sat does not take sphere-");
                                  }),
            1);
  EXPECT_EQ(intersect.left_out.at("the same as another"), 2);  // gjk+sat equals gjk
  EXPECT_EQ(intersect.left_out.at("certified has no float"), 1);
  EXPECT_EQ(intersect.left_out.at("capsule: no such representation in this test"), 1);
  const trade::GridPoints distance = trade::expand({&grid, 1}, frames, library, Task::distance);
  EXPECT_EQ(distance.left_out.at("without a narrow phase there are no numbers"), 1);
}

TEST(TradeGrid, AKindThatTheSceneHasNotMakesNoDifference) {
  const scene::Scene scene = scene_of(scene_text);
  const trade::SceneFrames frames(scene, 3);
  const trade::StandInLibrary library(frames, simple_representing());
  trade::Representations some;
  some.of[static_cast<std::size_t>(ShapeKind::cone)] =
      proxies::Representation{proxies::Form::sphere, {}, 0};
  some.of[static_cast<std::size_t>(ShapeKind::sphere)] =
      proxies::Representation{proxies::Form::sphere, {}, 0};
  EXPECT_EQ(library.complete(some), library.complete({}));
  some.of[static_cast<std::size_t>(ShapeKind::box)] =
      proxies::Representation{proxies::Form::sphere, {}, 0};
  EXPECT_EQ(library.complete(some).name(), "sphere");  // a sphere's sphere is itself
  EXPECT_EQ(library.complete(all_as(proxies::Form::sphere)), library.complete(some));
  some.of[static_cast<std::size_t>(ShapeKind::box)] =
      proxies::Representation{proxies::Form::dop26, {}, 0};
  EXPECT_EQ(library.complete(some).name(), "sphere=as-given,box=dop-26");
}

}  // namespace
}  // namespace touchstone
