// Reads lists of scenes, and writes the files of advice and of its verification.
#include "harness/trade/advice/advice_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <type_traits>

#include "harness/base/table.h"
#include "harness/files/text_file.h"
#include "harness/files/toml_table.h"
#include "harness/record/machine.h"

namespace touchstone::trade {

// verification.csv: one scene.
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

namespace {

AdviceTask read_task(files::TomlTable& table, const std::filesystem::path& folder,
                     const TradeRequest& usual) {
  AdviceTask task;
  TradeRequest& request = task.request = usual;
  request.scene = (folder / table.text("file")).lexically_normal();
  if (!std::filesystem::is_regular_file(request.scene)) {
    table.fail("file", fmt::format("found \"{}\", which is no file; expected a scene",
                                   request.scene.string()));
  }
  task.name = files::folder_name(table, request.scene);
  request.name = files::folder_name(table, request.scene, "-advice");
  request.task =
      static_cast<Task>(table.choice("task", traded_tasks, static_cast<std::size_t>(usual.task)));
  request.measure = static_cast<ErrorMeasure>(table.choice(
      "error", error_measure_names, static_cast<std::size_t>(default_measure(request.task))));
  task.budget.most = table.number("max_error", files::not_negative, task.budget.most);
  task.budget.no_false_negatives = table.boolean("no_false_negatives", false);
  table.finish();
  return task;
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

// What is added to the bodies and lost of them by what stands for them, such as ": adds 92 % of a body's volume".
std::string volume_text(const Representations& representations, StandInLibrary& library) {
  double added = 0, lost = 0, most = 0;
  std::size_t bodies = 0;
  for (const proxies::RepresentationError& error : library.errors(representations)) {
    if (!std::isfinite(error.added) || error.volume_error() == 0) continue;
    ++bodies;
    added += error.added;
    lost += error.lost;
    most = std::max(most, error.added);
  }
  if (bodies == 0) return "";
  const auto mean = [&](double sum) { return sum / static_cast<double>(bodies); };
  std::string text = fmt::format(": adds {} of a body's volume", percent(mean(added)));
  if (most > mean(added)) text += fmt::format(" (at most {})", percent(most));
  if (lost > 0) text += fmt::format(", loses {}", percent(mean(lost)));
  return text;
}

std::string describe(const TradeOutcome& outcome, const AdviceProblem& problem) {
  const Configuration& c = outcome.point.configuration;
  const PointErrors& errors = outcome.evaluation.errors;
  const PipelineCounters& work = outcome.evaluation.counters;
  std::string text = fmt::format("  bodies as      {}{}\n", c.representations.name(),
                                 volume_text(c.representations, problem.scene.library));
  if (c.broad != nullptr) {
    text += fmt::format("  boxes          {}\n  broad phase    {}\n", c.boxes.name(),
                        c.broad->info.name);
  }
  text += fmt::format("  narrow phase   {}\n", c.narrow_name());
  text += fmt::format("  preparation    {:.3g} s before the first frame\n", outcome.preparation);
  text += fmt::format(
      "  error          {:.3g} ({}): of {} pairs near each other {} false contacts, {} missed, {} "
      "without an answer\n",
      outcome.error, to_string(problem.request.measure), errors.near,
      errors.false_positives + errors.far, errors.false_negatives, errors.failed);
  text += fmt::format(
      "  needs          {} hulls built, {} shapes bound; for the frames looked at {} updates, {} "
      "queries, {} witness points\n",
      work.hulls_built, work.shapes_bound, work.updates, work.queries, work.witnesses);
  return text;
}

// What the tests say of all pairs, a line for each part of the budget.
std::string tested_text(const Advice& advice, const ErrorBudget& budget) {
  std::string text;
  const std::string on = advice.held_out.empty() ? "the scene" : advice.held_out_on;
  for (const Evidence& one : advice.evidence) {
    text += fmt::format("  tested         {} of {} {} wrong on {}: at most {} of all (95 %)",
                        one.wrong, one.of, one.what, on, percent(one.upper()));
    text += budget.most == 0 || one.what != "pairs"
                ? "\n"
                : fmt::format(", and {} may be\n", percent(budget.most));
  }
  if (budget.most == 0 && !advice.evidence.empty()) {
    text += "                 no test can show 0: this is what was shown\n";
  }
  return text;
}

struct NamedRow {
  std::string_view shown, role;
  const TradeOutcome* outcome;
};

std::vector<NamedRow> rows_of(const Advice& advice) {
  std::vector<NamedRow> rows;
  if (advice.untested) rows.push_back({"not tested enough", "untested", &*advice.untested});
  if (!advice.best) return rows;
  const bool has_library = uses_library(advice.best->point.configuration);
  rows.push_back(
      {has_library ? "cheapest, with a library" : "cheapest", "cheapest", &*advice.best});
  if (advice.next_better) rows.push_back({"next better", "next better", &*advice.next_better});
  if (advice.rival) {
    rows.push_back({has_library ? "best of ours alone" : "best with a library",
                    has_library ? "ours" : "library", &*advice.rival});
  }
  return rows;
}

double ratio_of(const TradeOutcome& outcome, const Advice& advice) {
  return advice.best ? outcome.timed.seconds / advice.best->timed.seconds : Outcome::none;
}

// A row for each configuration that is named, with how many times the time of the cheapest it takes, and below their
// names and what stands for the bodies in them.
std::string times_text(const Advice& advice, const AdviceProblem& problem) {
  base::Table table({"", "ms a frame", "interval", "times the cheapest",
                     fmt::format("error ({})", to_string(problem.request.measure))});
  std::string names;
  for (const auto& [shown, role, outcome] : rows_of(advice)) {
    const TimedPoint& timed = outcome->timed;
    const double ratio = ratio_of(*outcome, advice);
    table.add({std::string(shown), fmt::format("{:.4g}", timed.seconds * 1e3),
               std::isnan(timed.low)
                   ? "-"
                   : fmt::format("{:.4g} to {:.4g}", timed.low * 1e3, timed.high * 1e3),
               std::isnan(ratio) ? "-" : fmt::format("{:.3g}", ratio),
               fmt::format("{:.3g}", outcome->error)});
    if (role == "cheapest") continue;
    const Configuration& configuration = outcome->point.configuration;
    names += fmt::format("{}: {}{}\n", shown, configuration.name(),
                         volume_text(configuration.representations, problem.scene.library));
  }
  return table.text(base::page_width()) + (names.empty() ? "" : "\n" + names);
}

std::string libraries_text(const Advice& advice) {
  if (!advice.best || advice.rival) return "";
  if (uses_library(advice.best->point.configuration)) {
    return "Without a library nothing that was tried meets the budget.\n";
  }
  if (advice.with_library == 0) return "No configuration with a library was tried.\n";
  if (std::isnan(advice.least_library_error)) {
    return fmt::format("All of the {} configurations with a library failed.\n",
                       advice.with_library);
  }
  return fmt::format(
      "No library meets the budget: of {} configurations with one the least error is {:.3g}.\n",
      advice.with_library, advice.least_library_error);
}

std::vector<double> errors_of(const std::vector<HeldOutGrade>& grades) {
  std::vector<double> errors;
  for (const HeldOutGrade& grade : grades) errors.push_back(grade.error);
  return errors;
}

std::string errors_text(const std::vector<HeldOutGrade>& grades) {
  return fmt::format("{:.3g}", fmt::join(errors_of(grades), ", "));
}

}  // namespace

std::string advice_text(const Advice& advice, const AdviceProblem& problem) {
  const TradeRequest& request = problem.request;
  std::string text =
      fmt::format("{}: {}; {} configurations, {} within the budget, {} timed\n\n",
                  problem.scene.scene.name, to_string(problem.budget, request.measure),
                  advice.configurations, advice.within_budget, advice.timed);
  if (!advice.best && !advice.untested) return text + "Nothing that was tried meets the budget.\n";
  if (!advice.best) {
    text += fmt::format("Cannot know: {}.\n\n", lack_of(advice.evidence, !advice.held_out.empty()));
    return text + times_text(advice, problem);
  }
  text += fmt::format("Cheapest: {}\n{}{}", advice.best->point.configuration.name(),
                      describe(*advice.best, problem), tested_text(advice, problem.budget));
  text += "\n" + times_text(advice, problem) + libraries_text(advice);
  return advice.next_better ? text : text + "Nothing that was tried is better.\n";
}

std::vector<AdviceTask> read_advice_list(const std::filesystem::path& file,
                                         const TradeRequest& usual) {
  const toml::table root = files::parse_toml(file);
  files::TomlTable top(root, file.string(), "");
  std::vector<AdviceTask> tasks;
  std::set<std::string> names;
  for (files::TomlTable& table : top.tables("scene")) {
    tasks.push_back(read_task(table, file.parent_path(), usual));
    if (!names.insert(tasks.back().name).second) {
      table.fail("name", fmt::format("\"{}\" is there twice; expected another name for one of them",
                                     tasks.back().name));
    }
  }
  top.finish();
  return tasks;
}

void write_advice(const Advice& advice, const AdviceProblem& problem,
                  const std::filesystem::path& folder) {
  files::write_text(folder / "advice.txt", advice_text(advice, problem));
  std::vector<AdviceRow> rows;
  for (const auto& [shown, role, outcome] : rows_of(advice)) {
    AdviceRow& row = rows.emplace_back();
    row.role = role;
    row.point = outcome->point.configuration.name();
    row.configuration = ConfigurationNames(outcome->point.configuration);
    row.seconds = outcome->timed.seconds;
    row.low = outcome->timed.low;
    row.high = outcome->timed.high;
    row.ratio = ratio_of(*outcome, advice);
    row.error = outcome->error;
    row.measure = problem.request.measure;
    if (rows.size() > 1 || advice.evidence.empty()) continue;
    row.wrong = advice.evidence.front().wrong;
    row.of = advice.evidence.front().of;
    row.upper = advice.evidence.front().upper();
  }
  record::write_rows(folder / "advice.csv", rows);
  if (!advice.best) return;
  TradeRequest request = problem.request;
  request.grids = {grid_of(advice.best->point.configuration)};
  if (advice.next_better) request.grids.push_back(grid_of(advice.next_better->point.configuration));
  files::write_text(folder / "advice.toml",
                    trade_toml(request, folder,
                               "The cheapest with " + to_string(problem.budget, request.measure) +
                                   ", and the next better behind it.\n"
                                   "Measured by: touchstone run advice.toml"));
}

std::string verification_text(const Verification& v) {
  std::string text = v.holds() ? "Verified: " : "Not verified: ";
  text += fmt::format("the error is {:.3g} on the scene", v.choice.error);
  if (v.held_out.empty()) {
    text += fmt::format(", and there is {}", v.held_out_on);
  } else {
    text += fmt::format(" and {} on {}", errors_text(v.held_out), v.held_out_on);
  }
  text += fmt::format(", {} the budget. Of {} configurations {} others are within it",
                      v.within_budget ? "within" : "not within", v.configurations, v.rivals);
  if (v.dropped > 0) text += fmt::format(", of which at least {} fail elsewhere", v.dropped);
  if (v.best.empty()) return text + ".\n";
  return text + fmt::format(
                    "; the fastest is {}. The choice takes {:.3f} ({:.3f} to {:.3f}) times "
                    "its time: {}.\n",
                    v.best, v.ratio.median, v.ratio.low, v.ratio.high,
                    v.time == TimeVerdict::within   ? "within 10 %"
                    : v.time == TimeVerdict::beyond ? "beyond 10 %"
                                                    : "not known to be within 10 %");
}

VerificationRows::VerificationRows(const std::filesystem::path& folder, int draws)
    : draws_(draws),
      folder_({.folder = folder,
               .files = {{"verification.csv", record::header_of<VerificationRow>(draws)}},
               .identity = {{"held_out_scenes", std::to_string(draws)}},
               .notes = record::machine_facts(),
               .start = record::FolderStart::overwrite,
               .work = "verification"}) {}

void VerificationRows::write(const AdviceProblem& problem, const Verification* verification) {
  VerificationRow row;
  const scene::Scene& scene = problem.scene.scene;
  row.scene = scene.name;
  row.scene_hash = scene_hash(scene);
  row.bodies = static_cast<std::int64_t>(scene.size());
  row.task = problem.request.task;
  row.threads = problem.request.threads;
  if (row.threads > 1) row.executor = problem.request.executor;
  row.measure = problem.request.measure;
  row.max_error = problem.budget.most;
  row.no_false_negatives = problem.budget.no_false_negatives;
  if (verification != nullptr) {
    const Verification& v = *verification;
    row.choice = v.choice.point.configuration.name();
    row.error = v.choice.error;
    if (!v.held_out.empty()) row.held_out = v.held_out_on;
    row.errors = errors_of(v.held_out);
    row.within_budget = v.within_budget ? YesNo::yes : YesNo::no;
    row.configurations = static_cast<std::int64_t>(v.configurations);
    row.rivals = static_cast<std::int64_t>(v.rivals);
    row.dropped = static_cast<std::int64_t>(v.dropped);
    row.seconds = v.seconds;
    row.best = v.best;
    row.best_seconds = v.best_seconds;
    row.ratio = v.ratio.median;
    row.ratio_low = v.ratio.low;
    row.ratio_high = v.ratio.high;
    row.rounds = static_cast<std::int64_t>(v.ratio.n);
    row.within_time = v.time;
    row.verified = v.holds() ? YesNo::yes : YesNo::no;
  }
  folder_.write(0, row, draws_);
  folder_.commit();
}

}  // namespace touchstone::trade
