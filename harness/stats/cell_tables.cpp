// Makes the tables of a cell run from the rows in its folder. Cells that differ in threads are
// found by their names.
#include "harness/stats/cell_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/table.h"
#include "harness/files/text_file.h"
#include "harness/record/machine.h"
#include "harness/record/row.h"
#include "harness/stats/cell_results.h"
#include "harness/stats/cell_rows.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {
namespace {

struct CellName {
  std::string_view rest;
  std::int64_t threads = 1;
};

// "pairs, 2 threads" are the pairs at 2, and "1 thread" is all at one.
CellName split(std::string_view name) {
  const std::size_t comma = name.rfind(", ");
  const std::size_t begin = comma == std::string_view::npos ? 0 : comma + 2;
  const std::string_view last = name.substr(begin);
  std::int64_t threads = 0;
  const auto [end, error] = std::from_chars(last.data(), last.data() + last.size(), threads);
  const std::string_view unit(end, static_cast<std::size_t>(last.data() + last.size() - end));
  if (error != std::errc() || (unit != " thread" && unit != " threads")) return {name, 1};
  return {name.substr(0, begin == 0 ? 0 : comma), threads};
}

const CellTimes* find(std::span<const CellTimes> cells, const std::string& group,
                      std::string_view rest) {
  const auto at = std::ranges::find_if(cells, [&](const CellTimes& cell) {
    const CellName name = split(cell.name.second);
    return cell.name.first == group && name.threads == 1 && name.rest == rest;
  });
  return at == cells.end() ? nullptr : &*at;
}

}  // namespace

std::vector<CellSpeedUpRow> cell_speed_ups(std::span<const CellTimes> cells) {
  std::vector<CellSpeedUpRow> all;
  for (const CellTimes& cell : cells) {
    const CellName name = split(cell.name.second);
    const CellTimes* one = name.threads == 1 ? nullptr : find(cells, cell.name.first, name.rest);
    if (one == nullptr) continue;
    for (const CellTimeRow& row : cell.rows) {
      const auto own = cell.contestants.find(row.grade.algorithm);
      const auto alone = one->contestants.find(row.grade.algorithm);
      if (!row.grade.is_right() || row.grade.status != "ok" || own == cell.contestants.end() ||
          alone == one->contestants.end() || alone->second.failure)
        continue;
      const Noise noise = one->noise == Noise::kept ? Noise::kept : cell.noise;
      const std::vector<double> logs = paired_log_ratios(alone->second, own->second, noise);
      if (logs.empty()) continue;
      const MedianInterval ratio = exponential(median_interval(logs, usual_confidence));
      all.push_back({cell.name.first, std::string(name.rest), row.grade.algorithm, row.grade.origin,
                     name.threads, ratio.median, ratio.low, ratio.high});
    }
  }
  return all;
}

namespace {

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
  base::Table table({"algorithm", "ns a query", "95 % interval", "missed", "false hits", "inexact",
                     "gave up", counts_hits ? "hits" : "greatest error"});
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
               count(grade.false_hits), count(grade.inexact), count(grade.gave_up),
               counts_hits               ? (grade.hits < 0 ? "" : count(grade.hits))
               : std::isnan(grade.error) ? ""
                                         : fmt::format("{:.1e}", grade.error)});
  }
  return table.markdown();
}

std::string graded_text(const CellTimes& cell) {
  if (cell.rows.empty()) return "";
  const GradeRow& grade = cell.rows.front().grade;
  return fmt::format("{} queries, {} of them graded by `{}`.", grade.queries, grade.graded,
                     grade.truth);
}

std::string twin_text(const CellTimes& cell) {
  if (!cell.best || std::isnan(cell.best->twin)) return "";
  return fmt::format(" The twin of {} takes {:.3g} of its time ({:.3g} to {:.3g}).",
                     cell.best->baseline, cell.best->twin, cell.best->twin_low,
                     cell.best->twin_high);
}

