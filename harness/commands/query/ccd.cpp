// touchstone ccd: asks algorithms of continuous collision about moving vertices, faces and edges, and
// counts the contacts that they miss.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/campaign/selection.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/motion/ccd_queries.h"
#include "harness/process/isolate.h"

namespace touchstone::commands {
namespace {

struct CcdOptions {
  std::string queries, algorithms = "all", out;
  FeaturePair pair = FeaturePair::vertex_face;
  CcdSettings settings;
  double time_limit = 60;  // seconds a block
};

// Queries that are solved in one call. A crash or a hang costs one block.
constexpr std::size_t ccd_block_size = 512;

struct CcdContestant {
  const CcdEntry* entry;
  std::vector<CcdOutcome> outcomes;
  double seconds = 0;  // of the queries that were answered
  std::size_t answered = 0;
};

// Runs the algorithm in a child process, which has solved the first block untimed before.
void ask_ccd(CcdContestant& contestant, const CcdOptions& options,
             const std::vector<CcdQuery>& queries) {
  const std::size_t blocks = (queries.size() + ccd_block_size - 1) / ccd_block_size;
  process::SharedArray<CcdOutcome> outcomes(queries.size());
  process::SharedArray<double> seconds(blocks);
  const auto part = [&](std::size_t block) {
    const std::size_t begin = block * ccd_block_size;
    return std::pair(begin, std::min(ccd_block_size, queries.size() - begin));
  };
  const process::IsolationReport report =
      process::isolate(blocks, {.item_seconds = options.time_limit}, [&]() -> process::ItemWork {
        const std::shared_ptr<Ccd> algorithm = contestant.entry->make(options.settings);
        const auto solve = [&, algorithm](std::size_t block) {
          const auto [begin, count] = part(block);
          algorithm->solve(options.pair, std::span(queries).subspan(begin, count),
                           outcomes.span().subspan(begin, count));
        };
        return [&, solve, is_warm = false](std::size_t block) mutable {
          if (!std::exchange(is_warm, true)) solve(block);
          const base::Stopwatch stopwatch;
          solve(block);
          seconds[block] = stopwatch.seconds();
        };
      });
  contestant.outcomes.assign(outcomes.span().begin(), outcomes.span().end());
  for (std::size_t block = 0; block < blocks; ++block) {
    const auto [begin, count] = part(block);
    if (report.states[block] == process::ItemState::done) {
      contestant.seconds += seconds[block];
      contestant.answered += count;
      continue;
    }
    const Status status = process::status_of(report.states[block]);
    for (std::size_t i = begin; i < begin + count; ++i) {
      contestant.outcomes[i] = {.status = status};
    }
  }
  print_failures(contestant.entry->info.name, report.failures, [&](std::size_t block) {
    const auto [begin, count] = part(block);
    return fmt::format("queries {} to {}", begin, begin + count - 1);
  });
}

void write_ccd_outcomes(const CcdOptions& options, const std::vector<CcdContestant>& contestants,
                        std::size_t count) {
  files::CsvWriter csv(options.out, {"query", "algorithm", "answer", "toi", "status", "free_before",
                                     "contact_by", "iterations"});
  for (std::size_t i = 0; i < count; ++i) {
    for (const CcdContestant& contestant : contestants) {
      const CcdOutcome& outcome = contestant.outcomes[i];
      csv.field(i).field(contestant.entry->info.name).field(to_string(outcome.answer));
      csv.field(outcome.toi).field(to_string(outcome.status));
      csv.field(outcome.free_before).field(outcome.contact_by);
      if (outcome.iterations >= 0) {
        csv.field(outcome.iterations);
      } else {
        csv.field("");
      }
      csv.end_row();
    }
  }
  csv.close();
}

// Prints a row for each algorithm. Returns true if one that is not a peer missed a contact and stood
// by its answer.
bool print_ccd_counts(const CcdOptions& options, const std::vector<CcdContestant>& contestants,
                      const std::vector<char>& contacts) {
  base::Table table(
      {"algorithm", "hits", "misses", "unknown", "missed contacts", "false hits", "ns a query"});
  bool is_wrong = false;
  for (const CcdContestant& contestant : contestants) {
    std::size_t hits = 0, misses = 0, unknown = 0, missed = 0, false_hits = 0;
    for (std::size_t i = 0; i < contestant.outcomes.size(); ++i) {
      const CcdOutcome& outcome = contestant.outcomes[i];
      const bool is_contact = !contacts.empty() && contacts[i] != 0;
      hits += outcome.answer == CcdAnswer::hit ? 1 : 0;
      misses += outcome.answer == CcdAnswer::miss ? 1 : 0;
      unknown += outcome.answer == CcdAnswer::unknown ? 1 : 0;
      false_hits += outcome.answer == CcdAnswer::hit && !is_contact ? 1 : 0;
      if (outcome.answer != CcdAnswer::miss || !is_contact) continue;
      ++missed;
      is_wrong = is_wrong ||
                 (outcome.status == Status::ok && contestant.entry->info.origin != Origin::peer);
    }
    // The truths are those of a separation of 0.
    const bool has_false_hits = !contacts.empty() && options.settings.separation == 0;
    table.add({contestant.entry->info.name, fmt::format("{}", hits), fmt::format("{}", misses),
               fmt::format("{}", unknown), contacts.empty() ? "-" : fmt::format("{}", missed),
               has_false_hits ? fmt::format("{}", false_hits) : "-",
               contestant.answered == 0
                   ? "-"
                   : fmt::format("{:.1f}", 1e9 * contestant.seconds /
                                               static_cast<double>(contestant.answered))});
  }
  fmt::print("{}", table.text(base::page_width()));
  return is_wrong;
}

int run_ccd(const CcdOptions& options) {
  const auto entries = campaign::select(ccds(), campaign::split_names(options.algorithms),
                                        "algorithm of continuous collision");
  const files::CcdQueries read = files::read_ccd_queries(options.queries);
  files::check_output(options.out);
  if (read.rounded > 0) {
    fmt::print("{} coordinates are not doubles, and were rounded\n", read.rounded);
  }
  std::vector<CcdContestant> contestants;
  for (const CcdEntry* entry : entries) {
    contestants.push_back({entry, {}});
    ask_ccd(contestants.back(), options, read.queries);
  }
  write_ccd_outcomes(options, contestants, read.queries.size());
  const bool is_wrong = print_ccd_counts(options, contestants, read.contacts);
  return is_wrong ? exit_measured_wrong : exit_done;
}

}  // namespace

void add_ccd(Arguments command) {
  const auto options = std::make_shared<CcdOptions>();
  command
      .text(
          "QUERIES", options->queries,
          "CSV without a header, eight rows a query: the vertices at time 0, then at time 1; each "
          "coordinate a number or a numerator and a denominator; perhaps the truth (0 or 1) last")
      .required();
  command
      .one_of<FeaturePair>(
          "--kind", options->pair,
          {{"vertex-face", FeaturePair::vertex_face}, {"edge-edge", FeaturePair::edge_edge}},
          "What the four vertices are")
      .required();
  command.text("--ccd", options->algorithms, "Algorithms: names joined by commas, or all")
      .show_default();
  command
      .number("--tolerance", options->settings.tolerance,
              "Metres within which features may count as in contact")
      .not_negative()
      .show_default();
  command
      .number("--separation", options->settings.separation,
              "Metres within which features are in contact")
      .not_negative()
      .show_default();
  command
      .number("--max-iterations", options->settings.max_iterations,
              "Greatest number of steps of a query (default: each algorithm's own)")
      .positive();
  add_time_limit(command, options->time_limit,
                 fmt::format("Seconds that {} queries may take", ccd_block_size))
      .show_default();
  command.text("--out", options->out, "The CSV file to write").required();
  command.job([options] { return run_ccd(*options); });
}

}  // namespace touchstone::commands
