// Writes the files of a trade's folder.
#include "harness/trade/trade_files.h"

#include <fmt/format.h>

#include <cmath>

#include "harness/base/hash.h"
#include "harness/base/table.h"
#include "harness/files/text_file.h"
#include "harness/modules/modules.h"
#include "harness/record/machine.h"

namespace touchstone::trade {
namespace {

constexpr Spread no_spread = {Outcome::none, Outcome::none, Outcome::none};

record::Facts facts_of(const TradeRequest& request, const TradeScene& scene,
                       const std::string& hash) {
  record::Facts facts = {{"campaign", request.name},
                         {"scene", scene.scene.name},
                         {"scene_hash", hash},
                         {"bodies", std::to_string(scene.scene.size())},
                         {"frames", std::to_string(scene.frames.frames.size())},
                         {"task", std::string(to_string(request.task))},
                         {"threads", std::to_string(request.threads)},
                         {"executor", std::string(to_string(request.executor))},
                         {"error", std::string(to_string(request.measure))}};
  facts.insert(facts.end(), request.facts.begin(), request.facts.end());
  for (auto& fact : modules::facts()) facts.push_back(std::move(fact));
  return facts;
}

TradePointRow row_of_point(const TradeOutcome& point) {
  const Evaluation& evaluation = point.evaluation;
  TradePointRow row;
  row.point = point.point.configuration.name();
  row.on_front = point.on_front;
  row.status = to_string(evaluation.ok() ? point.timed.state : evaluation.state);
  row.words = evaluation.ok() ? point.timed.words : evaluation.words;
  row.configuration = ConfigurationNames(point.point.configuration);
  row.error = point.error;
  row.preparation = point.preparation;
  if (evaluation.ok()) row.wrong_share = evaluation.errors.wrong_share();
  row.timed = point.timed;
  if (point.timed.rounds == 0) row.timed.stages.fill(Outcome::none);
  row.errors = evaluation.errors;
  if (row.errors.values == 0) row.errors.value = no_spread;
  row.representation = point.representation;
  row.counters = evaluation.counters;
  return row;
}

std::string milliseconds(double seconds) { return fmt::format("{:.4g}", seconds * 1e3); }

std::vector<std::string> front_row(const TradeOutcome& point) {
  const PointErrors& errors = point.evaluation.errors;
  return {point.point.configuration.name(),
          milliseconds(point.timed.seconds),
          std::isnan(point.timed.low) ? "-"
                                      : fmt::format("{} to {}", milliseconds(point.timed.low),
                                                    milliseconds(point.timed.high)),
          fmt::format("{:.3g}", point.error),
          std::to_string(errors.false_positives + errors.far),
          std::to_string(errors.false_negatives),
          std::to_string(errors.failed)};
}

std::vector<std::string> front_header(const TradeRequest& request) {
  return {"configuration",  "ms a frame",
          "interval",       fmt::format("error ({})", to_string(request.measure)),
          "false contacts", "missed",
          "failed"};
}

std::string question(const TradeResult& result, const TradeRequest& request) {
  return fmt::format("{}: {} bodies, {}, {}, {} of {} frames checked, {} pairs near each other",
                     request.name, result.bodies, to_string(request.task),
                     request.threads == 1 ? "1 thread" : fmt::format("{} threads", request.threads),
                     result.truth_frames, result.frames, result.near_pairs);
}

}  // namespace

ConfigurationNames::ConfigurationNames(const Configuration& configuration)
    : representation(configuration.representations.name()),
      narrow(configuration.phases_name()),
      tolerance(configuration.settings.tolerance.value_or(Outcome::none)),
      max_iterations(configuration.settings.max_iterations) {
  if (configuration.broad != nullptr) {
    boxes = configuration.boxes.name();
    broad = configuration.broad->info.name;
  }
  if (!configuration.narrow.empty() || configuration.concave != nullptr)
    scalar = configuration.settings.scalar;
}

TradeFiles::TradeFiles(const TradeRequest& request, const TradeScene& scene,
                       const std::filesystem::path& folder)
    : request_(request),
      scene_(scene),
      scene_hash_(scene_hash(scene.scene)),
      path_(folder),
      folder_({.folder = folder,
               .files = {{"samples.csv", record::header_of<TradeSampleRow>()}},
               .identity = facts_of(request, scene, scene_hash_),
               .notes = record::machine_facts(),
               .start = record::FolderStart::overwrite,
               .work = "trade",
               .made = {"points.csv", "bins.csv", "front.csv", "front.md", "left_out.csv",
                        "trade.toml"}}) {}

void TradeFiles::write(const PointSample& from, const Configuration& configuration) {
  const measure::Round& round = from.round;
  const measure::SampleReply& reply = from.sample.reply;
  TradeSampleRow row;
  row.campaign = request_.name;
  row.scene = scene_.scene.name;
  row.scene_hash = scene_hash_;
  row.seed = request_.overrides.seed;
  row.bodies = static_cast<std::int64_t>(scene_.scene.size());
  row.frame = round.request.frame;
  row.frames = round.request.frames;
  row.task = request_.task;
  row.threads = request_.threads;
  if (request_.threads > 1) row.executor = request_.executor;
  row.configuration = ConfigurationNames(configuration);
  row.control = from.control;
  row.process = round.process;
  row.square = from.square;
  row.round = round.round;
  row.position = from.sample.position;
  row.pair_count = reply.pairs;
  row.pair_hash = base::to_hex(reply.pair_hash);
  row.contact_count = reply.contacts;
  row.noise = round.noise;
  row.status =
      to_string(from.sample.loss ? from.sample.loss->failure.state : process::ItemState::done);
  for (const std::string_view stage : stage_names) {
    row.phase = stage;
    row.seconds = reply.durations.of(stage);
    folder_.write(0, row);
  }
  folder_.writer(0).flush();
}

void TradeFiles::finish(const TradeResult& result) {
  write_points(result);
  write_bins(result);
  write_front(result);
  std::vector<LeftOutRow> left_out;
  for (const auto& [reason, count] : result.left_out) left_out.push_back({reason, count});
  record::write_rows(path_ / "left_out.csv", left_out);
  files::write_text(path_ / "trade.toml",
                    trade_toml(request_, path_, "Measured by: touchstone run trade.toml"));
  folder_.commit();
  folder_.finish({{"checked_frames", std::to_string(result.truth_frames)},
                  {"twin_ratio", fmt::format("{}", result.control)}});
}

void TradeFiles::write_points(const TradeResult& result) const {
  std::vector<TradePointRow> rows;
  for (const TradeOutcome& point : result.points) {
    rows.push_back(row_of_point(point));
    rows.back().baseline = &point == &result.points.front();
  }
  record::write_rows(path_ / "points.csv", rows);
}

void TradeFiles::write_bins(const TradeResult& result) const {
  std::vector<TradeBinRow> rows;
  for (const TradeOutcome& point : result.points) {
    const auto& bins = point.evaluation.errors.bins;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      if (bins[i].pairs == 0) continue;
      const GapRange range = gap_range(i);
      const bool contact = !(range.high > 0);
      rows.push_back({.point = point.point.configuration.name(),
                      .gap_low = range.low,
                      .gap_high = range.high,
                      .pairs = bins[i].pairs,
                      .false_positives = contact ? 0 : bins[i].wrong,
                      .false_negatives = contact ? bins[i].wrong : 0,
                      .failed = bins[i].failed});
    }
  }
  record::write_rows(path_ / "bins.csv", rows);
}

