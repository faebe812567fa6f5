// Reads the rows of a cell run, and finds the fastest of each cell.
#include "harness/stats/cells/cell_times.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "harness/record/row.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {
namespace {

using Name = std::pair<std::string, std::string>;

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

}  // namespace

std::vector<CellTimes> read_cell_times(const std::filesystem::path& folder) {
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

}  // namespace touchstone::stats
