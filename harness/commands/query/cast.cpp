// touchstone cast: asks casts when two moving bodies first touch, and writes a row for each answer.
#include <fmt/format.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/query/proofs.h"
#include "harness/commands/query/query_rows.h"
#include "harness/commands/shared_options.h"
#include "harness/files/cases.h"
#include "harness/files/csv.h"
#include "harness/files/output_file.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"
#include "harness/process/queries/solve_cast.h"

namespace touchstone::commands {
namespace {

struct CastOptions {
  std::string cases, casts, out;
  CastSettings settings;
  std::string saved, certificates;
  double time_limit = 5;  // seconds a query
};

// The outcomes of one cast for all cases.
struct CastAnswers {
  const CastEntry* entry;
  std::vector<CastOutcome> outcomes;
};

// Solves all cases that the cast takes, in a child process. Prints the failures.
CastAnswers ask(const CastEntry& entry, const std::vector<files::CastCase>& cases,
                const CastOptions& options) {
  CastAnswers answers = {&entry, std::vector<CastOutcome>(cases.size())};
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < cases.size() && offers(entry, options.settings); ++i) {
    const files::CastCase& c = cases[i];
    if (offers(entry, c.shape_a.kind, c.shape_b.kind, process::turns(c))) taken.push_back(i);
  }
  const process::IsolationLimits limits = {.item_seconds = options.time_limit};
  const auto solved = process::isolated_answers<CastOutcome>(taken.size(), limits, [&] {
    return [&](std::size_t item) {
      return process::solve_cast(entry, options.settings, cases[taken[item]]);
    };
  });
  for (std::size_t item = 0; item < taken.size(); ++item) {
    answers.outcomes[taken[item]] = solved.answers[item];
  }
  print_failures(entry.info.name, solved.failures,
                 [&](std::size_t item) { return fmt::format("case '{}'", cases[taken[item]].id); });
  return answers;
}

void write_row(files::CsvWriter& csv, const files::CastCase& c, const CastAnswers& answers,
               const CastOutcome& outcome, const CastOptions& options) {
  csv.field(c.id).field(answers.entry->info.name).field(to_string(options.settings.scalar));
  csv.field(to_string(outcome.answer)).field(to_string(outcome.status));
  csv.field(outcome.toi).field(outcome.lower).field(outcome.upper);
  for (const Vec3d& v : {outcome.normal, outcome.point}) {
    for (const double x : v) csv.field(x + 0.0);  // no negative zero
  }
  if (outcome.iterations < 0) {
    csv.field("");
  } else {
    csv.field(outcome.iterations);
  }
  csv.end_row();
}

// Prints the number of each answer and each status of every cast.
void print_summary(const std::vector<CastAnswers>& all) {
  fmt::print("{:<28} {:>7} {:>7} {:>7}  {}\n", "cast", "hit", "miss", "unknown", "status");
  for (const CastAnswers& answers : all) {
    std::array<std::size_t, 3> counts{};
    std::map<Status, std::size_t> statuses;
    for (const CastOutcome& outcome : answers.outcomes) {
      ++counts[static_cast<std::size_t>(outcome.answer)];
      ++statuses[outcome.status];
    }
    fmt::print("{:<28} {:>7} {:>7} {:>7}  {}\n", answers.entry->info.name, counts[0], counts[1],
               counts[2], status_counts(statuses));
  }
}

// Proves the exact answer of each case that the exact cast takes, and writes one certificate a line.
void save_cast_proofs(const std::vector<files::CastCase>& cases, const CastOptions& options) {
  const CastEntry& exact = *registry::find<CastEntry>("exact");
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const files::CastCase& c = cases[i];
    if (offers(exact, c.shape_a.kind, c.shape_b.kind, process::turns(c))) taken.push_back(i);
  }
  SavedCertificates saved(options.saved);
  const auto prove = [&](std::size_t item) {
    return files::to_json(process::prove_cast(cases[taken[item]], options.settings.tolerance));
  };
  saved.add_each(
      taken.size(), options.time_limit, [&] { return prove; },
      [&](std::size_t item) { return fmt::format("case '{}'", cases[taken[item]].id); });
  saved.close();
}

