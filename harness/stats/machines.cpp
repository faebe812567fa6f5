// Reads which machine measured which block, and compares the ratios of several machines.
#include "harness/stats/machines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "harness/base/error.h"
#include "harness/files/text_file.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {
namespace {

// Returns a row for each cell and contestant that at least two machines measured, from their tables.
std::vector<AcrossRow> across_machines(const std::vector<Tables>& of_machines) {
  using Cell = std::tuple<SetKey, std::string, std::string>;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::map<Cell, AcrossRow> cells;
  for (const Tables& tables : of_machines) {
    std::set<Cell> counted;
    for (const RatioRow& ratio : tables.ratios) {
      if (ratio.canary || ratio.suspect || std::isnan(ratio.ratio.median)) continue;
      SetKey key = ratio.key;
      key.seed.clear();
      key.scene_hash.clear();
      const Cell cell = {key, ratio.label, ratio.baseline};
      AcrossRow& row = cells
                           .try_emplace(cell, AcrossRow{.key = key,
                                                        .label = ratio.label,
                                                        .baseline = ratio.baseline,
                                                        .least = infinity,
                                                        .low = nan,
                                                        .high = nan})
                           .first->second;
      if (counted.insert(cell).second) ++row.machines;
      row.least = std::min(row.least, ratio.ratio.median);
      row.greatest = std::max(row.greatest, ratio.ratio.median);
      // A machine with too few squares that were left undisturbed has no interval.
      if (std::isnan(ratio.ratio.low)) continue;
      row.low = std::isnan(row.low) ? ratio.ratio.low : std::min(row.low, ratio.ratio.low);
      row.high = std::isnan(row.high) ? ratio.ratio.high : std::max(row.high, ratio.ratio.high);
    }
  }
  std::vector<AcrossRow> rows;
  for (auto& [cell, row] : cells) {
    if (row.machines > 1) rows.push_back(std::move(row));
  }
  return rows;
}

std::string across_markdown(const std::vector<AcrossRow>& rows) {
  std::string text =
      "# Ratios across machines\n\nTime over the baseline's in each machine that measured the "
      "cell: "
      "the least and the greatest median, and the outermost ends of the 95 % intervals.\n\n"
      "| cell | algorithm | baseline | machines | ratio | intervals |\n|---|---|---|---|---|---|\n";
  for (const AcrossRow& row : rows) {
    text += fmt::format("| {} | {} | {} | {} | {:.3g} to {:.3g} | {:.3g} to {:.3g} |\n",
                        row.key.words(), row.label, row.baseline, row.machines, row.least,
                        row.greatest, row.low, row.high);
  }
  return text;
}

}  // namespace

std::map<std::int64_t, std::string> machines_of_blocks(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "blocks.csv";
  std::error_code error;
  std::map<std::int64_t, std::string> machines;
  if (!std::filesystem::exists(file, error)) return machines;
  for (BlockRow& row : record::read_rows<BlockRow>(file))
    machines[row.block] = std::move(row.machine);
  return machines;
}

std::string write_machine_tables(const std::map<std::string, Results>& of_machines,
                                 const ReportSetting& setting, double band,
                                 const std::filesystem::path& folder) {
  std::string text;
  std::vector<Tables> all;
  for (const auto& [name, results] : of_machines) {
    const std::filesystem::path own = folder / "machines" / name;
    std::error_code error;
    std::filesystem::create_directories(own, error);
    if (error) throw base::InputError(own.string(), 0, "cannot be made: " + error.message());
    all.push_back(make_tables(results, setting.noise, setting.depth_error));
    write_tables(all.back(), band, own);
    text += fmt::format("{}: {} times, {} ratios in {}\n", name, all.back().times.size(),
                        all.back().ratios.size(), (own / "tables.md").string());
  }
  const std::vector<AcrossRow> rows = across_machines(all);
  record::write_rows(folder / "across.csv", rows);
  files::write_text(folder / "across.md", across_markdown(rows));
  text += fmt::format("{} ratios that several machines measured, as ranges, in {}\n", rows.size(),
                      (folder / "across.md").string());
  return text;
}

}  // namespace touchstone::stats
