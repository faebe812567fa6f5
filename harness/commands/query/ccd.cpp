// touchstone ccd: asks algorithms of continuous collision about moving vertices, faces and edges, and
// counts the contacts that they miss.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
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
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/motion/ccd_queries.h"
#include "harness/files/output_file.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"

namespace touchstone::commands {
namespace {

struct CcdOptions {
  std::string queries, algorithms = "all", out;
  std::optional<FeaturePair> pair;  // a folder's files say theirs
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
void ask_ccd(CcdContestant& contestant, const CcdOptions& options, FeaturePair pair,
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
          algorithm->solve(pair, std::span(queries).subspan(begin, count),
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

// What an algorithm answered to some files, and how that holds against the truths in them.
struct CcdCounts {
  std::size_t queries = 0, hits = 0, misses = 0, unknown = 0, missed = 0, false_hits = 0;
  std::size_t answered = 0;
  double seconds = 0;  // of the queries that were answered
  bool has_truth = true;
  bool is_wrong = false;  // missed a contact and stood by its answer

  void add(const CcdContestant& contestant, const std::vector<char>& contacts) {
    for (std::size_t i = 0; i < contestant.outcomes.size(); ++i) {
      const CcdOutcome& outcome = contestant.outcomes[i];
      const bool is_contact = !contacts.empty() && contacts[i] != 0;
      ++queries;
      hits += outcome.answer == CcdAnswer::hit ? 1 : 0;
      misses += outcome.answer == CcdAnswer::miss ? 1 : 0;
      unknown += outcome.answer == CcdAnswer::unknown ? 1 : 0;
      false_hits += outcome.answer == CcdAnswer::hit && !is_contact ? 1 : 0;
      if (outcome.answer != CcdAnswer::miss || !is_contact) continue;
      ++missed;
      is_wrong = is_wrong || outcome.status == Status::ok;
    }
    answered += contestant.answered;
    seconds += contestant.seconds;
    has_truth = has_truth && !contacts.empty();
  }
};

std::string ccd_kind(FeaturePair pair) {
  return pair == FeaturePair::vertex_face ? "vertex-face" : "edge-edge";
}

// Asks the algorithms about files, one after the other, and writes and counts their answers.
class CcdJob {
 public:
  CcdJob(const CcdOptions& options, std::vector<const CcdEntry*> entries, bool is_folder)
      : options_(options),
        entries_(std::move(entries)),
        is_folder_(is_folder),
        csv_(options.out, header(is_folder)) {}

  void ask(const files::CcdFile& file, const files::CcdQueries& read) {
    rounded_ += read.rounded;
    std::vector<CcdContestant> contestants;
    for (const CcdEntry* entry : entries_) {
      contestants.push_back({entry, {}});
      ask_ccd(contestants.back(), options_, file.pair, read.queries);
    }
    write(file, contestants, read.queries.size());
    std::vector<CcdCounts>& counts = counts_[{file.scene, ccd_kind(file.pair)}];
    counts.resize(entries_.size());
    for (std::size_t i = 0; i < entries_.size(); ++i) counts[i].add(contestants[i], read.contacts);
  }

  // Prints a row for each scene, kind and algorithm. Returns true if one that is not a peer missed a
  // contact and stood by its answer.
  bool finish() {
    csv_.close();
    if (rounded_ > 0) fmt::print("{} coordinates are not doubles, and were rounded\n", rounded_);
    std::vector<std::string> columns = {"algorithm",       "hits",       "misses",    "unknown",
                                        "missed contacts", "false hits", "ns a query"};
    if (is_folder_) columns.insert(columns.begin(), {"scene", "kind", "queries"});
    base::Table table(columns);
    bool is_wrong = false;
    for (const auto& [scene_and_kind, counts] : counts_) {
      for (std::size_t i = 0; i < entries_.size(); ++i) {
        is_wrong = is_wrong || (counts[i].is_wrong && entries_[i]->info.origin != Origin::peer);
        std::vector<std::string> row = row_of(entries_[i]->info.name, counts[i]);
        if (is_folder_) {
          row.insert(row.begin(), {scene_and_kind.first, scene_and_kind.second,
                                   fmt::format("{}", counts[i].queries)});
        }
        table.add(row);
      }
    }
    fmt::print("{}", table.text(base::page_width()));
    return is_wrong;
  }

 private:
  static std::vector<std::string> header(bool is_folder) {
    std::vector<std::string> columns = {"query",  "algorithm",   "answer",     "toi",
                                        "status", "free_before", "contact_by", "iterations"};
    if (is_folder) columns.insert(columns.end(), {"scene", "kind", "file"});
    return columns;
  }

  void write(const files::CcdFile& file, const std::vector<CcdContestant>& contestants,
             std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      for (const CcdContestant& contestant : contestants) {
        const CcdOutcome& outcome = contestant.outcomes[i];
        csv_.field(i).field(contestant.entry->info.name).field(to_string(outcome.answer));
        csv_.field(outcome.toi).field(to_string(outcome.status));
        csv_.field(outcome.free_before).field(outcome.contact_by);
        if (outcome.iterations >= 0) {
          csv_.field(outcome.iterations);
        } else {
          csv_.field("");
        }
        if (is_folder_) {
          csv_.field(file.scene).field(ccd_kind(file.pair)).field(file.file.filename().string());
        }
        csv_.end_row();
      }
    }
  }

  std::vector<std::string> row_of(const std::string& name, const CcdCounts& counts) const {
    // The truths are those of a separation of 0.
    const bool has_false_hits = counts.has_truth && options_.settings.separation == 0;
    return {name,
            fmt::format("{}", counts.hits),
            fmt::format("{}", counts.misses),
            fmt::format("{}", counts.unknown),
            counts.has_truth ? fmt::format("{}", counts.missed) : "-",
            has_false_hits ? fmt::format("{}", counts.false_hits) : "-",
            counts.answered == 0 ? "-"
                                 : fmt::format("{:.1f}", 1e9 * counts.seconds /
                                                             static_cast<double>(counts.answered))};
  }

  const CcdOptions& options_;
  std::vector<const CcdEntry*> entries_;
  bool is_folder_;
  files::CsvWriter csv_;
  std::size_t rounded_ = 0;
  std::map<std::pair<std::string, std::string>, std::vector<CcdCounts>> counts_;
};

int run_ccd(const CcdOptions& options) {
  const bool is_folder = std::filesystem::is_directory(options.queries);
  std::vector<files::CcdFile> files;
  if (is_folder) {
    files = files::ccd_files(options.queries);
    if (options.pair) {
      std::erase_if(files, [&](const files::CcdFile& file) { return file.pair != *options.pair; });
    }
    if (files.empty()) {
      throw base::InputError(options.queries, 0,
                             "no queries of the kind that --kind names; expected some");
    }
  } else if (options.pair) {
    files.push_back({options.queries, "", *options.pair});
  } else {
    throw base::InputError("--kind is missing; expected vertex-face or edge-edge with a file");
  }
  auto entries =
      kinds::select(registry::entries<CcdEntry>(), kinds::split_names(options.algorithms),
                    "algorithm of continuous collision");
  const files::CcdQueries first = files::read_ccd_queries(files.front().file);
  std::vector<files::NamedFile> inputs;
  for (const files::CcdFile& file : files) inputs.push_back({"QUERIES", file.file});
  files::check_outputs(inputs, std::vector<files::NamedFile>{{"--out", options.out}});
  CcdJob job(options, std::move(entries), is_folder);
  job.ask(files.front(), first);
  for (std::size_t i = 1; i < files.size(); ++i)
    job.ask(files[i], files::read_ccd_queries(files[i].file));
  return job.finish() ? exit_measured_wrong : exit_done;
}

}  // namespace

void add_ccd(Arguments command) {
  const auto options = std::make_shared<CcdOptions>();
  command
      .text(
          "QUERIES", options->queries,
          "CSV without a header, eight rows a query: the vertices at time 0, then at time 1; each "
          "coordinate a number or a numerator and a denominator; perhaps the truth (0 or 1) last. "
          "Or "
          "a folder of such files: SCENE/vertex-face/NAME.csv, SCENE/edge-edge/NAME.csv")
      .required();
  command.one_of<FeaturePair>(
      "--kind", options->pair,
      {{"vertex-face", FeaturePair::vertex_face}, {"edge-edge", FeaturePair::edge_edge}},
      "What the four vertices are; needed with a file, and with a folder the only kind that is "
      "asked about");
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
              "Greatest number of steps of a query (default: each algorithm's own); the exact one "
              "has none")
      .positive();
  add_time_limit(command, options->time_limit,
                 fmt::format("Seconds that {} queries may take", ccd_block_size))
      .show_default();
  command.text("--out", options->out, "The CSV file to write").required();
  command.job([options] { return run_ccd(*options); });
}

}  // namespace touchstone::commands
