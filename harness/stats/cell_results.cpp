// Reads the rows of a cell run, and finds the fastest of each cell.
#include "harness/stats/cell_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "harness/base/enumerators.h"
#include "harness/base/error.h"
#include "harness/files/packed_files.h"
#include "harness/measure/measure_plan.h"
#include "harness/record/machine.h"
#include "harness/record/raw_row.h"
#include "harness/record/row.h"
#include "harness/stats/cell_rows.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {
namespace {

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

// The ratio of the times of a and b.
MedianInterval ratio_of(const Contestant& a, const Contestant& b, Noise noise) {
  return exponential(median_interval(paired_log_ratios(a, b, noise), usual_confidence));
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
  best.baseline = cell.twin.label;
  if (!best.baseline.empty()) {
    const MedianInterval twin = ratio_of(cell.twin, cell.contestants[best.baseline], cell.noise);
    best.twin = twin.median;
    best.twin_low = twin.low;
    best.twin_high = twin.high;
  }
  if (!peer) return;
  best.peer = cell.rows[*peer].grade.algorithm;
  const MedianInterval ratio =
      ratio_of(cell.contestants[best.peer], cell.contestants[best.ours], cell.noise);
  best.ratio = ratio.median;
  best.low = ratio.low;
  best.high = ratio.high;
}

// A disturbed round counts where too few would be left without it, since a ratio within a square still
// holds.
Noise noise_of(const CellTimes& cell) {
  std::size_t samples = 0, quiet = 0;
  std::set<SquareKey> squares;
  for (const auto& [name, contestant] : cell.contestants) {
    for (const Sample& sample : contestant.samples) {
      ++samples;
      if (sample.noisy) continue;
      ++quiet;
      squares.emplace(sample.process, sample.square);
    }
  }
  return 2 * quiet >= samples && squares.size() >= measure::first_look ? Noise::left_out
                                                                       : Noise::kept;
}

void take_times(CellTimes& cell) {
  cell.noise = noise_of(cell);
  for (CellTimeRow& row : cell.rows) {
    const Contestant& contestant = cell.contestants[row.grade.algorithm];
    if (contestant.failure) {
      row.grade.status = to_string(*contestant.failure);
      continue;
    }
    row.samples = std::ranges::count_if(contestant.samples, [&](const Sample& sample) {
      return cell.noise == Noise::kept || !sample.noisy;
    });
    std::vector<double> seconds;
    for (const auto& [square, value] : by_square(contestant, cell.noise)) seconds.push_back(value);
    if (seconds.empty()) continue;
    const MedianInterval time = median_interval(seconds, usual_confidence);
    row.seconds = time.median;
    row.low = time.low;
    row.high = time.high;
  }
}

}  // namespace

void add_sample(Contestant& contestant, const record::RawRow& row) {
  contestant.label = row.algorithm;
  contestant.origin = row.origin;
  if (row.lost() || row.wrong()) contestant.failure = row.status;
  if (!(row.seconds >= 0)) return;
  add_phase(contestant, row);
}

std::vector<CellTimes> read_cell_times(const std::filesystem::path& folder) {
  std::vector<CellTimes> cells;
  std::map<std::pair<std::string, std::string>, std::size_t> place;
  for (const GradeRow& row : record::read_rows<GradeRow>(folder / "set_grades.csv")) {
    const auto [at, is_new] = place.emplace(std::pair(row.group, row.cell), cells.size());
    if (is_new) cells.emplace_back().name = {row.group, row.cell};
    cells[at->second].rows.emplace_back().grade = row;
  }
  for (const record::RawRow& row : record::read_rows<record::RawRow>(folder / "raw.csv")) {
    const auto at = place.find({row.input, row.family});
    if (at == place.end()) continue;
    CellTimes& cell = cells[at->second];
    add_sample(row.is_twin() ? cell.twin : cell.contestants[row.algorithm], row);
  }
  for (CellTimes& cell : cells) {
    take_times(cell);
    compare(cell);
  }
  return cells;
}

namespace {

std::filesystem::path folder_of(const std::filesystem::path& folder_or_file) {
  return std::filesystem::is_directory(folder_or_file) ? folder_or_file
                                                       : folder_or_file.parent_path();
}

template <class Enum>
std::optional<Enum> named(std::string_view name) {
  for (const Enum value : base::enumerators<Enum>)
    if (to_string(value) == name) return value;
  return std::nullopt;
}

Contestant contestant_of(const GradeRow& row) {
  Contestant contestant;
  contestant.label = row.algorithm;
  contestant.origin = named<record::RowOrigin>(row.origin);
  Check& check = contestant.checks.emplace_back();
  check.phase = record::Phase::narrow;
  check.grade = fmt::format("{} missed, {} false, {} inexact, {} gave up", row.missed,
                            row.false_hits, row.inexact, row.gave_up);
  if (row.hits >= 0) check.grade += fmt::format(", {} hits ({})", row.hits, row.hit_hash);
  check.status = named<record::RowStatus>(row.status).value_or(record::RowStatus::wrong);
  if (check.status != record::RowStatus::ok) contestant.failure = check.status;
  return contestant;
}

}  // namespace

bool is_of_cells(const std::filesystem::path& folder_or_file) {
  return std::filesystem::exists(files::row_file(folder_of(folder_or_file) / "set_grades.csv"));
}

Results read_cell_results(const std::filesystem::path& folder_or_file) {
  const std::filesystem::path folder = folder_of(folder_or_file);
  Results results;
  results.file = folder / "raw.csv";
  if (std::filesystem::exists(folder / "machine.csv")) {
    const record::Facts facts = record::read_facts(folder / "machine.csv");
    for (const auto& [name, value] : facts) results.machine[name] = value;
    results.campaign = record::value_of(facts, "cells");
    results.isa = {record::value_of(facts, "instructions_in_use")};
  }
  std::map<std::pair<std::string, std::string>, std::size_t> place;
  for (const GradeRow& row : record::read_rows<GradeRow>(folder / "set_grades.csv")) {
    if (row.status == "unsupported") continue;
    const auto [at, is_new] = place.emplace(std::pair(row.group, row.cell), results.sets.size());
    if (is_new) {
      SetKey& key = results.sets.emplace_back().key;
      key.scene = row.group + ", " + row.cell;
      key.scene_hash = results.machine["cells_hash"];
    }
    results.sets[at->second].contestants.push_back(contestant_of(row));
  }
  for (const record::RawRow& row : record::read_rows<record::RawRow>(results.file)) {
    const auto at = place.find({row.input, row.family});
    Contestant* contestant = nullptr;
    if (at != place.end()) {
      SampleSet& set = results.sets[at->second];
      for (Contestant& each : set.contestants)
        if (each.label == row.algorithm) contestant = &each;
      if (contestant != nullptr && row.is_twin()) contestant = &set.twin;
      if (row.noise.ends_with(canary_flag)) set.suspect = true;
      if (!row.stop.empty()) set.stop = row.stop;
    }
    if (contestant == nullptr)
      throw base::InputError(results.file.string(), 0,
                             fmt::format("{} in {}, {} has samples and no grade in set_grades.csv",
                                         row.algorithm, row.input, row.family));
    add_sample(*contestant, row);
  }
  return results;
}

}  // namespace touchstone::stats
