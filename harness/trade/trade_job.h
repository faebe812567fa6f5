// Measures a trade: the exact answers, the errors, the times, and the Pareto front.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/trade/point_times.h"
#include "harness/trade/trade_request.h"

namespace touchstone::trade {

struct TradeOutcome {
  TradePoint point;
  Evaluation evaluation;
  RepresentationSpread representation;
  double preparation = 0;  // seconds to make its representations, before any frame
  TimedPoint timed;
  double error = 0;  // a value of the request's measure; NaN if the point failed
  bool on_front = false;

  bool ok() const { return evaluation.ok() && timed.ok(); }
};

struct TradeResult {
  std::vector<TradeOutcome> points;  // the points, the baseline first
  std::vector<std::size_t> front;    // indices of points, by rising time
  std::map<std::string, int> left_out;
  std::size_t bodies = 0, frames = 0, truth_frames = 0, near_pairs = 0;
  double control = Outcome::none;  // the time of the A/A control over the baseline's
};

// A scene that is ready to be measured on.
struct TradeScene {
  // Throws InputError if the scene cannot be made.
  TradeScene(const TradeRequest& request, const Representing& representing);
  TradeScene(scene::Scene from, const TradeRequest& request, const Representing& representing);
  TradeScene(const TradeScene&) = delete;  // its members hold references to each other
  TradeScene& operator=(const TradeScene&) = delete;

  scene::Scene scene;
  SceneFrames frames;
  StandInLibrary library;
};

// Measures into the folder, which it begins anew. Fills in the grids if the request has none.
// `said` is called with a line for each step.
TradeResult measure_trade(TradeRequest& request, TradeScene& scene,
                          const std::filesystem::path& folder,
                          const std::function<void(const std::string&)>& said);

}  // namespace touchstone::trade
