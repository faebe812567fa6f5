// A test of a whole trade in little time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "harness/files/csv.h"
#include "harness/trade/trade_files.h"
#include "tests/harness/trade/trade_scenes.h"

namespace touchstone {
namespace {

TEST(TradeJob, LeavesRowsAndAFrontThatNothingBeats) {
  const TemporaryFolder folder;
  trade::TradeRequest request;
  request.name = "small";
  request.scene =
      folder.write("scene.toml", "generator = \"uniform\"\ncount = 80\noverlaps = 6\nframes = 5\n");
  request.threads = 1;
  request.seconds = 1;
  trade::TradeGrid grid = grid_with("gjk");
  grid.narrow = {trade::parse_chain("gjk"), trade::parse_chain("certified"), {}};
  grid.boxes = {{}, {trade::BoxChoice::Kind::loose, 0}};
  grid.representations = {{}, all_as(proxies::Form::sphere)};
  request.grids = {grid};
  trade::TradeScene scene(request, simple_representing());
  const trade::TradeResult result =
      trade::measure_trade(request, scene, folder.path(), [](const auto&) {});

  ASSERT_EQ(result.points.size(), 12u);
  std::set<double> errors;
  for (const trade::TradeOutcome& point : result.points) {
    ASSERT_TRUE(point.ok()) << point.timed.words;
    EXPECT_GT(point.timed.seconds, 0);
    EXPECT_GT(point.timed.rounds, 0);
    errors.insert(point.error);
    for (const std::size_t i : result.front) {
      const trade::TradeOutcome& best = result.points[i];
      EXPECT_FALSE(point.timed.seconds < best.timed.seconds && point.error < best.error);
    }
  }
  EXPECT_EQ(*errors.begin(), 0);
  EXPECT_GT(errors.size(), 2u);
  ASSERT_FALSE(result.front.empty());
  EXPECT_EQ(result.points[result.front.back()].error, 0);
  EXPECT_GT(result.control, 0);

  std::size_t on_front = 0, points = 0, samples = 0;
  files::CsvReader(folder.path() / "points.csv", {"point", "front", "seconds"})
      .read([&](const files::CsvReader::Row& row) {
        ++points;
        on_front += row.text(1) == "1" ? 1 : 0;
        EXPECT_GT(row.number(2), 0);
      });
  EXPECT_EQ(points, 12u);
  EXPECT_EQ(on_front, result.front.size());
  std::set<std::string> stages;
  files::CsvReader(folder.path() / "samples.csv",
                   {"scene", "bodies", "frame", "broad", "narrow", "scalar", "threads", "phase",
                    "seconds", "pair_count", "pair_hash", "contact_count", "status"})
      .read([&](const files::CsvReader::Row& row) {
        ++samples;
        stages.emplace(row.text(7));
        EXPECT_EQ(row.integer(1), 80);
        EXPECT_EQ(row.text(12), "ok");
      });
  EXPECT_EQ(stages.size(), trade::stage_names.size());
  EXPECT_EQ(samples % trade::stage_names.size(), 0u);
  // The request that is written can be read again.
  const trade::TradeRequest again = trade::read_trades(folder.path() / "trade.toml").at(0);
  EXPECT_EQ(again.name, "small");
  EXPECT_TRUE(std::filesystem::equivalent(again.scene, request.scene));
}

}  // namespace
}  // namespace touchstone
