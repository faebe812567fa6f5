#include "harness/trade/trade_files.h"

#include <fmt/format.h>

#include <cmath>

#include "harness/base/markdown.h"
#include "harness/base/text_table.h"
#include "harness/record/machine.h"

namespace touchstone {
namespace {

const std::vector<std::string> identity = {"representation", "boxes",     "broad",         "narrow",
                                           "scalar",         "tolerance", "max_iterations"};

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void write_identity(CsvWriter& file, const Configuration& configuration) {
  const bool narrow = !configuration.narrow.empty();
  const bool broad = configuration.broad != nullptr;
  file.field(configuration.representations.name())
      .field(broad ? configuration.boxes.name() : "")
      .field(broad ? configuration.broad->info.name : "")
      .field(chain_name(configuration.narrow))
      .field(narrow ? to_string(configuration.settings.scalar) : "")
      .field(configuration.settings.tolerance.value_or(Outcome::none));
  if (configuration.settings.max_iterations) {
    file.field(*configuration.settings.max_iterations);
  } else {
    file.field("");
  }
}

void write_spread(CsvWriter& file, const Spread& spread) {
  file.field(spread.mean).field(spread.p99).field(spread.greatest);
}

void write_points(const TradeResult& result, const std::filesystem::path& path) {
  CsvWriter file(path, joined(joined({"point", "baseline", "front", "status", "words"}, identity),
                              {"error",
                               "seconds",
                               "seconds_low",
                               "seconds_high",
                               "rounds",
                               "boxes_seconds",
                               "update_seconds",
                               "find_pairs_seconds",
                               "parts_seconds",
                               "narrow_seconds",
                               "preparation_seconds",
                               "near_pairs",
                               "contacts",
                               "false_positives",
                               "false_negatives",
                               "failed",
                               "far_false_positives",
                               "wrong_share",
                               "values",
                               "value_mean",
                               "value_p99",
                               "value_greatest",
                               "volume_mean",
                               "volume_p99",
                               "volume_greatest",
                               "hausdorff_mean",
                               "hausdorff_p99",
                               "hausdorff_greatest",
                               "hulls_built",
                               "shapes_bound",
                               "boxes_computed",
                               "builds",
                               "updates",
                               "searches",
                               "pairs",
                               "settled",
                               "queries",
                               "witnesses"}));
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const TradeOutcome& point = result.points[i];
    const Evaluation& evaluation = point.evaluation;
    const bool evaluated = evaluation.status == "ok";
    file.field(point.point.configuration.name()).field(i == 0 ? 1 : 0);
    file.field(point.on_front ? 1 : 0);
    file.field(evaluated ? point.timed.status : evaluation.status);
    file.field(evaluated ? point.timed.words : evaluation.words);
    write_identity(file, point.point.configuration);
    file.field(point.error).field(point.timed.seconds).field(point.timed.low);
    file.field(point.timed.high).field(point.timed.rounds);
    for (const double seconds : point.timed.stages) {
      file.field(point.timed.rounds > 0 ? seconds : Outcome::none);
    }
    const PointErrors& errors = evaluation.errors;
    file.field(point.preparation).field(errors.near).field(errors.contacts);
    file.field(errors.false_positives).field(errors.false_negatives).field(errors.failed);
    file.field(errors.far).field(evaluated ? errors.wrong_share() : Outcome::none);
    file.field(errors.values);
    write_spread(file, errors.values > 0 ? errors.value
                                         : Spread{Outcome::none, Outcome::none, Outcome::none});
    write_spread(file, point.representation.volume);
    write_spread(file, point.representation.hausdorff);
    const PipelineCounters& c = evaluation.counters;
    for (const std::int64_t count : {c.hulls_built, c.shapes_bound, c.boxes, c.builds, c.updates,
                                     c.searches, c.pairs, c.settled, c.queries, c.witnesses}) {
      file.field(count);
    }
    file.end_row();
  }
  file.close();
}

void write_bins(const TradeResult& result, const std::filesystem::path& path) {
  CsvWriter file(path, {"point", "gap_low", "gap_high", "pairs", "false_positives",
                        "false_negatives", "failed"});
  for (const TradeOutcome& point : result.points) {
    const auto& bins = point.evaluation.errors.bins;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      if (bins[i].pairs == 0) continue;
      const GapRange range = gap_range(i);
      const bool contact = !(range.high > 0);
      const std::int64_t none = 0;
      file.field(point.point.configuration.name()).field(range.low).field(range.high);
      file.field(bins[i].pairs).field(contact ? none : bins[i].wrong);
      file.field(contact ? bins[i].wrong : none).field(bins[i].failed).end_row();
    }
  }
  file.close();
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

void write_front(const TradeResult& result, const TradeRequest& request,
                 const std::filesystem::path& folder) {
  CsvWriter file(folder / "front.csv",
                 joined({"point"}, joined(identity, {"seconds", "seconds_low", "seconds_high",
                                                     "error", "error_measure"})));
  std::string text =
      question(result, request) + ".\n\n" + stats::markdown_header(front_header(request));
  for (const std::size_t i : result.front) {
    const TradeOutcome& point = result.points[i];
    file.field(point.point.configuration.name());
    write_identity(file, point.point.configuration);
    file.field(point.timed.seconds).field(point.timed.low).field(point.timed.high);
    file.field(point.error).field(to_string(request.measure)).end_row();
    text += stats::markdown_row(front_row(point));
  }
  file.close();
  stats::write_text(folder / "front.md", text);
}

}  // namespace