void TradeFiles::write_front(const TradeResult& result) const {
  std::vector<TradeFrontRow> rows;
  base::Table table(front_header(request_));
  for (const std::size_t i : result.front) {
    const TradeOutcome& point = result.points[i];
    rows.push_back({.point = point.point.configuration.name(),
                    .configuration = ConfigurationNames(point.point.configuration),
                    .seconds = point.timed.seconds,
                    .low = point.timed.low,
                    .high = point.timed.high,
                    .error = point.error,
                    .measure = request_.measure});
    table.add(front_row(point));
  }
  record::write_rows(path_ / "front.csv", rows);
  files::write_text(path_ / "front.md", question(result, request_) + ".\n\n" + table.markdown());
}

std::string front_text(const TradeResult& result, const TradeRequest& request,
                       std::size_t page_width) {
  std::string text = question(result, request) + "\n\n";
  base::Table table(front_header(request));
  for (const std::size_t i : result.front) table.add(front_row(result.points[i]));
  text += table.text(page_width);
  std::size_t lost = 0;
  for (const TradeOutcome& point : result.points) lost += point.ok() ? 0 : 1;
  text += fmt::format("\n{} configurations: {} on the front, {} dominated, {} failed\n",
                      result.points.size(), result.front.size(),
                      result.points.size() - result.front.size() - lost, lost);
  if (std::abs(result.control - 1) > 0.05) {
    text += fmt::format(
        "The baseline differs from its A/A control by a factor of {:.3f}: the machine was not "
        "quiet.\n",
        result.control);
  }
  return text;
}

}  // namespace touchstone::trade
