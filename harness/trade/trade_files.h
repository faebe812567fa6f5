// The folder of a trade, and the rows of its files; each declares its columns once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/record/result_folder.h"
#include "harness/record/row.h"
#include "harness/trade/trade_job.h"

namespace touchstone::trade {

// A configuration as the columns of a row name it; the name of an absent part is empty.
struct ConfigurationNames {
  ConfigurationNames() = default;
  explicit ConfigurationNames(const Configuration& configuration);

  std::string representation, boxes, broad, narrow;
  std::optional<Precision> scalar;
  double tolerance = Outcome::none;
  std::optional<int> max_iterations;
};
template <record::row_of<ConfigurationNames> Names, class Visit>
void columns(Names& names, Visit& visit) {
  visit("representation", names.representation, "What stands for the bodies.");
  visit("boxes", names.boxes, "Kind of boxes; empty without a broad phase.");
  visit("broad", names.broad, "Broad phase; empty where the scene lists its pairs.");
  visit("narrow", names.narrow,
        "Narrow phases, joined by '+', or a concave phase; `none` for boxes alone.");
  visit("scalar", names.scalar, "Scalar type of the narrow phases.");
  visit("tolerance", names.tolerance, "Tolerance; empty for the algorithm's own.");
  visit("max_iterations", names.max_iterations, "Cap of iterations; empty without one.");
}

// samples.csv: one stage of one timed sample.
struct TradeSampleRow {
  std::string campaign, scene, scene_hash;
  std::int64_t seed = -1, bodies = 0, frame = 0, frames = 0;
  Task task = Task::intersect;
  std::int64_t threads = 0;
  std::optional<ExecutorKind> executor;  // empty: one thread, or it is not known
  ConfigurationNames configuration;
  bool control = false;
  std::int64_t process = 0, square = 0, round = 0, position = 0;
  std::string phase;
  double seconds = Outcome::none;
  std::int64_t pair_count = 0;
  std::string pair_hash;
  std::int64_t contact_count = -1;
  std::string noise, status;
};
template <record::row_of<TradeSampleRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("campaign", row.campaign, "Name of the trade.");
  visit("scene", row.scene, "Name of the scene.");
  visit("scene_hash", row.scene_hash, "Fingerprint of the scene's content.");
  visit("seed", row.seed, "Seed, when it is not the scene's own.");
  visit("bodies", row.bodies, "Bodies of the scene.");
  visit("frame", row.frame, "First frame of the window.");
  visit("frames", row.frames, "Frames of the window; behind the last one it goes on at the first.");
  visit("task", row.task, "Task of the narrow phases.");
  visit("threads", row.threads, "Threads.");
  visit("executor", record::newer(row.executor),
        "Whose threads they are, if several: those of our `crew` or of `onetbb`.");
  columns(row.configuration, visit);
  visit("twin", row.control, "1: the A/A control, a second registration of the baseline.");
  visit("process", row.process, "Number of the worker process.");
  visit("square", row.square, "Number of the Latin square.");
  visit("round", row.round, "Round of the square.");
  visit("position", row.position, "Position in the round.");
  visit("phase", row.phase, "Stage of the pipeline: boxes, update, find_pairs, parts or narrow.");
  visit("seconds", row.seconds, "Time of the stage, summed over the window, seconds.");
  visit("pair_count", row.pair_count, "Pairs of bodies that were found, summed over the window.");
  visit("pair_hash", row.pair_hash, "Fingerprint of these pairs.");
  visit("contact_count", row.contact_count, "Pairs that were called a contact.");
  visit("noise", row.noise, "What else the machine did in the round; empty when it was quiet.");
  visit("status", row.status, "`ok`, or how the worker ended: crashed, threw or timed_out.");
}

