#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "algorithms/registry.h"
#include "harness/campaign/check_pass/check_table.h"
#include "harness/campaign/report.h"
#include "harness/campaign/report_grid.h"
#include "harness/campaign/report_labels.h"
#include "harness/grade/outcome_check.h"

namespace touchstone {
namespace {

// Kinds of pairs that a table shows, the most frequent ones.
constexpr std::size_t most_kinds = 9;

// What the check pass says of one algorithm.
struct Agreement {
  std::int64_t compared = 0, disagree = 0, gave_up = 0, lost = 0;
  double worst = 0, worst_error = Outcome::none;

  void add(const RawRow& row) {
    if (row.lost()) {
      lost += std::max<std::int64_t>(row.failures, 1);
      return;
    }
    if (row.kind != RowKind::check || row.compared < 0) return;
    compared += row.compared;
    disagree += row.disagreements;
    gave_up += std::max<std::int64_t>(row.failures, 0);
    if (row.disagreements > 0) worst = std::max(worst, row.worst_disagreement);
    worst_error = std::fmax(worst_error, row.worst_error);
  }
  std::string text(Task task) const {
    std::string remark =
        disagree == 0 ? fmt::format("all {}", compared)
                      : fmt::format("{} of {} differ, by {:.2g} m", disagree, compared, worst);
    if (gave_up > 0) remark += fmt::format(", {} gave up", gave_up);
    if (lost > 0) remark += fmt::format(", {} lost", lost);
    if (task != Task::intersect && !std::isnan(worst_error)) {
      remark += fmt::format(", error {:.0e}", worst_error);
    }
    return remark;
  }
};

// One task's table.
class NarrowTable {
 public:
  NarrowTable(const Findings& findings, Task task, const ReportStyle& style)
      : style_(style), varying_(findings.rows(), true) {
    for (const RawRow& row : findings.rows()) {
      if (row.phase != Phase::narrow || row.task != to_string(task) ||
          row.status == to_string(Status::unsupported)) {
        continue;
      }
      sets_[{row.block, set_key(row)}].add(row);
      if (row.twin != 1) rows_.push_back(&row);
      if (row.kind == RowKind::check)
        queries_[row.pair_kind] += std::max<std::int64_t>(row.pair_count, 0);
    }
    std::ranges::stable_sort(rows_, {}, [](const RawRow* row) { return place(*row); });
  }

  std::string text(Task task) const {
    if (rows_.empty()) return "";
    const std::vector<std::string> kinds = shown_kinds();
    const auto is_shown = [&](const std::string& kind) {
      return std::ranges::find(kinds, kind) != kinds.end();
    };
    TimeGrid grid(1e-9, style_.noisy);
    std::map<std::string, Agreement> agreements;
    std::map<std::pair<std::string, std::string>, std::vector<const SetTimes*>> added;
    for (const RawRow* row : rows_) {
      const std::string base = label_of(*row);
      const std::string label = base + varying_.label(*row);
      for (const std::string& kind : kinds) grid.add_cell(label, kind);
      agreements[label].add(*row);
      if (!is_shown(row->pair_kind)) continue;
      if (row->lost()) grid.add_note(label, row->pair_kind, "!");
      if (row->disagreements > 0 || row->status == status_wrong) {
        grid.add_note(label, row->pair_kind, "~");
      }
      const SetTimes& times = sets_.at({row->block, set_key(*row)});
      std::vector<const SetTimes*>& known = added[{label, row->pair_kind}];
      if (times.has(base) && std::ranges::find(known, &times) == known.end()) {
        known.push_back(&times);
        grid.add_samples(label, row->pair_kind, times, base);
      }
    }
    for (const auto& [label, agreement] : agreements) grid.add_remark(label, agreement.text(task));
    return fmt::format(
               "Narrow phases, task {}: nanoseconds a query, median; * is the fastest of "
               "those that agree, = cannot be told from it, ~ disagrees on some pair, "
               "! crashed, hung or was too slow\n\n",
               to_string(task)) +
           grid.text(fmt::format("agreement with {}", Reference::name()), style_.page_width) +
           "\nThe runner-up against the winner, with the 95 % interval:\n" + grid.winners() + "\n";
  }

 private:
  // In the order of the registry; what is not in it comes last.
  static std::pair<std::ptrdiff_t, bool> place(const RawRow& row) {
    const auto entries = narrow_phases();
    const auto at = std::ranges::find_if(
        entries, [&](const auto& entry) { return entry.info.name == row.narrow; });
    return {at - entries.begin(), row.scalar == to_string(Precision::float64)};
  }
  std::vector<std::string> shown_kinds() const {
    std::vector<std::string> kinds;
    kinds.reserve(queries_.size());
    for (const auto& [kind, count] : queries_) kinds.push_back(kind);
    std::ranges::stable_sort(kinds, std::greater(),
                             [&](const std::string& kind) { return queries_.at(kind); });
    kinds.resize(std::min(kinds.size(), most_kinds));
    return kinds;
  }

  ReportStyle style_;
  Varying varying_;
  std::map<std::pair<std::int64_t, std::string>, SetTimes> sets_;
  std::vector<const RawRow*> rows_;
  std::map<std::string, std::int64_t> queries_;  // of each kind, over all rows
};

}  // namespace

std::string narrow_tables(const Findings& findings, const ReportStyle& style) {
  std::string text;
  for (const Task task : {Task::intersect, Task::distance, Task::penetration}) {
    text += NarrowTable(findings, task, style).text(task);
  }
  return text;
}

}  // namespace touchstone
