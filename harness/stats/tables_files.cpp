// Writes the tables as CSV files.
#include <fmt/format.h>

#include <cmath>

#include "harness/base/markdown.h"
#include "harness/files/csv.h"
#include "harness/stats/tables.h"

namespace touchstone::stats {
namespace {

const std::vector<std::string> key_columns = {"scene",    "scene_hash", "bodies",   "seed",
                                              "boxes",    "threads",    "task",     "pair_kind",
                                              "pairs_of", "rebuild",    "isa_limit"};

// A CSV file whose rows begin with a set's key.
class TableFile {
 public:
  TableFile(const std::filesystem::path& file, const std::vector<std::string>& columns)
      : csv_(file, joined(columns)) {}
  files::CsvWriter& row(const SetKey& key) {
    csv_.field(key.scene).field(key.scene_hash);
    if (key.bodies > 0) {
      csv_.field(key.bodies);
    } else {
      csv_.field("");
    }
    csv_.field(key.seed).field(key.boxes).field(key.threads);
    csv_.field(key.task).field(key.pair_kind).field(key.pairs_of);
    return csv_.field(int{key.rebuild}).field(key.isa_limit);
  }
  void close() { csv_.close(); }

 private:
  static std::vector<std::string> joined(const std::vector<std::string>& columns) {
    std::vector<std::string> all = key_columns;
    all.insert(all.end(), columns.begin(), columns.end());
    return all;
  }
  files::CsvWriter csv_;
};

void write_ratios(const std::vector<RatioRow>& rows, double band,
                  const std::filesystem::path& file) {
  TableFile ratios(file, {"algorithm", "baseline", "canary", "ratio", "ratio_low", "ratio_high",
                          "squares", "p", "p_corrected", "band_low", "band_high", "suspect"});
  for (const RatioRow& row : rows) {
    files::CsvWriter& csv = ratios.row(row.key).field(row.label).field(row.baseline);
    csv.field(int{row.canary}).field(row.ratio.median).field(row.ratio.low).field(row.ratio.high);
    csv.field(row.ratio.n).field(row.p).field(row.p_corrected);
    csv.field(row.ratio.low / band).field(row.ratio.high * band);
    csv.field(int{row.suspect}).end_row();
  }
  ratios.close();
}

void write_broad_best(const std::vector<BroadBestRow>& rows, const std::filesystem::path& file) {
  TableFile best(file, {"ours",
                        "ours_seconds",
                        "peer",
                        "peer_seconds",
                        "peer_ratio",
                        "peer_ratio_low",
                        "peer_ratio_high",
                        "bullet_or_fcl",
                        "bullet_or_fcl_seconds",
                        "bullet_or_fcl_ratio",
                        "bullet_or_fcl_ratio_low",
                        "bullet_or_fcl_ratio_high",
                        "over_limit",
                        "over_limit_low",
                        "over_limit_high",
                        "bytes_a_body",
                        "base_threads",
                        "speed_up",
                        "speed_up_low",
                        "speed_up_high",
                        "exponent_of_many"});
  for (const BroadBestRow& row : rows) {
    files::CsvWriter& csv = best.row(row.key).field(row.ours.label).field(row.ours.seconds);
    for (const BroadBestRow::Best* other : {&row.peer, &row.bullet_or_fcl}) {
      csv.field(other->label).field(other->seconds);
      csv.field(other->ratio.median).field(other->ratio.low).field(other->ratio.high);
    }
    csv.field(row.over_limit.median).field(row.over_limit.low).field(row.over_limit.high);
    csv.field(row.bytes_a_body);
    csv.field(row.base_threads > 0 ? std::to_string(row.base_threads) : std::string());
    csv.field(row.speed_up.median).field(row.speed_up.low).field(row.speed_up.high);
    csv.field(row.exponent).end_row();
  }
  best.close();
}

void write_narrow_best(const std::vector<NarrowBestRow>& rows, const std::filesystem::path& file) {
  std::vector<std::string> columns;
  for (const char* who : {"ours", "right_peer", "any_peer"}) {
    for (const char* what : {"", "_seconds", "_queries", "_wrong", "_failed", "_worst_error",
                             "_ratio", "_ratio_low", "_ratio_high"}) {
      columns.push_back(std::string(who) + what);
    }
  }
  TableFile best(file, columns);
  for (const NarrowBestRow& row : rows) {
    files::CsvWriter& csv = best.row(row.key);
    for (const NarrowBestRow::Best* one : {&row.ours, &row.right_peer, &row.any_peer}) {
      csv.field(one->label).field(one->seconds).field(one->queries).field(one->wrong);
      csv.field(one->failed).field(one->worst_error);
      csv.field(one->ratio.median).field(one->ratio.low).field(one->ratio.high);
    }
    csv.end_row();
  }
  best.close();
}

}  // namespace

void write_tables(const Tables& tables, double band, const std::filesystem::path& folder) {
  TableFile times(folder / "times.csv",
                  {"algorithm", "origin", "unit", "seconds", "seconds_low", "seconds_high",
                   "minimum", "build", "update", "find_pairs", "narrow", "convert", "squares",
                   "samples", "noisy", "outliers", "wrong", "failure"});
  for (const TimeRow& row : tables.times) {
    files::CsvWriter& csv = times.row(row.key).field(row.label).field(row.origin);
    csv.field(row.key.narrow() ? "query" : "frame").field(row.seconds.median);
    csv.field(row.seconds.low).field(row.seconds.high).field(row.minimum);
    for (const double part : row.parts) csv.field(part);
    csv.field(row.seconds.n).field(row.samples).field(row.noisy).field(row.outliers);
    csv.field(int{row.wrong}).field(row.failure).end_row();
  }
  times.close();
  write_ratios(tables.ratios, band, folder / "ratios.csv");
  write_ratios(tables.library_ratios, band, folder / "library_ratios.csv");
  TableFile winners(folder / "winners.csv",
                    {"winner", "runner_up", "ratio", "ratio_low", "ratio_high", "squares", "p",
                     "p_corrected", "suspect"});
  for (const WinnerRow& row : tables.winners) {
    files::CsvWriter& csv = winners.row(row.key).field(row.winner).field(row.runner_up);
    csv.field(row.ratio.median).field(row.ratio.low).field(row.ratio.high).field(row.ratio.n);
    csv.field(row.p).field(row.p_corrected).field(int{row.suspect}).end_row();
  }
  winners.close();
  TableFile exponents(folder / "exponents.csv",
                      {"algorithm", "exponent", "exponent_low", "exponent_high", "factor", "counts",
                       "exponent_of_many"});
  for (const ExponentRow& row : tables.exponents) {
    files::CsvWriter& csv = exponents.row(row.key).field(row.label).field(row.law.exponent);
    csv.field(row.law.low).field(row.law.high).field(row.law.factor);
    csv.field(fmt::format("{}", fmt::join(row.counts, " ")));
    csv.field(row.law_of_many.exponent).end_row();
  }
  exponents.close();
  TableFile speed_ups(folder / "speed_ups.csv",
                      {"algorithm", "base_threads", "speed_up", "speed_up_low", "speed_up_high"});
  for (const SpeedUpRow& row : tables.speed_ups) {
    files::CsvWriter& csv = speed_ups.row(row.key).field(row.label).field(row.base_threads);
    csv.field(row.speed_up.median).field(row.speed_up.low).field(row.speed_up.high).end_row();
  }
  speed_ups.close();
  TableFile agreement(folder / "agreement.csv", {"algorithm", "origin", "queries", "right", "wrong",
                                                 "failed", "unanswered", "worst_error"});
  for (const AgreementRow& row : tables.agreement) {
    files::CsvWriter& csv =
        agreement.row(row.key).field(row.label).field(row.origin).field(row.queries);
    csv.field(row.right)
        .field(row.wrong)
        .field(row.failed)
        .field(row.unanswered)
        .field(row.worst_error)
        .end_row();
  }
  agreement.close();
  TableFile work(folder / "work.csv",
                 {"algorithm", "origin", "frames", "queries", "box_tests_a_body",
                  "node_visits_a_body", "candidates_a_pair", "bytes_a_body", "iterations_a_query",
                  "support_calls_a_query", "unit", "allocations", "allocated_bytes"});
  for (const WorkRow& row : tables.work) {
    files::CsvWriter& csv = work.row(row.key).field(row.label).field(row.origin);
    csv.field(row.frames).field(row.queries).field(row.box_tests).field(row.node_visits);
    csv.field(row.candidates).field(row.bytes).field(row.iterations).field(row.support_calls);
    csv.field(row.key.narrow() ? "query" : "frame").field(row.allocations);
    csv.field(row.allocated_bytes).end_row();
  }
  work.close();
  write_broad_best(tables.broad_best, folder / "broad_best.csv");
  write_narrow_best(tables.narrow_best, folder / "narrow_best.csv");
  base::write_text(folder / "tables.md", tables_markdown(tables));
}

}  // namespace touchstone::stats
