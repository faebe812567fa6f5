// Measures a trade: truth, errors, times, front.
#include "harness/trade/trade_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/trade/trade_files.h"

namespace touchstone::trade {
namespace {

constexpr double preparation_share = 0.03;  // share of the seconds, for one representation
constexpr double share_of_truth = 0.2;      // share of the seconds
constexpr double least_timing = 0.4;  // least share of the seconds, however long the rest took
constexpr std::size_t most_truth_frames = 16;

int frames_of(const TradeRequest& request) {
  return request.overrides.frames == -1 ? default_trade_frames : request.overrides.frames;
}

// The first point that works is the baseline of the others.
void put_baseline_first(std::vector<TradeOutcome>& points) {
  const auto works =
      std::ranges::find_if(points, [](const TradeOutcome& point) { return point.evaluation.ok(); });
  if (works == points.end()) throw base::InputError("no configuration works on this scene");
  std::rotate(points.begin(), works, works + 1);
}

}  // namespace

TradeScene::TradeScene(const TradeRequest& request, const Representing& representing)
    : TradeScene(scene::load_scene(request.scene, request.overrides), request, representing) {}

TradeScene::TradeScene(scene::Scene from, const TradeRequest& request,
                       const Representing& representing)
    : scene(std::move(from)),
      frames(scene, frames_of(request)),
      library(frames, representing, preparation_share * request.seconds) {}

TradeResult measure_trade(TradeRequest& request, TradeScene& scene,
                          const std::filesystem::path& folder,
                          const std::function<void(const std::string&)>& said) {
  const base::Stopwatch watch;
  if (request.grids.empty()) {
    request.grids = default_grids(request.task, fastest_broad(scene.frames, scene.library));
  }
  GridPoints grid = expand(request.grids, scene.frames, scene.library, request.task);
  if (grid.points.empty()) {
    throw base::InputError(
        request.scene.string() + ": every configuration makes no sense for this scene" +
        (grid.left_out.empty() ? "" : ", the first as " + grid.left_out.begin()->first));
  }
  said(fmt::format(
      "{} configurations of {} bodies, {} combinations left out ({:.0f} s)", grid.points.size(),
      scene.scene.size(),
      [&] {
        int count = 0;
        for (const auto& [reason, times] : grid.left_out) count += times;
        return count;
      }(),
      watch.seconds()));

  TradeResult result;
  result.left_out = std::move(grid.left_out);
  result.bodies = scene.scene.size();
  result.frames = scene.frames.frames.size();
  std::vector<std::size_t> sampled = sampling_order(result.frames);
  sampled.resize(std::min(sampled.size(), most_truth_frames));
  const std::vector<FrameTruth> truth =
      find_truth(scene.frames, sampled, share_of_truth * request.seconds, request.threads);
  result.truth_frames = truth.size();
  for (const FrameTruth& frame : truth) result.near_pairs += frame.pairs.size();
  said(fmt::format("exact answers for {} pairs near each other, in {} frames ({:.0f} s)",
                   result.near_pairs, truth.size(), watch.seconds()));

  std::vector<Evaluation> evaluations = evaluate(scene.frames, grid.points, truth, request.task);
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    TradeOutcome& outcome = result.points.emplace_back();
    outcome.point = grid.points[i];
    outcome.evaluation = std::move(evaluations[i]);
    const Representations& representations = outcome.point.configuration.representations;
    outcome.representation = spread_of(scene.library.errors(representations));
    outcome.preparation = scene.library.seconds(representations);
    outcome.error = !outcome.evaluation.ok() ? Outcome::none
                                             : error_of(outcome.evaluation.errors,
                                                        outcome.representation, request.measure);
  }
  put_baseline_first(result.points);
  said(fmt::format("errors of each ({:.0f} s)", watch.seconds()));

  std::vector<TradePoint> points;
  std::vector<double> rough;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    if (!result.points[i].evaluation.ok()) continue;
    points.push_back(result.points[i].point);
    rough.push_back(std::max(1e-7, result.points[i].evaluation.rough_seconds()));
    places.push_back(i);
  }
  TimingPlan plan;
  plan.threads = request.threads;
  plan.executor = request.executor;
  plan.seed = request.seed;
  plan.seconds = std::max(least_timing * request.seconds, request.seconds - watch.seconds());
  TradeFiles files(request, scene, folder);
  PointTimes times = time_points(
      scene.frames, points, rough, request.task, plan,
      [&](const PointSample& sample) { files.write(sample, points[sample.point].configuration); });
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.points[places[i]].timed = std::move(times.points[i]);
  }
  result.control = times.control;
  said(fmt::format("times of each ({:.0f} s)", watch.seconds()));

  std::vector<FrontPoint> front;
  for (const TradeOutcome& point : result.points) {
    front.push_back({point.ok() ? point.timed.seconds : Outcome::none, point.error});
  }
  result.front = pareto_front(front);
  for (const std::size_t i : result.front) result.points[i].on_front = true;
  files.finish(result);
  return result;
}

}  // namespace touchstone::trade
