#include "harness/run/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "algorithms/registry.h"
#include "harness/run/text_table.h"

namespace touchstone {
namespace {

// A grid of times with the fastest of each column marked. Rows and columns keep the order in which
// they first came.
class Grid {
 public:
  struct Cell {
    double time = std::numeric_limits<double>::quiet_NaN();
    std::string note;  // stands in for a time, or behind it
  };
  Cell& at(const std::string& row, const std::string& column) {
    remember(rows_, row);
    remember(columns_, column);
    return cells_[{row, column}];
  }
  void add_remark(const std::string& row, std::string remark) { remarks_[row] = std::move(remark); }

  std::string text(const std::string& corner, const std::string& remark_title,
                   std::size_t page_width) const {
    std::map<std::string, double> fastest;
    for (const auto& [key, cell] : cells_) {
      // A time that stands beside a departure does not win.
      if (std::isnan(cell.time) || !cell.note.empty()) continue;
      const auto [best, is_new] = fastest.try_emplace(key.second, cell.time);
      if (!is_new) best->second = std::min(best->second, cell.time);
    }
    std::vector<std::string> header = {corner};
    header.insert(header.end(), columns_.begin(), columns_.end());
    header.push_back(remark_title);
    TextTable table(std::move(header));
    for (const std::string& row : rows_) {
      std::vector<std::string> line = {row};
      for (const std::string& column : columns_) {
        const auto cell = cells_.find({row, column});
        if (cell == cells_.end()) {
          line.emplace_back("-");
        } else if (std::isnan(cell->second.time)) {
          line.push_back(cell->second.note);
        } else {
          const auto best = fastest.find(column);
          const bool wins = best != fastest.end() && cell->second.note.empty() &&
                            best->second == cell->second.time;
          line.push_back((wins ? "*" : "") + number(cell->second.time) + cell->second.note);
        }
      }
      const auto remark = remarks_.find(row);
      line.push_back(remark == remarks_.end() ? "" : remark->second);
      table.add(std::move(line));
    }
    return table.text(page_width);
  }
  bool empty() const { return rows_.empty(); }
  const std::vector<std::string>& rows() const { return rows_; }

