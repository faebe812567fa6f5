// Finds cells that differ in threads by their names.
#include "harness/stats/cells/cell_speed_ups.h"

#include <algorithm>
#include <charconv>
#include <string_view>

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
      const MedianInterval ratio = exponential(median_interval(logs, cell_confidence));
      all.push_back({cell.name.first, std::string(name.rest), row.grade.algorithm, row.grade.origin,
                     name.threads, ratio.median, ratio.low, ratio.high});
    }
  }
  return all;
}

}  // namespace touchstone::stats
