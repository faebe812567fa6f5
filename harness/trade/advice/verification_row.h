// The rows of verification.csv: one scene each.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "harness/record/row.h"
#include "harness/trade/advice/verification.h"

namespace touchstone::trade {

enum class YesNo : std::uint8_t { no, yes };
inline std::string_view to_string(YesNo answer) { return answer == YesNo::yes ? "yes" : "no"; }

struct VerificationRow {
  std::string scene, scene_hash;
  std::int64_t bodies = 0;
  Task task = Task::intersect;
  std::int64_t threads = 0;
  std::optional<ExecutorKind> executor;  // empty: one thread, or it is not known
  ErrorMeasure measure = ErrorMeasure::verdicts;
  double max_error = 0;
  bool no_false_negatives = false;
  std::string choice;
  double error = Outcome::none;
  std::string held_out;
  std::vector<double> errors;  // one value for each held-out scene
  YesNo within_budget = YesNo::no;
  std::int64_t configurations = 0, rivals = 0, dropped = 0;
  double seconds = Outcome::none;
  std::string best;
  double best_seconds = Outcome::none;
  double ratio = Outcome::none, ratio_low = Outcome::none, ratio_high = Outcome::none;
  std::int64_t rounds = 0;
  TimeVerdict within_time = TimeVerdict::undecided;
  YesNo verified = YesNo::no;
};
template <record::row_of<VerificationRow> Row, class Visit>
void columns(Row& row, Visit visit, int held_out_scenes) {
  visit("scene", row.scene, "Name of the scene.");
  visit("scene_hash", row.scene_hash, "Fingerprint of the scene's content.");
  visit("bodies", row.bodies, "Bodies of the scene.");
  visit("task", row.task, "Task of the narrow phases.");
  visit("threads", row.threads, "Threads.");
  visit("executor", record::newer(row.executor),
        "Whose threads they are, if several: those of our `crew` or of `onetbb`.");
  visit("error_measure", row.measure, "What counts as the error of a configuration.");
  visit("max_error", row.max_error, "Greatest error that was allowed.");
  visit("no_false_negatives", row.no_false_negatives, "1: no contact may be missed.");
  visit("choice", row.choice, "The configuration that was chosen; empty where none will do.");
  visit("error", row.error, "Its error on the scene.");
  visit("held_out", row.held_out, "The scenes that the choice was not made on.");
  for (int i = 0; i < held_out_scenes; ++i) {
    const auto place = static_cast<std::size_t>(i);
    double none = Outcome::none;
    if constexpr (!std::is_const_v<Row>) row.errors.resize(std::max(row.errors.size(), place + 1));
    visit(fmt::format("error_{}", i + 1), place < row.errors.size() ? row.errors[place] : none,
          "Its error on that held-out scene.");
  }
  visit("within_budget", row.within_budget, "The errors are allowed, on all of these scenes.");
  visit("configurations", row.configurations, "Configurations of the full grid.");
  visit("rivals", row.rivals, "Those that are within the budget, without the choice.");
  visit("rivals_dropped", row.dropped, "Those of them that were found to fail on held-out scenes.");
  visit("seconds", row.seconds, "Time of the choice, seconds a frame.");
  visit("best", row.best, "The fastest other that is within the budget on all scenes.");
  visit("best_seconds", row.best_seconds, "Its time, seconds a frame, in the same rounds.");
  visit("ratio", row.ratio, "Time of the choice over that of the best.");
  visit("ratio_low", row.ratio_low, "Lower end of its 95 % interval.");
  visit("ratio_high", row.ratio_high, "Upper end of its 95 % interval.");
  visit("rounds", row.rounds, "Rounds that the ratio is of.");
  visit("within_time", row.within_time, "The choice is at most 10 % slower than the best.");
  visit("verified", row.verified, "It is within the budget and within the time.");
}

}  // namespace touchstone::trade