 private:
  static void remember(std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  static std::string number(double value) {
    if (value >= 100) return fmt::format("{:.0f}", value);
    return value >= 10 ? fmt::format("{:.1f}", value) : fmt::format("{:.3g}", value);
  }

  std::vector<std::string> rows_, columns_;
  std::map<std::pair<std::string, std::string>, Cell> cells_;
  std::map<std::string, std::string> remarks_;
};

struct Weighted {
  double value, weight;
};

// Half of the weight is at or below it: rows of many queries count for more than rows of few, and a
// row that was interrupted counts for no more than its queries.
double median(std::vector<Weighted> values) {
  std::ranges::sort(values, {}, &Weighted::value);
  double rest = 0;
  for (const Weighted& v : values) rest += v.weight / 2;
  for (const Weighted& v : values) {
    rest -= v.weight;
    if (rest <= 0) return v.value;
  }
  return values.back().value;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::string count_text(std::int64_t count) {
  if (count >= 1'000'000 && count % 1'000'000 == 0) return fmt::format("{}M", count / 1'000'000);
  return count >= 1000 && count % 1000 == 0 ? fmt::format("{}k", count / 1000)
                                            : std::to_string(count);
}

// The rows of the broad phases, or of the narrow ones, that hold a setting in more than one value:
// only those are worth a word in a label.
struct Varying {
  bool threads = false;
  bool boxes = false;

  Varying(const std::vector<RawRow>& rows, bool narrow) {
    std::set<int> widths;
    std::set<std::string> kinds;
    for (const RawRow& row : rows) {
      if ((row.phase == Phase::narrow) != narrow) continue;
      widths.insert(row.threads);
      kinds.insert(row.boxes);
    }
    threads = widths.size() > 1;
    boxes = kinds.size() > 1;
  }
  std::string label(const RawRow& row) const {
    return (boxes ? " " + row.boxes : "") + (threads ? fmt::format(" {}t", row.threads) : "");
  }
};

// Kinds of pairs that a table shows, the most frequent ones.
constexpr std::size_t most_kinds = 9;

bool failed(const RawRow& row) {
  return row.status == to_string(Status::crashed) || row.status == to_string(Status::timed_out);
}

// In the order of the registry.
template <class Entry>
void order_rows(Grid& grid, std::span<const Entry> entries, const std::set<std::string>& present,
                const std::vector<std::string>& columns) {
  for (const Entry& entry : entries) {
    if (!present.contains(entry.info.name)) continue;
    for (const std::string& column : columns) grid.at(entry.info.name, column);
  }
}

}  // namespace

std::string broad_table(const Findings& findings, std::size_t page_width) {
  const Varying varying(findings.rows(), false);
  // Seconds of each frame of an algorithm in a column: preparing and finding together.
  std::map<std::pair<std::string, std::string>, std::map<int, double>> frames;
  std::map<std::pair<std::string, std::string>, bool> has_update;
  std::set<std::pair<std::string, std::string>> lost;
  std::vector<std::string> columns;
  std::set<std::string> present;
  for (const RawRow& row : findings.rows()) {
    if (row.phase == Phase::narrow) continue;
    const std::string column = row.scene + " " + count_text(row.bodies) + varying.label(row);
    if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
    present.insert(row.broad);
    if (failed(row)) {
      lost.insert({row.broad, column});
      continue;
    }
    frames[{row.broad, column}][row.frame] += row.seconds;
    if (row.phase == Phase::update) has_update[{row.broad, column}] = true;
  }
  Grid grid;
  order_rows(grid, broad_phases(), present, columns);
  for (const auto& [key, seconds] : frames) {
    std::vector<double> values;
    for (const auto& [frame, value] : seconds) {
      // The first frame is a build; where the others are updates it is no sample of them.
      if (frame > 0 || !has_update[key]) values.push_back(value * 1e3);
    }
    grid.at(key.first, key.second).time = median(values);
  }
  for (const auto& key : lost) grid.at(key.first, key.second).note = "!";

  for (const std::string& name : grid.rows()) {
    std::int64_t checked = 0;
    for (const auto& [key, seconds] : frames) {
      if (key.first == name) checked += static_cast<std::int64_t>(seconds.size());
    }
    std::int64_t departed = 0;
    bool known = true;
    for (const Departure& departure : findings.departures()) {
      if (departure.algorithm != name) continue;
      ++departed;
      known = known && departure.known;
    }
    grid.add_remark(name, departed == 0 ? fmt::format("all {} frames", checked)
                                        : fmt::format("{} of {} frames depart{}", departed, checked,
                                                      known ? " (known)" : ""));
  }
  if (grid.empty()) return "";
  return "Broad phases: milliseconds a frame, median; * is the fastest, ! was too slow or "
         "failed\n\n" +
         grid.text("", "agreement", page_width);
}

std::string narrow_tables(const Findings& findings, std::size_t page_width) {
  const Varying varying(findings.rows(), true);
  struct Sum {
    std::vector<Weighted> times;  // nanoseconds a query, of each row
    std::int64_t queries = 0;
    bool lost = false;
  };
  std::map<Task, std::map<std::pair<std::string, std::string>, Sum>> tasks;
  std::map<Task, std::vector<std::string>> order;
  std::map<std::string, std::string> base_of;  // a label without what varies
  const auto task_of = [](const std::string& name) {
    return name == to_string(Task::intersect)  ? Task::intersect
           : name == to_string(Task::distance) ? Task::distance
                                               : Task::penetration;
  };
  for (const NarrowPhaseEntry& entry : narrow_phases()) {
    for (const Precision scalar : entry.scalars) {
      for (const RawRow& row : findings.rows()) {
        if (row.phase != Phase::narrow || row.narrow != entry.info.name ||
            row.scalar != to_string(scalar) || row.status == to_string(Status::unsupported)) {
          continue;
        }
        const Task task = task_of(row.task);
        const std::string base = narrow_label(row.narrow, row.scalar, row.tolerance);
        const std::string label = base + varying.label(row);
        base_of[label] = base;
        std::vector<std::string>& labels = order[task];
        if (std::ranges::find(labels, label) == labels.end()) labels.push_back(label);
        Sum& sum = tasks[task][{label, row.pair_kind}];
        if (failed(row)) {
          sum.lost = true;
        } else {
          const auto count = static_cast<double>(row.pair_count);
          sum.times.push_back({1e9 * row.seconds / count, count});
          sum.queries += row.pair_count;
        }
      }
    }
  }
  std::string text;
  for (const auto& [task, sums] : tasks) {
    std::map<std::string, std::int64_t> queries;
    for (const auto& [key, sum] : sums) queries[key.second] += sum.queries;
    std::vector<std::string> kinds;
    kinds.reserve(queries.size());
    for (const auto& [kind, count] : queries) kinds.push_back(kind);
    std::ranges::stable_sort(kinds, std::greater(),
                             [&](const auto& kind) { return queries[kind]; });
    const std::size_t left_out = kinds.size() - std::min(kinds.size(), most_kinds);
    kinds.resize(kinds.size() - left_out);
    Grid grid;
    for (const std::string& label : order[task]) {
      for (const std::string& kind : kinds) {
        const auto sum = sums.find({label, kind});
        if (sum == sums.end()) continue;
        Grid::Cell& cell = grid.at(label, kind);
        if (sum->second.queries > 0) cell.time = median(sum->second.times);
        if (sum->second.lost) cell.note = "!";
      }
      OutcomeFaults all;
      for (const auto& [key, faults] : findings.outcomes()) {
        const auto& [its_task, narrow, kind] = key;
        if (its_task != task || base_of[label] != narrow) continue;
        all.add(faults);
        if (faults.disagree > 0 && std::ranges::find(kinds, kind) != kinds.end()) {
          grid.at(label, kind).note += "~";
        }
      }
      std::string remark = all.disagree == 0 ? fmt::format("all {}", all.compared)
                                             : fmt::format("{} of {} differ, by {:.2g} m",
                                                           all.disagree, all.compared, all.worst);
      if (all.failed > 0) remark += fmt::format(", {} gave up", all.failed);
      if (all.lost()) remark += fmt::format(", {} lost", all.crashed + all.timed_out);
      if (task != Task::intersect && all.values > 0) {
        remark += fmt::format(", error {:.0e}", all.worst_value_error);
      }
      grid.add_remark(label, remark);
    }
    text += fmt::format(
        "Narrow phases, task {}: nanoseconds a query, median; * is the fastest of those that "
        "agree, ~ "
        "disagrees "
        "on some pair, ! crashed, hung or was too slow\n\n",
        to_string(task));
    text += grid.text("", fmt::format("agreement with {}", Reference::name()), page_width);
    text += '\n';
  }
  return text;
}

std::string departures(const Findings& findings) {
  // One line for each algorithm and manner; the first case stands for the others.
  std::map<std::pair<std::string, bool>, std::vector<const Departure*>> by_algorithm;
  for (const Departure& departure : findings.departures()) {
    by_algorithm[{departure.algorithm, departure.known}].push_back(&departure);
  }
  std::string text;
  for (const auto& [key, list] : by_algorithm) {
    const Departure& first = *list.front();
    text += fmt::format("{}{}: {}\n    on {}\n", first.algorithm,
                        first.known  ? ""
                        : first.ours ? " (OURS)"
                                     : " (peer)",
                        first.what, first.where);
    if (list.size() > 1) text += fmt::format("    and {} more like it\n", list.size() - 1);
    if (!first.reproduction.empty()) text += fmt::format("    shown by {}\n", first.reproduction);
  }
  return text.empty() ? text : "Departures\n\n" + text;
}

}  // namespace touchstone
