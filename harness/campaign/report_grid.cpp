#include "harness/campaign/report_grid.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/base/text_table.h"

namespace touchstone {
namespace {

constexpr double confidence = 0.95;

void remember(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

std::string number(double value) {
  if (value >= 100) return fmt::format("{:.0f}", value);
  return value >= 10 ? fmt::format("{:.1f}", value) : fmt::format("{:.3g}", value);
}

std::vector<double> logarithms(std::vector<double> values) {
  for (double& value : values) value = std::log(value);
  return values;
}

}  // namespace

void TimeGrid::add_cell(const std::string& row, const std::string& column) {
  remember(rows_, row);
  remember(columns_, column);
  cells_.try_emplace({row, column});
}

void TimeGrid::add_samples(const std::string& row, const std::string& column, const SetTimes& set,
                           const std::string& contestant) {
  add_cell(row, column);
  cells_[{row, column}].parts.emplace_back(&set, contestant);
}

void TimeGrid::add_note(const std::string& row, const std::string& column,
                        const std::string& note) {
  add_cell(row, column);
  std::string& text = cells_[{row, column}].note;
  if (text.find(note) == std::string::npos) text += note;
}

const TimeGrid::Cell* TimeGrid::find(const std::string& row, const std::string& column) const {
  const auto at = cells_.find({row, column});
  return at == cells_.end() ? nullptr : &at->second;
}

std::vector<double> TimeGrid::times(const Cell& cell, bool noisy) const {
  std::vector<double> all;
  for (const auto& [set, contestant] : cell.parts) {
    const std::vector<double> times = set->times(contestant, noisy);
    all.insert(all.end(), times.begin(), times.end());
  }
  return all;
}

// Paired where they met in a square, by the baseline where they met in a set only; contestants of
// different blocks are compared as they stand.
stats::MedianInterval TimeGrid::log_ratio(const Cell& a, const Cell& b) const {
  std::vector<double> paired;
  std::optional<stats::MedianInterval> by_baseline;
  for (const auto& [set_a, label_a] : a.parts) {
    for (const auto& [set_b, label_b] : b.parts) {
      if (set_a != set_b) continue;
      const std::vector<double> ratios = set_a->log_ratios(label_a, label_b, noisy_);
      paired.insert(paired.end(), ratios.begin(), ratios.end());
      if (!by_baseline) by_baseline = set_a->log_ratio(label_a, label_b, noisy_, confidence);
    }
  }
  if (!paired.empty()) return stats::median_interval(std::move(paired), confidence);
  if (by_baseline && !std::isnan(by_baseline->median)) return *by_baseline;
  return stats::shift(logarithms(times(b, noisy_)), logarithms(times(a, noisy_)), confidence);
}

double TimeGrid::least(const Cell& cell) const { return std::ranges::min(times(cell, noisy_)); }
double TimeGrid::greatest(const Cell& cell) const { return std::ranges::max(times(cell, noisy_)); }

TimeGrid::Ranking TimeGrid::rank(const std::string& column) const {
  std::vector<std::pair<double, std::string>> order;
  for (const std::string& row : rows_) {
    const Cell* cell = find(row, column);
    if (cell == nullptr || !cell->note.empty()) continue;
    std::vector<double> values = times(*cell, noisy_);
    if (!values.empty()) order.emplace_back(stats::median(std::move(values)), row);
  }
  std::ranges::stable_sort(order, {}, &std::pair<double, std::string>::first);
  Ranking ranking;
  if (order.empty()) return ranking;
  ranking.first = order.front().second;
  ranking.leaders.push_back(ranking.first);
  const Cell& first = *find(ranking.first, column);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const auto ratio = log_ratio(*find(order[i].second, column), first);
    if (i == 1) {
      ranking.second = order[i].second;
      ranking.log_ratio = ratio;
    }
    // Without an interval, samples that do not overlap tell enough.
    const bool slower = std::isfinite(ratio.low)
                            ? ratio.low > 0
                            : least(*find(order[i].second, column)) > greatest(first);
    if (!slower) ranking.leaders.push_back(order[i].second);
  }
  ranking.alone = ranking.leaders.size() == 1;
  return ranking;
}

std::string TimeGrid::cell_text(const Cell& cell, const std::string& row,
                                const Ranking& ranking) const {
  std::vector<double> values = times(cell, noisy_);
  std::string note = cell.note;
  if (values.empty()) {
    values = times(cell, true);
    if (!values.empty()) note += "?";
  }
  if (values.empty()) return note.empty() ? "-" : note;
  const auto interval = stats::median_interval(values, confidence);
  const bool leads = std::ranges::find(ranking.leaders, row) != ranking.leaders.end();
  std::string text = leads ? (ranking.alone ? "*" : "=") : "";
  text += number(interval.median / unit_);
  const double half = (interval.high - interval.low) / 2 / interval.median;
  if (std::isfinite(half)) text += fmt::format(" \u00b1{:.0f}%", 100 * half);
  return text + note;
}

std::string TimeGrid::text(const std::string& remark_title, std::size_t page_width) const {
  std::vector<std::string> header = {""};
  header.insert(header.end(), columns_.begin(), columns_.end());
  header.push_back(remark_title);
  TextTable table(std::move(header));
  std::map<std::string, Ranking> rankings;
  for (const std::string& column : columns_) rankings[column] = rank(column);
  for (const std::string& row : rows_) {
    std::vector<std::string> line = {row};
    for (const std::string& column : columns_) {
      const Cell* cell = find(row, column);
      line.push_back(cell == nullptr ? "-" : cell_text(*cell, row, rankings[column]));
    }
    const auto remark = remarks_.find(row);
    line.push_back(remark == remarks_.end() ? "" : remark->second);
    table.add(std::move(line));
  }
  return table.text(page_width);
}

std::string TimeGrid::winners() const {
  std::string text;
  for (const std::string& column : columns_) {
    const Ranking ranking = rank(column);
    if (ranking.second.empty()) continue;
    const stats::MedianInterval& ratio = ranking.log_ratio;
    const std::string interval =
        std::isfinite(ratio.low)
            ? fmt::format("{:.3f} to {:.3f}", std::exp(ratio.low), std::exp(ratio.high))
            : fmt::format("no interval, {} squares", ratio.n);
    const std::string times = fmt::format("{:.3f} ({})", std::exp(ratio.median), interval);
    text += fmt::format(
        "  {}: {} takes {} times the time of {}{}\n", column, ranking.second, times, ranking.first,
        ranking.alone ? "" : fmt::format("; {} cannot be told apart", ranking.leaders.size()));
  }
  return text;
}

}  // namespace touchstone