int verify_cast_proofs(const CastOptions& options) {
  AskedCases asked;
  if (!options.cases.empty()) {
    for (files::CastCase& c : files::read_cast_cases(options.cases)) {
      asked.add(to_json(c));
      // A half-space is the second body in a certificate.
      std::swap(c.shape_a, c.shape_b);
      std::swap(c.pose_a, c.pose_b);
      std::swap(c.motion_a, c.motion_b);
      asked.add(to_json(c));
    }
  }
  Verdicts verdicts(options.certificates);
  return verdicts.of([&] {
    files::read_cast_certificates(
        options.certificates, [&](const files::StoredCastCertificate& stored, std::int64_t line) {
          std::string why = asked.fault(to_json(stored.of));
          if (why.empty()) why = process::fault_of(stored);
          verdicts.add(line, stored.of.id, why);
        });
  });
}

void cast(const CastOptions& options) {
  expect_without_certificates(options.cases, "CASES");
  expect_without_certificates(options.casts, "--cast");
  expect_without_certificates(options.out, "--out");
  if (!options.saved.empty() && options.settings.start == StartContact::approach) {
    throw base::InputError(
        "--save-certificates: there are proofs only of casts where contact at time 0 counts; "
        "expected --start counts");
  }
  const auto entries =
      kinds::select(registry::entries<CastEntry>(), kinds::split_names(options.casts), "cast");
  const std::vector<files::CastCase> cases = files::read_cast_cases(options.cases);
  files::check_outputs({{"CASES", options.cases}},
                       {{"--out", options.out}, {"--save-certificates", options.saved}});
  std::vector<CastAnswers> all;
  all.reserve(entries.size());
  for (const CastEntry* entry : entries) all.push_back(ask(*entry, cases, options));
  files::CsvWriter csv(options.out, {"id", "algorithm", "scalar", "answer", "status", "toi",
                                     "lower", "upper", "normal_x", "normal_y", "normal_z",
                                     "point_x", "point_y", "point_z", "iterations"});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const CastAnswers& answers : all) {
      write_row(csv, cases[i], answers, answers.outcomes[i], options);
    }
  }
  csv.close();
  print_summary(all);
  CastSettings other = options.settings;
  other.scalar = other.scalar == Precision::float64 ? Precision::float32 : Precision::float64;
  std::vector<std::string> of_other;
  for (const CastEntry* entry : entries) {
    const bool is_left_out = is_built(entry->info) && !offers(*entry, options.settings);
    if (is_left_out && offers(*entry, other)) of_other.push_back(entry->info.name);
  }
  print_scalar_hint(of_other, options.settings.scalar);
  if (!options.saved.empty()) save_cast_proofs(cases, options);
}

}  // namespace

void add_cast(Arguments command) {
  const auto options = std::make_shared<CastOptions>();
  CastSettings& settings = options->settings;
  command.text(
      "CASES", options->cases,
      "Cases: JSON, one object a line; a body may have a displacement and a rotation_vector");
  command.text("--cast", options->casts, "Casts: names joined by commas, or all (required)");
  command.one_of("--scalar", settings.scalar, scalar_choices(), "What is calculated in")
      .show_default("double");
  command
      .number("--tolerance", settings.tolerance,
              "Distance of the bodies at which a hit may be reported (metres; default: 1e-9 of "
              "their size, or "
              "what rounding hides; where that is more than was asked for, a hit without a proof "
              "is unknown)")
      .positive();
  command
      .number("--max-iterations", settings.max_iterations,
              "Greatest number of iterations of each loop of a query")
      .positive();
  const Arguments::Choices<StartContact> starts = {{"counts", StartContact::counts},
                                                   {"approach", StartContact::approach}};
  command
      .one_of("--start", settings.start, starts,
              "Whether contact at time 0 counts always, or only where the bodies approach")
      .show_default("counts");
  add_time_limit(command, options->time_limit, "Seconds that a query may take, and its proof")
      .show_default();
  command.text("--out", options->out, "The CSV file to write (required)");
  command.text(
      "--save-certificates", options->saved,
      "Also prove the exact answer of each case, where contact at time 0 counts, and write the "
      "proofs to this file");
  command.text("--certificates", options->certificates,
               "Only verify the proofs in this file, and with CASES that each is of one of them");
  command.exclude_others("--certificates", {"CASES"});
  command.job([options]() -> int {
    if (!options->certificates.empty()) return verify_cast_proofs(*options);
    cast(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands
