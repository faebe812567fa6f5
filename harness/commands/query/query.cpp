// touchstone query: runs narrow phases, or concave phases, on cases, and writes a row for each answer.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/file_text.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/query/parts_proofs.h"
#include "harness/commands/query/proofs.h"
#include "harness/commands/query/query_concave.h"
#include "harness/commands/query/query_rows.h"
#include "harness/commands/shared_options.h"
#include "harness/files/cases.h"
#include "harness/files/concave/concave_cases.h"
#include "harness/files/csv.h"
#include "harness/files/output_file.h"
#include "harness/geometry/shapes/compound.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"
#include "harness/process/queries/solve_case.h"

namespace touchstone::commands {
namespace {

// The tasks of narrow phases, and those of concave phases.
struct QueryTask {
  std::optional<Task> of_convex;
  std::optional<ConcaveTask> of_concave;
};

const Arguments::Choices<QueryTask>& query_tasks() {
  static const Arguments::Choices<QueryTask> choices = {
      {"intersect", {Task::intersect, ConcaveTask::intersect}},
      {"distance", {Task::distance, ConcaveTask::distance}},
      {"penetration", {Task::penetration, {}}},
      {"signed", {Task::signed_distance, {}}},
      {"contacts", {{}, ConcaveTask::contacts}}};
  return choices;
}

struct QueryOptions {
  std::string cases, narrow, out, id, pairs, contacts;
  bool welded = false;
  std::string mid = "wide-bvh", parts = "certified";
  std::string saved, certificates;  // files of proofs; none if empty
  std::optional<QueryTask> given;
  QueryTask asked = query_tasks()[0].second;
  Task task = Task::intersect;  // of narrow phases
  NarrowPhaseSettings settings;
  double time_limit = 5;  // seconds a query
};

// The options that not every case and task heeds.
struct HeededBySome {
  Option margin, duality_gap, mid, parts;
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

// Returns the cases of the file, or those with the identifier that was asked for.
std::vector<files::ConcaveCase> asked_cases(const QueryOptions& options) {
  files::MeshFiles meshes;
  std::vector<files::ConcaveCase> cases = files::read_concave_cases(options.cases, &meshes);
  for (const auto& [file, body] : meshes.all()) {
    tell_extent(file, body->mesh ? body->mesh->vertices : geometry::surface_of(*body).vertices);
  }
  if (options.id.empty()) return cases;
  std::erase_if(cases, [&](const files::ConcaveCase& c) { return c.id != options.id; });
  if (cases.empty()) {
    throw base::InputError(fmt::format("{}: has no case '{}'; expected the id of one for --id",
                                       options.cases, options.id));
  }
  return cases;
}

// True if concave phases are asked: a body is not convex, the task is theirs alone, or so is a name.
bool asks_concave_phases(const QueryOptions& options,
                         const std::vector<files::ConcaveCase>& cases) {
  if (!options.asked.of_convex) return true;
  if (!std::ranges::all_of(cases, &files::ConcaveCase::is_convex)) return true;
  return std::ranges::any_of(kinds::split_names(options.narrow), [](const std::string& name) {
    return registry::find<ConcaveEntry>(name) != nullptr &&
           registry::find<NarrowPhaseEntry>(name) == nullptr;
  });
}

[[noreturn]] void refuse_task(const QueryOptions& options,
                              const std::vector<files::ConcaveCase>& cases) {
  const std::string message = fmt::format(
      "--task {}, which concave phases do not answer; expected intersect, distance or contacts",
      to_string(*options.asked.of_convex));
  const auto concave = std::ranges::find(cases, false, &files::ConcaveCase::is_convex);
  if (concave == cases.end()) {
    throw base::InputError(
        fmt::format("--narrow {} names concave phases, with {}", options.narrow, message));
  }
  throw base::InputError(options.cases, concave->line,
                         fmt::format("case '{}' has a mesh or a compound, with {}",
                                     base::shortened(concave->id), message));
}

void ask_concave_phases(const QueryOptions& options, const HeededBySome& heeded,
                        const std::vector<files::ConcaveCase>& cases) {
  if (!options.asked.of_concave) refuse_task(options, cases);
  expect_not_given({heeded.margin, heeded.duality_gap},
                   "with convex shapes and narrow phases alone");
  query_concave({.names = options.narrow,
                 .task = *options.asked.of_concave,
                 .scalar = options.settings.scalar,
                 .mid = options.mid,
                 .parts = options.parts,
                 .settings = {.tolerance = options.settings.tolerance,
                              .max_iterations = options.settings.max_iterations},
                 .time_limit = options.time_limit,
                 .cases = options.cases,
                 .out = options.out,
                 .pairs = options.pairs,
                 .contacts = options.contacts,
                 .welds = options.welded},
                cases);
}

void ask_narrow_phases(const QueryOptions& options, const std::vector<files::Case>& cases) {
  const auto entries = kinds::select(registry::entries<NarrowPhaseEntry>(),
                                     kinds::split_names(options.narrow), "narrow phase");
  for (const NarrowPhaseEntry* entry : entries) {
    if (!options.settings.duality_gap || entry->traits.stops_by_duality_gap) continue;
    throw base::InputError(
        fmt::format("--duality-gap was given for '{}', which does not stop by it; "
                    "expected only {}",
                    entry->info.name, kinds::names_stopping_by_duality_gap()));
  }
  files::check_outputs({{"CASES", options.cases}}, {{"--out", options.out}});
  std::vector<Answers> all;
  all.reserve(entries.size());
  for (const NarrowPhaseEntry* entry : entries) all.push_back(ask(*entry, cases, options));
  files::CsvWriter csv(options.out, query_columns());
  QuerySummary summary;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const Answers& answers : all) {
      write_query_fields(csv,
                         {cases[i].id, answers.entry->info.name, to_string(options.settings.scalar),
                          to_string(options.task)},
                         answers.outcomes[i]);
      csv.end_row();
      summary.count(answers.entry->info.name, answers.outcomes[i]);
    }
  }
  csv.close();
  summary.print();
}

void check_saved(const QueryOptions& options) {
  if (options.saved.empty()) return;
  if (!options.asked.of_concave) {
    throw base::InputError(fmt::format(
        "--save-certificates was given with --task {}; expected intersect, distance or contacts",
        to_string(*options.asked.of_convex)));
  }
  files::check_outputs({{"CASES", options.cases}}, {{"--out", options.out},
                                                    {"--pairs", options.pairs},
                                                    {"--contacts", options.contacts},
                                                    {"--save-certificates", options.saved}});
}

void query(QueryOptions& options, const HeededBySome& heeded,
           const std::vector<files::ConcaveCase>& cases) {
  if (!options.pairs.empty() && options.asked.of_convex) {
    throw base::InputError("--pairs was given; expected it with --task contacts alone");
  }
  if (!options.contacts.empty() && options.asked.of_convex) {
    throw base::InputError("--contacts was given; expected it with --task contacts alone");
  }
  if (options.welded && options.contacts.empty()) {
    throw base::InputError("--welded was given; expected it with --contacts alone");
  }
  if (asks_concave_phases(options, cases)) return ask_concave_phases(options, heeded, cases);
  expect_not_given({heeded.mid, heeded.parts}, "with meshes, compounds or concave phases alone");
  options.task = *options.asked.of_convex;
  if (options.task != Task::distance && options.task != Task::signed_distance) {
    expect_not_given({heeded.margin, heeded.duality_gap}, "with --task distance or signed alone");
  }
  std::vector<files::Case> convex;
  convex.reserve(cases.size());
  for (const files::ConcaveCase& c : cases) convex.push_back(convex_case(c));
  ask_narrow_phases(options, convex);
}

void query(QueryOptions& options, const HeededBySome& heeded) {
  expect_without_certificates(options.cases, "CASES");
  expect_without_certificates(options.narrow, "--narrow");
  expect_without_certificates(options.given ? "given" : "", "--task");
  expect_without_certificates(options.out, "--out");
  options.asked = *options.given;
  const std::vector<files::ConcaveCase> cases = asked_cases(options);
  check_saved(options);
  query(options, heeded, cases);
  if (options.saved.empty()) return;
  save_parts_proofs(options.saved, *options.asked.of_concave, cases, options.time_limit);
}

}  // namespace

