// Makes the tables of a cell run from the rows in its folder.
#include "harness/stats/cells/cell_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "harness/base/table.h"
#include "harness/files/text_file.h"
#include "harness/record/facts.h"
#include "harness/record/row.h"
#include "harness/stats/cells/cell_rows.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {
namespace {

constexpr double cell_confidence = 0.95;

using Name = std::pair<std::string, std::string>;  // group, cell

struct CellTimes {
  Name name;
  std::vector<CellTimeRow> rows;                        // in the order of the grades
  std::map<std::string, std::vector<double>> by_round;  // seconds of each algorithm
  std::optional<CellBestRow> best;
};

// The place of the fastest of an origin that is right and was timed.
std::optional<std::size_t> fastest(const CellTimes& cell, std::string_view origin) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < cell.rows.size(); ++i) {
    const CellTimeRow& row = cell.rows[i];
    if (row.grade.origin != origin || row.grade.status != "ok" || !row.grade.is_right() ||
        std::isnan(row.seconds))
      continue;
    if (!best || row.seconds < cell.rows[*best].seconds) best = i;
  }
  return best;
}

void compare(CellTimes& cell) {
  const std::optional<std::size_t> ours = fastest(cell, "ours"), peer = fastest(cell, "peer");
  if (ours) cell.rows[*ours].best = true;
  if (peer) cell.rows[*peer].best = true;
  if (!ours) return;
  CellBestRow& best = cell.best.emplace();
  best.group = cell.name.first;
  best.cell = cell.name.second;
  best.ours = cell.rows[*ours].grade.algorithm;
  if (!peer) return;
  best.peer = cell.rows[*peer].grade.algorithm;
  const std::vector<double>&a = cell.by_round[best.ours], &b = cell.by_round[best.peer];
  std::vector<double> logs;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    logs.push_back(std::log(b[k] / a[k]));
  const MedianInterval ratio = exponential(median_interval(logs, cell_confidence));
  best.ratio = ratio.median;
  best.low = ratio.low;
  best.high = ratio.high;
}

std::vector<CellTimes> read_times(const std::filesystem::path& folder) {
  std::vector<CellTimes> cells;
  std::map<Name, std::size_t> place;
  for (const GradeRow& row : record::read_rows<GradeRow>(folder / "grades.csv")) {
    const Name name{row.group, row.cell};
    const auto [at, is_new] = place.emplace(name, cells.size());
    if (is_new) cells.push_back({name, {}, {}, {}});
    cells[at->second].rows.emplace_back().grade = row;
  }
  // A disturbed round counts where all were disturbed, since a ratio within a round still holds.
  std::map<Name, std::vector<CellSampleRow>> quiet, all;
  for (const CellSampleRow& row : record::read_rows<CellSampleRow>(folder / "raw.csv")) {
    all[{row.group, row.cell}].push_back(row);
    if (row.noise.empty()) quiet[{row.group, row.cell}].push_back(row);
  }
  for (CellTimes& cell : cells) {
    const std::vector<CellSampleRow>& own = all[cell.name];
    const std::vector<CellSampleRow>& still = quiet[cell.name];
    for (const CellSampleRow& row : 2 * still.size() >= own.size() ? still : own)
      cell.by_round[row.algorithm].push_back(row.seconds);
    for (CellTimeRow& row : cell.rows) {
      const std::vector<double>& seconds = cell.by_round[row.grade.algorithm];
      row.samples = std::ssize(seconds);
      if (seconds.empty()) continue;
      const MedianInterval time = median_interval(seconds, cell_confidence);
      row.seconds = time.median;
      row.low = time.low;
      row.high = time.high;
    }
    compare(cell);
  }
  return cells;
}

std::string time_cell(double seconds) {
  if (std::isnan(seconds)) return "-";
  const double ns = 1e9 * seconds;
  return ns < 10    ? fmt::format("{:.2f}", ns)
         : ns < 100 ? fmt::format("{:.1f}", ns)
                    : fmt::format("{:.0f}", ns);
}

