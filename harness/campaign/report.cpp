#include "harness/campaign/report.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "algorithms/registry.h"
#include "harness/campaign/report_grid.h"
#include "harness/campaign/report_labels.h"

namespace touchstone {

std::string broad_table(const Findings& findings, const ReportStyle& style) {
  const Varying varying(findings.rows(), false);
  std::map<std::int64_t, SetTimes> blocks;
  std::map<std::int64_t, std::string> column_of;  // a block
  std::vector<std::string> columns;
  std::vector<std::string> present;
  std::map<std::string, std::int64_t> checked;  // frames
  for (const RawRow& row : findings.rows()) {
    if (row.phase == Phase::narrow) continue;
    const std::string column = row.scene + " " + count_text(row.bodies) + varying.label(row);
    if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
    column_of[row.block] = column;
    if (std::ranges::find(present, row.broad) == present.end()) present.push_back(row.broad);
    blocks[row.block].add(row);
    if (row.kind == RowKind::check && row.phase == Phase::find_pairs && row.seconds >= 0) {
      ++checked[row.broad];
    }
  }
  if (present.empty()) return "";
  // In the order of the registry; what is not in it comes last.
  const auto place = [](const std::string& name) {
    const auto entries = broad_phases();
    return std::ranges::find_if(entries, [&](const auto& e) { return e.info.name == name; }) -
           entries.begin();
  };
  std::ranges::stable_sort(present, {}, place);
  TimeGrid grid(1e-3, style.noisy);
  for (const std::string& name : present) {
    for (const std::string& column : columns) grid.add_cell(name, column);
  }
  for (const auto& [block, times] : blocks) {
    for (const std::string& name : present) {
      if (times.has(name)) grid.add_samples(name, column_of[block], times, name);
    }
  }
  for (const RawRow& row : findings.rows()) {
    if (row.phase == Phase::narrow) continue;
    if (row.broad == stats::limit_label) grid.add_note(row.broad, column_of[row.block], "°");
    if (row.lost()) grid.add_note(row.broad, column_of[row.block], "!");
    if (row.status == status_wrong) grid.add_note(row.broad, column_of[row.block], "~");
  }
  for (const std::string& name : grid.rows()) {
    std::int64_t departed = 0;
    bool known = true;
    for (const Departure& departure : findings.departures()) {
      if (departure.algorithm != name) continue;
      ++departed;
      known = known && departure.known;
    }
    grid.add_remark(name, departed == 0 ? fmt::format("all {} frames", checked[name])
                                        : fmt::format("{} of {} frames depart{}", departed,
                                                      checked[name], known ? " (known)" : ""));
  }
  return "Broad phases: milliseconds a frame, median; * is the fastest, = cannot be told from it, "
         "! was too slow or failed, ~ is wrong" +
         std::string(std::ranges::find(present, stats::limit_label) == present.end()
                         ? ""
                         : ",\n° is what none can do without: to sort, to gather, to write") +
         "\n\n" + grid.text("agreement", style.page_width) +
         "\nThe runner-up against the winner, with the 95 % interval:\n" + grid.winners();
}

std::string measurement_notes(const Findings& findings, const ReportStyle& style) {
  std::map<std::string, int> stops;
  std::set<std::tuple<std::int64_t, std::string, std::string, std::string, std::string, bool,
                      std::int64_t, std::int64_t>>
      rounds, flagged;
  std::vector<std::string> suspects;
  for (const RawRow& row : findings.rows()) {
    if (row.kind != RowKind::sample) continue;
    if (!row.stop.empty()) ++stops[row.stop];
    const bool narrow = !row.narrow.empty();
    const std::tuple key(row.block, narrow ? row.broad : "", row.task, row.pair_kind, row.scene,
                         narrow, row.square, row.round);
    rounds.insert(key);
    if (row.noise.ends_with("canary")) {
      suspects.push_back(
          fmt::format("  block {}, {}\n", row.block,
                      narrow ? fmt::format("{} {}{}{}", row.task, row.pair_kind,
                                           row.broad.empty() ? "" : " on the pairs of ", row.broad)
                             : "broad phases"));
    }
    if (!row.noise.empty() && row.noise != "canary") flagged.insert(key);
  }
  if (rounds.empty()) return "";
  std::string text = "Sets of contestants ended by:";
  for (const auto& [reason, count] : stops) text += fmt::format(" {} {}", reason, count);
  text += fmt::format(". {} of {} rounds were disturbed{}", flagged.size(), rounds.size(),
                      flagged.empty() ? ""
                      : style.noisy   ? ", and count"
                                      : ", and do not count (--noisy counts them; ? has no other)");
  text += ".\n";
  if (!suspects.empty()) {
    text += "The baseline could be told from itself: the ratios are not to be trusted in\n";
    for (const std::string& suspect : suspects) text += suspect;
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