std::string speed_up_section(const std::vector<CellSpeedUpRow>& speed_ups) {
  if (speed_ups.empty()) return "";
  base::Table table({"cell", "algorithm", "threads", "speed-up", "95 % interval"}, 2);
  for (const CellSpeedUpRow& row : speed_ups) {
    table.add({row.cell.empty() ? row.group : row.group + ", " + row.cell, row.algorithm,
               std::to_string(row.threads), fmt::format("{:.3g}", row.speed_up),
               fmt::format("{:.3g} to {:.3g}", row.low, row.high)});
  }
  return fmt::format("## Several threads against one\n\n{}\n", table.markdown());
}

// Who was wrong, and who crashed or did not end, over all cells.
std::string faults_text(const std::vector<CellTimeRow>& rows) {
  struct Faults {
    std::int64_t cells = 0, graded = 0, missed = 0, false_hits = 0, inexact = 0;
    std::map<std::string, int> ends;  // by status: cells
  };
  std::map<std::string, Faults> of_algorithm;
  bool is_any_right = false, is_any_wrong = false;
  for (const CellTimeRow& row : rows) {
    Faults& faults = of_algorithm[row.grade.algorithm];
    if (row.grade.status == "wrong") {
      ++faults.ends["another answer in a sample than the graded one"];
    } else if (row.grade.status != "ok" && row.grade.status != "unsupported") {
      ++faults.ends[row.grade.status];
    }
    is_any_right |= row.grade.status == "ok" && row.grade.is_right();
    if (row.grade.silent() == 0) continue;
    ++faults.cells;
    faults.graded += row.grade.graded;
    faults.missed += row.grade.missed;
    faults.false_hits += row.grade.false_hits;
    faults.inexact += row.grade.inexact;
  }
  base::Table table({"wrong answers of", "cells", "missed", "false hits", "inexact", "of"});
  std::string text;
  for (const auto& [name, faults] : of_algorithm) {
    for (const auto& [status, cells] : faults.ends) {
      text += fmt::format("{}: {} in {} cell{}\n", name, status, cells, cells == 1 ? "" : "s");
    }
    if (faults.cells == 0) continue;
    is_any_wrong = true;
    table.add({name, std::to_string(faults.cells), std::to_string(faults.missed),
               std::to_string(faults.false_hits), std::to_string(faults.inexact),
               std::to_string(faults.graded)});
  }
  if (is_any_wrong) return "\n" + table.text(base::page_width()) + text;
  return "\n" + (text.empty() && is_any_right ? "No answer is wrong.\n" : text);
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
  const std::vector<CellTimes> cells = read_cell_times(folder);
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
    sections += fmt::format("### {}\n\n{}{}\n\n{}\n", cell.name.second, graded_text(cell),
                            twin_text(cell), table_of(cell));
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
  record::write_rows(out / "set_times.csv", times);
  record::write_rows(out / "set_best.csv", bests);
  const std::vector<CellSpeedUpRow> speed_ups = cell_speed_ups(cells);
  if (!speed_ups.empty()) record::write_rows(out / "set_speed_ups.csv", speed_ups);
  files::write_text(
      out / "tables.md",
      fmt::format(
          "# Tables of {}\n\n{}\nEvery algorithm is timed in a process of its own, once in each "
          "round, in "
          "shuffled Latin squares.\nTimes are medians over the squares; intervals are those of the "
          "sign "
          "test at 95 %. Answers were graded before (results/method.md says against what), and are "
          "compared\nwith the graded ones in each sample. Bold: the fastest of ours, and of the "
          "peers, with no wrong answer. The twin is "
          "a "
          "second\nregistration of the baseline: its ratio shows the error of the measurement.\n\n"
          "## Ours against the libraries\n\n{}\n{}{}",
          name, facts_of(folder), best.markdown(), speed_up_section(speed_ups), sections));
  return best.text(base::page_width()) + faults_text(times);
}

}  // namespace touchstone::stats
