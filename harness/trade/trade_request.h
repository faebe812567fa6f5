// A request to `touchstone trade`, from the command line or a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/scene/scene.h"
#include "harness/trade/front.h"
#include "harness/trade/grid.h"

namespace touchstone::trade {

inline constexpr int default_trade_frames = 65;  // one to begin with and 64 that are timed

struct TradeRequest {
  std::string name;  // of the figure
  std::filesystem::path scene;
  scene::SceneOverrides overrides;  // frames: -1 is the scene's, up to default_trade_frames
  Task task = Task::intersect;
  int threads = 2;
  ErrorMeasure measure = ErrorMeasure::verdicts;
  double seconds = 150;    // for all, about
  std::uint64_t seed = 1;  // of the order in which configurations run
  // The first combination is the baseline. Empty: default_grids with the fastest broad phase.
  std::vector<TradeGrid> grids;
};

// The keys are documented in datasets/README.md. Throws InputError with file, line and what was
// expected.
TradeRequest read_trade(const std::filesystem::path& file);
// A file from which read_trade makes the same again; the scene is named from `folder`, where the
// file is to be. `comment`: lines for its head.
std::string trade_toml(const TradeRequest& request, const std::filesystem::path& folder,
                       const std::string& comment);

}  // namespace touchstone::trade
