// What is asked of moving vertices, faces and edges: when they meet, and which contacts are missed.
#include "harness/kinds/feature/feature_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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
#include "harness/files/ccd_queries.h"
#include "harness/files/csv.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"

namespace touchstone::kinds {
namespace {

// Queries that are solved in one call. A crash or a hang costs one block.
constexpr std::size_t feature_block_size = 512;

struct FeatureReplies {
  const CcdEntry* entry;
  std::vector<CcdOutcome> outcomes = {};
  double seconds = 0;  // of the queries that were answered
  std::size_t answered = 0;
};

// What an algorithm answered to some files, and how that holds against the truths in them.
struct FeatureCounts {
  std::size_t queries = 0, hits = 0, misses = 0, unknown = 0, missed = 0, false_hits = 0;
  std::size_t answered = 0;
  double seconds = 0;  // of the queries that were answered
  bool has_truth = true;
  bool is_wrong = false;  // missed a contact and stood by its answer

  void add(const FeatureReplies& asked, const std::vector<char>& contacts) {
    for (std::size_t i = 0; i < asked.outcomes.size(); ++i) {
      const CcdOutcome& outcome = asked.outcomes[i];
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
    answered += asked.answered;
    seconds += asked.seconds;
    has_truth = has_truth && !contacts.empty();
  }
};

// The files are asked one after the other.
class FeatureQuestions final : public Questions {
 public:
  explicit FeatureQuestions(const QuestionInput& input)
      : input_(input), is_folder_(std::filesystem::is_directory(input.file)) {
    settings_.tolerance = input.number("--tolerance").value_or(settings_.tolerance);
    settings_.separation = input.number("--separation").value_or(settings_.separation);
    settings_.max_iterations = input.count("--max-iterations");
    list_files();
    for (const CcdEntry* entry :
         select(registry::entries<CcdEntry>(), input.names, "algorithm of continuous collision")) {
      asked_.push_back({.entry = entry});
    }
    read_part();
  }

  std::size_t size() const override { return part_.queries.size(); }
  std::string label(std::size_t query) const override { return fmt::format("query {}", query); }
  std::vector<files::NamedFile> inputs() const override {
    std::vector<files::NamedFile> inputs;
    for (const files::CcdFile& file : files_) inputs.push_back({"FILE", file.file});
    return inputs;
  }
  bool next() override {
    if (at_ + 1 == files_.size()) return false;
    ++at_;
    read_part();
    return true;
  }
  std::string_view unit() const override { return "of the step"; }

  std::size_t contestants() const override { return asked_.size(); }
  const AlgorithmInfo& info(std::size_t contestant) const override {
    return asked_[contestant].entry->info;
  }