std::string table_of(const CellTimes& cell) {
  // Of motion, the pairs that are found to touch stand last, of others the greatest error.
  const bool counts_hits = std::ranges::any_of(
      cell.rows, [](const CellTimeRow& row) { return row.grade.true_hits >= 0; });
  base::Table table({"algorithm", "ns a query", "95 % interval", "missed", "false hits",
                     "otherwise wrong", "unknown", counts_hits ? "hits" : "greatest error"});
  std::vector<const CellTimeRow*> rows;
  for (const CellTimeRow& row : cell.rows) rows.push_back(&row);
  std::ranges::stable_sort(rows, [](const CellTimeRow* a, const CellTimeRow* b) {
    // Those without a time come last.
    return (std::isnan(a->seconds) ? INFINITY : a->seconds) <
           (std::isnan(b->seconds) ? INFINITY : b->seconds);
  });
  for (const CellTimeRow* row : rows) {
    const GradeRow& grade = row->grade;
    const std::string interval =
        std::isnan(row->low) ? "-" : time_cell(row->low) + " to " + time_cell(row->high);
    const auto count = [](std::int64_t n) { return std::to_string(n); };
    const std::string name = (row->best ? "**" + grade.algorithm + "**" : grade.algorithm) +
                             (grade.approximate ? " (approximate)" : "") +
                             (grade.status == "ok" ? "" : " (" + grade.status + ")");
    table.add({name, time_cell(row->seconds), interval, count(grade.missed),
               count(grade.false_hits), count(grade.other), count(grade.unknown),
               counts_hits               ? (grade.hits < 0 ? "" : count(grade.hits))
               : std::isnan(grade.error) ? ""
                                         : fmt::format("{:.1e}", grade.error)});
  }
  return table.markdown();
}

// The facts of the folder's machine of these names, as a list in Markdown.
std::string facts_of(const std::filesystem::path& folder) {
  const record::Facts facts = record::read_facts(folder / "machine.csv");
  std::string text;
  for (const char* name :
       {"processor", "compiler", "flags", "instructions_in_use", "commit", "tree"})
    text += fmt::format("- {}: {}\n", name, record::value_of(facts, name));
  return text;
}

}  // namespace

std::string write_cell_tables(const std::filesystem::path& folder, const std::string& name,
                              const std::filesystem::path& out) {
  const std::vector<CellTimes> cells = read_times(folder);
  std::vector<CellTimeRow> times;
  std::vector<CellBestRow> bests;
  base::Table best({"cell", "fastest of ours that is right", "fastest peer that is right",
                    "peer / ours", "95 % interval"},
                   3);
  std::string sections, group;
  for (const CellTimes& cell : cells) {
    times.insert(times.end(), cell.rows.begin(), cell.rows.end());
    if (cell.name.first != group) {
      group = cell.name.first;
      sections += fmt::format("## {}\n\n", group);
    }
    sections +=
        fmt::format("### {}\n\n{} queries, {} of them held against exact answers.\n\n{}\n",
                    cell.name.second, cell.rows.empty() ? 0 : cell.rows.front().grade.queries,
                    cell.rows.empty() ? 0 : cell.rows.front().grade.graded, table_of(cell));
    if (!cell.best) continue;
    bests.push_back(*cell.best);
    const auto number = [](double x) {
      return std::isnan(x) ? std::string("-") : fmt::format("{:.3g}", x);
    };
    best.add({cell.name.first + ", " + cell.name.second, cell.best->ours,
              cell.best->peer.empty() ? "none" : cell.best->peer, number(cell.best->ratio),
              std::isnan(cell.best->low)
                  ? "-"
                  : number(cell.best->low) + " to " + number(cell.best->high)});
  }
  record::write_rows(out / "times.csv", times);
  record::write_rows(out / "best.csv", bests);
  files::write_text(
      out / "tables.md",
      fmt::format(
          "# Tables of {}\n\n{}\nTimes are medians over rounds in which every algorithm is timed "
          "once, "
          "in shuffled order; intervals are those of the sign test at\n95 %. All answers were held "
          "against exact ones before. Bold: the fastest of ours, and of the peers, with no wrong "
          "answer.\n\n## Ours against the libraries\n\n{}\n{}",
          name, facts_of(folder), best.markdown(), sections));
  return best.text(base::page_width());
}

}  // namespace touchstone::stats