// points.csv: one configuration.
struct TradePointRow {
  std::string point;
  bool baseline = false, on_front = false;
  std::string status, words;
  ConfigurationNames configuration;
  double error = Outcome::none, preparation = 0, wrong_share = Outcome::none;
  TimedPoint timed;
  PointErrors errors;
  RepresentationSpread representation;
  PipelineCounters counters;
};
template <class Value, class Visit>
void spread_columns(const std::string& name, Value& spread, const std::string& what, Visit& visit) {
  visit(name + "_mean", spread.mean, "Mean " + what + ".");
  visit(name + "_p99", spread.p99, "The " + what + " that 99 % do not exceed.");
  visit(name + "_greatest", spread.greatest, "Greatest " + what + ".");
}
template <record::row_of<TradePointRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("point", row.point, "Name of the configuration.");
  visit("baseline", row.baseline, "1: its times are what the others are compared with.");
  visit("front", row.on_front, "1: on the Pareto front.");
  visit("status", row.status, "`ok`, or how it failed: crashed, threw or timed_out.");
  visit("words", row.words, "Why it failed.");
  columns(row.configuration, visit);
  visit("error", row.error, "Error by the measure that was asked for.");
  visit("seconds", row.timed.seconds, "Time of a frame, seconds: the median.");
  visit("seconds_low", row.timed.low, "Lower end of its 95 % interval.");
  visit("seconds_high", row.timed.high, "Upper end of its 95 % interval.");
  visit("rounds", row.timed.rounds, "Rounds that the median is of.");
  for (std::size_t i = 0; i < stage_names.size(); ++i) {
    visit(std::string(stage_names[i]) + "_seconds", row.timed.stages[i],
          "Median time of the stage, seconds a frame.");
  }
  visit("preparation_seconds", row.preparation, "Time to make the representations, seconds.");
  visit("near_pairs", row.errors.near, "Pairs near each other whose exact answer is known.");
  visit("contacts", row.errors.contacts, "Those that are in contact.");
  visit("false_positives", row.errors.false_positives, "Separated pairs called a contact.");
  visit("false_negatives", row.errors.false_negatives, "Contacts that were missed.");
  visit("failed", row.errors.failed, "Pairs for which the algorithm said that it has no answer.");
  visit("far_false_positives", row.errors.far, "Pairs called a contact that are not even near.");
  visit("wrong_share", row.wrong_share, "Share of wrong verdicts, 0 to 1.");
  visit("values", row.errors.values, "Distances or depths that were compared.");
  spread_columns("value", row.errors.value, "error of these, as a part of the body's size", visit);
  spread_columns("volume", row.representation.volume,
                 "volume that a representation adds and loses, as a part of the body's", visit);
  spread_columns("hausdorff", row.representation.hausdorff,
                 "distance of a representation's surface, as a part of the body's size", visit);
  visit("hulls_built", row.counters.hulls_built, "Hulls built beyond the scene's own.");
  visit("shapes_bound", row.counters.shapes_bound, "Shapes that narrow phases prepared.");
  visit("boxes_computed", row.counters.boxes, "Boxes computed.");
  visit("builds", row.counters.builds, "Calls of the broad phase's build.");
  visit("updates", row.counters.updates, "Calls of the broad phase's update.");
  visit("searches", row.counters.searches, "Calls of the broad phase's find_pairs.");
  visit("pairs", row.counters.pairs, "Pairs of bodies that a narrow phase was asked about.");
  visit("settled", row.counters.settled, "Pairs at rest, which are not asked about again.");
  visit("queries", row.counters.queries, "Queries of pairs of parts.");
  visit("witnesses", row.counters.witnesses, "Queries that gave witness points.");
}

// bins.csv: the errors of one configuration for pairs whose true gap is in one range.
struct TradeBinRow {
  std::string point;
  double gap_low = 0, gap_high = 0;
  std::int64_t pairs = 0, false_positives = 0, false_negatives = 0, failed = 0;
};
template <record::row_of<TradeBinRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("point", row.point, "Name of the configuration.");
  visit("gap_low", row.gap_low,
        "Least true gap, as a part of the smaller body's size; negative in contact, empty where "
        "the depth is not known.");
  visit("gap_high", row.gap_high, "Greatest true gap.");
  visit("pairs", row.pairs, "Pairs in this range.");
  visit("false_positives", row.false_positives, "Separated pairs called a contact.");
  visit("false_negatives", row.false_negatives, "Contacts that were missed.");
  visit("failed", row.failed, "Pairs for which the algorithm said that it has no answer.");
}

// front.csv: one configuration on the Pareto front.
struct TradeFrontRow {
  std::string point;
  ConfigurationNames configuration;
  double seconds = 0, low = 0, high = 0, error = 0;
  ErrorMeasure measure = ErrorMeasure::verdicts;
};
template <record::row_of<TradeFrontRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("point", row.point, "Name of the configuration.");
  columns(row.configuration, visit);
  visit("seconds", row.seconds, "Time of a frame, seconds: the median.");
  visit("seconds_low", row.low, "Lower end of its 95 % interval.");
  visit("seconds_high", row.high, "Upper end of its 95 % interval.");
  visit("error", row.error, "Error by `error_measure`.");
  visit("error_measure", row.measure, "The measure that was asked for.");
}

// left_out.csv: combinations of a grid that make no sense for the scene.
struct LeftOutRow {
  std::string reason;
  std::int64_t combinations = 0;
};
template <record::row_of<LeftOutRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("reason", row.reason, "Why they were left out.");
  visit("combinations", row.combinations, "How many.");
}

class TradeFiles {
 public:
  // Begins the folder anew. All arguments but the path outlive it. Throws InputError if the folder
  // cannot be written, or another trade is at work in it.
  TradeFiles(const TradeRequest& request, const TradeScene& scene,
             const std::filesystem::path& folder);
  // Adds a row for each stage of the sample to samples.csv, and flushes it.
  void write(const PointSample& sample, const Configuration& configuration);
  // Writes points.csv, bins.csv, front.csv, front.md, left_out.csv, trade.toml and machine.csv.
  void finish(const TradeResult& result);

 private:
  void write_points(const TradeResult& result) const;
  void write_bins(const TradeResult& result) const;
  void write_front(const TradeResult& result) const;

  const TradeRequest& request_;
  const TradeScene& scene_;
  std::string scene_hash_;
  std::filesystem::path path_;
  record::ResultFolder folder_;
};

// Returns the front as a table for a terminal, with the notes that belong to it.
std::string front_text(const TradeResult& result, const TradeRequest& request,
                       std::size_t page_width);

}  // namespace touchstone::trade