void add_query(Arguments command) {
  const auto options = std::make_shared<QueryOptions>();
  NarrowPhaseSettings& settings = options->settings;
  command.text("CASES", options->cases, "Cases: JSON, one object a line (required)");
  command.text(
      "--narrow", options->narrow,
      "Narrow phases: names joined by commas, or all; for meshes and compounds, concave phases "
      "(required)");
  command.one_of("--task", options->given, query_tasks(), "What is asked (required)");
  command.text("--id", options->id, "Asks the cases with this id alone");
  command.one_of("--scalar", settings.scalar, scalar_choices(), "What is calculated in")
      .show_default("double");
  const Option tolerance =
      command
          .number("--tolerance", settings.tolerance,
                  "Error of a distance at which to stop, as a part of the pair's size; in concave "
                  "phases, of pairs of convex parts")
          .positive();
  const Option duality_gap =
      command
          .number(
              "--duality-gap", settings.duality_gap,
              "Narrow phases: stop a distance by the absolute duality gap of its square instead "
              "(square metres)")
          .positive()
          .excludes(tolerance);
  const Option margin =
      command
          .number("--margin", settings.margin,
                  "Narrow phases: bodies further apart than this get no distance (metres)")
          .not_negative();
  command
      .number("--max-iterations", settings.max_iterations,
              "Greatest number of iterations of each loop of a query; in concave phases, of a pair "
              "of convex parts, by --parts other than certified, which has none")
      .positive();
  add_time_limit(command, options->time_limit, "Seconds that a query may take, and its proof")
      .show_default();
  command.text("--out", options->out, "The CSV file to write (required)");
  command.text("--pairs", options->pairs,
               "With --task contacts: the CSV file of the pairs of parts that share a point");
  command.text("--contacts", options->contacts,
               "With --task contacts: the CSV file of these pairs' normals, depths and points");
  command.flag(
      "--welded", options->welded,
      "With --contacts: where neighbours of a triangle are in the way of a normal, the contact "
      "has that of the nearest face around it, on the side of the other body's origin");
  const Option mid =
      command.text("--mid", options->mid, "Concave phases: the mid-phase that finds pairs of parts")
          .show_default();
  const Option parts = command
                           .text("--parts", options->parts,
                                 "Concave phases: the narrow phase for pairs of convex parts")
                           .show_default();
  command.text("--save-certificates", options->saved,
               "With --task intersect, distance or contacts: also prove the exact answer of each "
               "case, and write the proofs to this file");
  command.text("--certificates", options->certificates,
               "Only verify the proofs in this file, and with CASES that each is of one of them");
  command.exclude_others("--certificates", {"CASES"});
  command.job([options, heeded = HeededBySome{margin, duality_gap, mid, parts}]() -> int {
    if (!options->certificates.empty()) {
      return verify_parts_proofs(options->certificates, options->cases);
    }
    query(*options, heeded);
    return exit_done;
  });
}

}  // namespace touchstone::commands
