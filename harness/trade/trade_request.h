// A request to `touchstone advise --front`, from the command line or a file.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/record/result_folder.h"
#include "harness/scene/scene.h"
#include "harness/trade/evaluation.h"
#include "harness/trade/grid.h"

namespace touchstone::trade {

inline constexpr int default_trade_frames = 65;  // one to begin with and 64 timed ones
// The tasks that can be traded, in the order of Task.
inline constexpr std::array<std::string_view, 3> traded_tasks = {"intersect", "distance",
                                                                 "penetration"};

struct TradeRequest {
  std::string name;  // the name of the figure
  std::filesystem::path scene;
  // frames: -1 is the scene's number, but at most default_trade_frames
  scene::SceneOverrides overrides;
  Task task = Task::intersect;
  int threads = 2;
  ExecutorKind executor = usual_executor;
  ErrorMeasure measure = ErrorMeasure::verdicts;
  double seconds = 150;    // approximate total
  std::uint64_t seed = 1;  // the seed of the order in which configurations run
  // The first combination is the baseline. If empty: default_grids with the fastest broad phase.
  std::vector<TradeGrid> grids;
  record::Facts facts = {};  // further facts of machine.csv
};

// Returns a request for each scene, count and seed of the file; if there are several, their names end
// in the number of each. The keys are documented in datasets/README.md. Scenes are relative to the
// folder `home`, without one to that of the file. Throws InputError with file, line and what was
// expected.
std::vector<TradeRequest> read_trades(const std::filesystem::path& file,
                                      const std::filesystem::path& home = {});
// Returns the text of a file from which read_trades makes an equal request; the scene's path is
// relative to `folder`, which is to hold the file. `comment` holds lines for its head.
std::string trade_toml(const TradeRequest& request, const std::filesystem::path& folder,
                       const std::string& comment);

}  // namespace touchstone::trade