  // The child has solved the first block untimed before.
  std::vector<AskFailure> ask(std::size_t contestant) override {
    FeatureReplies& asked = asked_[contestant];
    asked = {.entry = asked.entry};
    const auto& queries = part_.queries;
    const FeaturePair pair = files_[at_].pair;
    const std::size_t blocks = (queries.size() + feature_block_size - 1) / feature_block_size;
    process::SharedArray<CcdOutcome> outcomes(queries.size());
    process::SharedArray<double> seconds(blocks);
    const auto block_at = [&](std::size_t block) {
      const std::size_t begin = block * feature_block_size;
      return std::pair(begin, std::min(feature_block_size, queries.size() - begin));
    };
    const process::IsolationReport report =
        process::isolate(blocks, {.item_seconds = input_.seconds(60)}, [&]() -> process::ItemWork {
          const std::shared_ptr<Ccd> algorithm = asked.entry->make(settings_);
          const auto solve = [&, algorithm](std::size_t block) {
            const auto [begin, count] = block_at(block);
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
    asked.outcomes.assign(outcomes.span().begin(), outcomes.span().end());
    for (std::size_t block = 0; block < blocks; ++block) {
      const auto [begin, count] = block_at(block);
      if (report.states[block] == process::ItemState::done) {
        asked.seconds += seconds[block];
        asked.answered += count;
        continue;
      }
      const Status status = process::status_of(report.states[block]);
      for (std::size_t i = begin; i < begin + count; ++i) asked.outcomes[i] = {.status = status};
    }
    auto& counts = counts_[{files_[at_].scene, std::string(to_string(pair))}];
    counts.resize(asked_.size());
    counts[contestant].add(asked, part_.contacts);
    std::vector<AskFailure> failures;
    for (const process::IsolationFailure& failure : report.failures) {
      const auto [begin, count] = block_at(failure.item);
      failures.push_back(
          {fmt::format("queries {} to {}", begin, begin + count - 1), failure.reason()});
    }
    return failures;
  }

  std::vector<std::string> columns() const override {
    std::vector<std::string> columns = {"query",  "algorithm",   "answer",     "toi",
                                        "status", "free_before", "contact_by", "iterations"};
    if (is_folder_) columns.insert(columns.end(), {"scene", "kind", "file"});
    return columns;
  }
  void write(files::CsvWriter& csv, std::size_t query, std::size_t contestant) const override {
    const CcdOutcome& outcome = asked_[contestant].outcomes[query];
    csv.field(query).field(info(contestant).name).field(to_string(outcome.answer));
    csv.field(outcome.toi).field(to_string(outcome.status));
    csv.field(outcome.free_before).field(outcome.contact_by);
    write_if(csv, outcome.iterations >= 0, outcome.iterations);
    if (is_folder_) {
      const files::CcdFile& file = files_[at_];
      csv.field(file.scene).field(to_string(file.pair)).field(file.file.filename().string());
    }
    csv.end_row();
  }

  ShownAnswer shown(std::size_t query, std::size_t contestant) const override {
    const CcdOutcome& outcome = asked_[contestant].outcomes[query];
    ShownAnswer shown = {
        .verdict = to_string(outcome.answer), .status = outcome.status, .number = outcome.toi};
    if (info(contestant).origin == Origin::oracle) {
      shown.lower = outcome.free_before;
      shown.upper = outcome.contact_by;
    } else if (!std::isnan(outcome.free_before)) {
      // Where contact is proven by, features may be as far apart as the tolerance: no bound on the time.
      shown.more = fmt::format("free before {}", outcome.free_before);
    }
    if (!part_.contacts.empty() && settings_.separation == 0) {
      const bool is_contact = part_.contacts[query] != 0;
      const bool is_hit = outcome.answer == CcdAnswer::hit;
      if (is_hit != is_contact && outcome.answer != CcdAnswer::unknown)
        shown.more += is_hit ? "  [false, by FILE]" : "  [missed, by FILE]";
    }
    return shown;
  }
  std::vector<std::string_view> verdicts() const override { return {"hit", "miss", "unknown"}; }

  // A row for each scene, pair of features and algorithm.
  bool print_summary(bool /*are_shown*/) const override {
    if (rounded_ > 0) fmt::print("{} coordinates are not doubles, and were rounded\n", rounded_);
    std::vector<std::string> columns = {"algorithm",       "hits",       "misses",    "unknown",
                                        "missed contacts", "false hits", "ns a query"};
    if (is_folder_) columns.insert(columns.begin(), {"scene", "features", "queries"});
    base::Table table(columns);
    for (const auto& [scene_and_pair, counts] : counts_) {
      for (std::size_t i = 0; i < asked_.size(); ++i) {
        std::vector<std::string> row = row_of(info(i).name, counts[i]);
        if (is_folder_) {
          row.insert(row.begin(), {scene_and_pair.first, scene_and_pair.second,
                                   fmt::format("{}", counts[i].queries)});
        }
        table.add(row);
      }
    }
    fmt::print("{}", table.text(base::page_width()));
    return true;
  }
  // One that is not a peer missed a contact and stood by its answer.
  bool is_wrong() const override {
    for (const auto& [scene_and_pair, counts] : counts_) {
      for (std::size_t i = 0; i < asked_.size(); ++i) {
        if (counts[i].is_wrong && info(i).origin != Origin::peer) return true;
      }
    }
    return false;
  }

 private:
  void list_files() {
    const std::string word = input_.text("--features");
    std::optional<FeaturePair> pair;
    if (!word.empty()) {
      pair = word == to_string(FeaturePair::vertex_face) ? FeaturePair::vertex_face
                                                         : FeaturePair::edge_edge;
    }
    if (!is_folder_) {
      if (!pair) {
        throw base::InputError(
            "--features is missing; expected vertex-face or edge-edge with a file");
      }
      files_.push_back({input_.file, "", *pair});
      return;
    }
    files_ = files::ccd_files(input_.file);
    if (pair) std::erase_if(files_, [&](const auto& file) { return file.pair != *pair; });
    if (files_.empty()) {
      throw base::InputError(input_.file, 0,
                             "no queries of the features that --features names; expected some");
    }
  }
  void read_part() {
    part_ = files::read_ccd_queries(files_[at_].file);
    rounded_ += part_.rounded;
  }

  std::vector<std::string> row_of(const std::string& name, const FeatureCounts& counts) const {
    // The truths are those of a separation of 0.
    const bool has_false_hits = counts.has_truth && settings_.separation == 0;
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

  QuestionInput input_;
  bool is_folder_;
  CcdSettings settings_;
  std::vector<files::CcdFile> files_;
  std::size_t at_ = 0;  // the file that is asked
  files::CcdQueries part_;
  std::size_t rounded_ = 0;
  std::vector<FeatureReplies> asked_;
  std::map<std::pair<std::string, std::string>, std::vector<FeatureCounts>> counts_;
};

}  // namespace

std::vector<QueryOption> feature_options() {
  using Value = QueryOption::Value;
  return {{"--features",
           Value::choice,
           "What the four vertices of a question are; needed with a file, and with a folder the "
           "only ones that are "
           "asked about",
           {"vertex-face", "edge-edge"}},
          {.name = "--tolerance", .value = Value::not_negative, .help = option::tolerance.help},
          {"--separation", Value::not_negative,
           "Metres within which features are in contact (default: 0)"},
          option::max_iterations};
}

std::unique_ptr<Questions> read_feature_questions(const QuestionInput& input) {
  return std::make_unique<FeatureQuestions>(input);
}

}  // namespace touchstone::kinds