TradeSamples::TradeSamples(const std::filesystem::path& path, const TradeRequest& request,
                           const TradeScene& scene, const std::vector<TradeOutcome>& points)
    : request_(&request),
      scene_(&scene),
      points_(&points),
      hash_(scene_hash(scene.scene)),
      file_(path,
            joined(joined({"campaign", "scene", "scene_hash", "seed", "bodies", "frame", "frames",
                           "task", "threads"},
                          identity),
                   {"twin", "process", "square", "round", "position", "phase", "seconds",
                    "pair_count", "pair_hash", "contact_count", "noise", "status"}),
            CsvWriter::Keep::flushed_rows) {}

void TradeSamples::write(const PointSample& sample, std::size_t point) {
  const bool ok = sample.status == "ok";
  for (std::size_t stage = 0; stage < stage_names.size(); ++stage) {
    file_.field(request_->name).field(scene_->scene.name).field(hash_);
    if (request_->overrides.seed == -1) {
      file_.field("");
    } else {
      file_.field(request_->overrides.seed);
    }
    file_.field(scene_->scene.size()).field(static_cast<std::int64_t>(sample.frame));
    file_.field(static_cast<std::int64_t>(sample.frames)).field(to_string(request_->task));
    file_.field(request_->threads);
    write_identity(file_, (*points_)[point].point.configuration);
    file_.field(sample.twin ? 1 : 0).field(sample.process).field(sample.square);
    file_.field(sample.round).field(sample.position).field(stage_names[stage]);
    file_.field(ok ? sample.reply.stages[stage] : Outcome::none);
    file_.field(sample.reply.pairs).field(fmt::format("{:016x}", sample.reply.pair_hash));
    file_.field(sample.reply.contacts).field(sample.noise).field(sample.status).end_row();
  }
  file_.flush();
}

void write_trade(const TradeResult& result, const TradeRequest& request, const TradeScene& scene,
                 const std::filesystem::path& folder) {
  write_points(result, folder / "points.csv");
  write_bins(result, folder / "bins.csv");
  write_front(result, request, folder);
  CsvWriter left_out(folder / "left_out.csv", {"reason", "combinations"});
  for (const auto& [reason, count] : result.left_out) left_out.field(reason).field(count).end_row();
  left_out.close();
  stats::write_text(folder / "trade.toml",
                    trade_toml(request, folder, "Measured by: touchstone run trade.toml"));
  write_facts({{"campaign", request.name},
               {"scene", scene.scene.name},
               {"scene_hash", scene_hash(scene.scene)},
               {"bodies", std::to_string(result.bodies)},
               {"frames", std::to_string(result.frames)},
               {"checked_frames", std::to_string(result.truth_frames)},
               {"task", std::string(to_string(request.task))},
               {"threads", std::to_string(request.threads)},
               {"error", std::string(to_string(request.measure))},
               {"twin_ratio", fmt::format("{}", result.twin)}},
              folder / "machine.csv");
}

std::string front_text(const TradeResult& result, const TradeRequest& request,
                       std::size_t page_width) {
  std::string text = question(result, request) + "\n\n";
  TextTable table(front_header(request));
  for (const std::size_t i : result.front) table.add(front_row(result.points[i]));
  text += table.text(page_width);
  std::size_t lost = 0;
  for (const TradeOutcome& point : result.points) lost += point.ok() ? 0 : 1;
  text += fmt::format("\n{} configurations: {} on the front, {} dominated, {} failed\n",
                      result.points.size(), result.front.size(),
                      result.points.size() - result.front.size() - lost, lost);
  if (std::abs(result.twin - 1) > 0.05) {
    text += fmt::format(
        "The baseline differs from its twin by a factor of {:.3f}: the machine was not quiet.\n",
        result.twin);
  }
  return text;
}

}  // namespace touchstone
