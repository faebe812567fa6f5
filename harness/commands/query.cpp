// touchstone query: runs narrow phases on cases, and writes a row for each answer.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/campaign/selection.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/cases.h"
#include "harness/files/csv.h"
#include "harness/process/isolate.h"
#include "harness/process/queries/solve_case.h"

namespace touchstone::commands {
namespace {

struct QueryOptions {
  std::string cases, narrow, out, id;
  Task task = Task::intersect;
  NarrowPhaseSettings settings;
  double time_limit = 5;  // seconds a query
};

// The outcomes of one algorithm for all cases.
struct Answers {
  const NarrowPhaseEntry* entry;
  std::vector<Outcome> outcomes;
};

// Solves all cases that the algorithm takes, in a child process. Prints the failures.
Answers ask(const NarrowPhaseEntry& entry, const std::vector<files::Case>& cases,
            const QueryOptions& options) {
  Answers answers = {&entry, std::vector<Outcome>(cases.size())};
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < cases.size() && offers(entry, options.settings.scalar); ++i) {
    if (offers(entry, cases[i].shape_a.kind, cases[i].shape_b.kind, options.task)) {
      taken.push_back(i);
    }
  }
  const process::IsolationLimits limits = {.item_seconds = options.time_limit};
  const auto solved = process::isolated_answers<Outcome>(taken.size(), limits, [&] {
    return [&](std::size_t item) {
      return process::solve_case(entry, options.settings, cases[taken[item]], options.task);
    };
  });
  for (std::size_t item = 0; item < taken.size(); ++item) {
    answers.outcomes[taken[item]] = solved.answers[item];
  }
  print_failures(entry.info.name, solved.failures,
                 [&](std::size_t item) { return fmt::format("case '{}'", cases[taken[item]].id); });
  return answers;
}

void write_row(files::CsvWriter& csv, const files::Case& c, const Answers& answers,
               const Outcome& outcome, const QueryOptions& options) {
  csv.field(c.id).field(answers.entry->info.name);
  csv.field(to_string(options.settings.scalar)).field(to_string(options.task));
  csv.field(to_string(outcome.answer)).field(to_string(outcome.status));
  csv.field(outcome.distance).field(outcome.lower).field(outcome.upper);
  for (const Vec3d& v : {outcome.normal, outcome.witness_a, outcome.witness_b}) {
    for (const double x : v) csv.field(x);
  }
  for (const std::int32_t count : {outcome.iterations, outcome.support_calls}) {
    if (count < 0) {
      csv.field("");
    } else {
      csv.field(count);
    }
  }
  csv.end_row();
}

// Prints the number of each answer and each status of every algorithm.
void print_summary(const std::vector<Answers>& all) {
  fmt::print("{:<28} {:>9} {:>8} {:>11} {:>7}  {}\n", "algorithm", "separated", "touching",
             "overlapping", "unknown", "status");
  for (const Answers& answers : all) {
    std::array<std::size_t, 4> counts{};
    std::map<Status, std::size_t> statuses;
    for (const Outcome& outcome : answers.outcomes) {
      ++counts[static_cast<std::size_t>(outcome.answer)];
      ++statuses[outcome.status];
    }
    std::string text;
    for (const auto& [status, count] : statuses) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", to_string(status), count);
    }
    fmt::print("{:<28} {:>9} {:>8} {:>11} {:>7}  {}\n", answers.entry->info.name, counts[0],
               counts[1], counts[2], counts[3], text);
  }
}

// Returns the cases of the file, or those with the identifier that was asked for.
std::vector<files::Case> asked_cases(const QueryOptions& options) {
  std::vector<files::Case> cases = files::read_cases(options.cases);
  if (options.id.empty()) return cases;
  std::erase_if(cases, [&](const files::Case& c) { return c.id != options.id; });
  if (cases.empty()) {
    throw base::InputError(fmt::format("{}: has no case '{}'; expected the id of one for --id",
                                       options.cases, options.id));
  }
  return cases;
}

void query(const QueryOptions& options) {
  const auto entries =
      campaign::select(narrow_phases(), campaign::split_names(options.narrow), "narrow phase");
  for (const NarrowPhaseEntry* entry : entries) {
    if (!options.settings.duality_gap || entry->traits.stops_by_duality_gap) continue;
    throw base::InputError(
        fmt::format("--duality-gap was given for '{}', which does not stop by it; "
                    "expected only {}",
                    entry->info.name, campaign::names_stopping_by_duality_gap()));
  }
  const std::vector<files::Case> cases = asked_cases(options);
  files::check_output(options.out);
  std::vector<Answers> all;
  all.reserve(entries.size());
  for (const NarrowPhaseEntry* entry : entries) all.push_back(ask(*entry, cases, options));
  files::CsvWriter csv(
      options.out,
      {"id",    "algorithm", "scalar",   "task",     "answer",     "status",       "distance",
       "lower", "upper",     "normal_x", "normal_y", "normal_z",   "a_x",          "a_y",
       "a_z",   "b_x",       "b_y",      "b_z",      "iterations", "support_calls"});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const Answers& answers : all) {
      write_row(csv, cases[i], answers, answers.outcomes[i], options);
    }
  }
  csv.close();
  print_summary(all);
}

}  // namespace

void add_query(Arguments command) {
  const auto options = std::make_shared<QueryOptions>();
  NarrowPhaseSettings& settings = options->settings;
  command.text("CASES", options->cases, "Cases: JSON, one object a line").required();
  command.text("--narrow", options->narrow, "Narrow phases: names joined by commas, or all")
      .required();
  command.one_of("--task", options->task, task_choices(), "What is asked").required();
  command.text("--id", options->id, "Asks the cases with this id alone");
  command.one_of("--scalar", settings.scalar, scalar_choices(), "What is calculated in")
      .show_default("double");
  command
      .number("--tolerance", settings.tolerance,
              "Error of a distance at which to stop, as a part of the pair's size")
      .positive();
  command
      .number("--duality-gap", settings.duality_gap,
              "Stop a distance by the absolute duality gap of its square instead (square metres)")
      .positive();
  command
      .number("--margin", settings.margin,
              "Bodies further apart than this get no distance (metres)")
      .not_negative();
  command
      .number("--max-iterations", settings.max_iterations,
              "Greatest number of iterations of each loop of a query")
      .positive();
  add_time_limit(command, options->time_limit).show_default();
  command.text("--out", options->out, "The CSV file to write").required();
  command.job([options] {
    query(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands
