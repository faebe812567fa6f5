// Writes the summary of a check as text and as CSV.
#include "harness/check/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "harness/base/text_table.h"
#include "harness/check/grouped_counts.h"
#include "harness/files/csv.h"

namespace touchstone::check {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string count(std::int64_t n) { return std::to_string(n); }

Rows summary_rows(const GroupedCounts& grouped) {
  Rows rows = {{"", "answers", "silent", "margin", "honest", "unsaid", "lost", "gap", "deep",
                "shallow", "stuck", "bounds", "flips", "beyond"}};
  for (const auto& [label, totals] : grouped.totals()) {
    const grade::AnswerCount& a = totals.answers;
    rows.push_back({grouped.name(label), count(a.answers), count(a.silent), digits(a.margin),
                    count(a.honest), count(a.not_reported), count(a.crashed + a.timed_out),
                    digits(a.distance), digits(a.too_deep), digits(a.too_shallow),
                    digits(a.does_not_separate), count(a.bounds), count(totals.flips.flips),
                    grouped.is_ours(label) ? count(a.beyond + totals.flips.beyond) : "-"});
  }
  return rows;
}

constexpr std::size_t shown_lines = 30;  // lines shown of faults of ours

constexpr std::string_view summary_key =
    "silent: on the wrong side of contact, with a status that does not tell; margin: the greatest\n"
    "exact |signed distance| of those; honest: failures that were told; unsaid: answers whose\n"
    "status says nothing; lost: crashed or hung; gap, too deep, shallow: the greatest errors of\n"
    "distance and depth; stuck: by how far the reported translation does not separate; bounds:\n"
    "certified bounds that miss the exact value; flips: other answers to the same pair in another\n"
    "form; beyond: ours, beyond the documented margins. All against the exact answer for the bits\n"
    "that the algorithm was given; lengths as parts of the pair's size.\n";

}  // namespace

std::vector<std::string> CheckReport::ours_wrong() const {
  std::vector<std::string> lines;
  for (const FailureCase& failure : failures) {
    if (!failure.answer.beyond) continue;
    lines.push_back(fmt::format("{} {} {} on {}: {}",
                                request->narrow[failure.answer.entry]->info.name,
                                to_string(failure.answer.scalar), to_string(failure.answer.task),
                                failure.id, failure.what));
  }
  for (const VariantFailure& failure : variant_failures) {
    const VariantCount& count = failure.count;
    lines.push_back(fmt::format(
        "{} {} {} on {} and its variant '{}': {} answers in another form differ, by {:.0e} of the "
        "size",
        request->narrow[count.entry]->info.name, to_string(count.scalar), to_string(count.task),
        failure.id, count.kind, count.beyond, std::max(count.worst_flip, count.worst_difference)));
  }
  for (const TruthFailure& failure : truth_failures) {
    lines.push_back(fmt::format(
        "{}: {} certificates of the oracle refused, {} boxes that do not hold their body; first {} "
        "in {}",
        request->regimes[failure.job.regime]->name, failure.job.refused, failure.job.boxes_broken,
        failure.id, failure.file.string()));
  }
  for (const BroadCheck& check : broad) {
    if (check.good() || check.entry->info.origin != Origin::ours) continue;
    lines.push_back(fmt::format("{} on boxes '{}', seed {}: {}", check.entry->info.name,
                                check.scene->name, request->seed, check.faults()));
  }
  return lines;
}

std::string summary_text(const CheckReport& report, std::size_t page_width) {
  const Rows rows = summary_rows(GroupedCounts(report));
  base::TextTable table(rows.front());
  for (std::size_t i = 1; i < rows.size(); ++i) table.add(rows[i]);
  std::string text = table.text(page_width) + '\n' + std::string(summary_key) + '\n';
  text += checked_text(report);
  for (const BroadPhaseEntry* entry : report.request->broad) {
    std::string scenes;
    for (const BroadCheck& check : report.broad) {
      if (check.entry != entry || check.good() || entry->info.origin == Origin::ours) continue;
      scenes += (scenes.empty() ? "" : ", ") + check.scene->name;
    }
    if (!scenes.empty()) text += fmt::format("  {} is wrong on: {}\n", entry->info.name, scenes);
  }
  const std::vector<std::string> wrong = report.ours_wrong();
  if (wrong.empty()) return text + "None of our own algorithms is wrong beyond its margin.\n";
  text += fmt::format("\nOurs, wrong beyond the documented margin: {}\n", wrong.size());
  for (std::size_t i = 0; i < std::min(wrong.size(), shown_lines); ++i) {
    text += "  " + wrong[i] + '\n';
  }
  if (wrong.size() > shown_lines) {
    text += fmt::format("  and {} more like them\n", wrong.size() - shown_lines);
  }
  std::set<std::string> commands;
  for (const FailureCase& failure : report.failures) {
    if (failure.answer.beyond) commands.insert(failure.command(*report.request));
  }
  for (const VariantFailure& failure : report.variant_failures) {
    commands.insert(query_command(*report.request, failure.query, failure.file));
  }
  if (!commands.empty()) text += "Shown by\n";
  for (const std::string& command : commands) text += "  " + command + '\n';
  return text;
}

void write_summary(const CheckReport& report, const std::filesystem::path& file) {
  files::CsvWriter csv(
      file,
      {"algorithm",     "scalar",        "regime",           "group",           "answers",
       "silent",        "silent_end",    "honest",           "not_reported",    "crashed",
       "timed_out",     "touching",      "touching_contact", "bounds",          "not_a_number",
       "beyond_margin", "honest_margin", "margin",           "margin_end",      "distance",
       "distance_end",  "too_deep",      "too_shallow",      "depth_end",       "does_not_separate",
       "excess",        "bounds_missed", "witness",          "witness_length",  "normal",
       "variants",      "flips",         "worst_flip",       "worst_difference"});
  const CheckRequest& request = *report.request;
  for (const auto& [key, a] : report.tally->answers()) {
    const Regime& regime = *request.regimes[key.regime];
    csv.field(request.narrow[key.entry]->info.name).field(to_string(key.scalar));
    csv.field(regime.name).field(regime.group);
    for (const std::int64_t n :
         {a.answers, a.silent, a.silent_end, a.honest, a.not_reported, a.crashed, a.timed_out,
          a.touching, a.touching_contact, a.bounds, a.not_a_number, a.beyond}) {
      csv.field(n);
    }
    for (const double x : {a.honest_margin, a.margin, a.margin_end, a.distance, a.distance_end,
                           a.too_deep, a.too_shallow, a.depth_end, a.does_not_separate, a.excess,
                           a.bounds_missed, a.witness, a.witness_length, a.normal}) {
      csv.field(x);
    }
    const auto flips = report.tally->flips().find(key);
    const FlipCount f = flips == report.tally->flips().end() ? FlipCount() : flips->second;
    csv.field(f.compared).field(f.flips).field(f.worst_flip).field(f.worst_difference);
    csv.end_row();
  }
  csv.close();
}

}  // namespace touchstone::check
