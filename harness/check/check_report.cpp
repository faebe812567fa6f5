// Writes the summary of a check as text and as CSV.
#include "harness/check/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "harness/base/table.h"
#include "harness/check/check_rows.h"
#include "harness/check/families/family_tables.h"
#include "harness/check/grouped_counts.h"

namespace touchstone::check {
namespace {

base::Table summary_table(const GroupedCounts& grouped) {
  base::Table table({"", "answers", "silent", "margin", "touching", "width", "gave up", "no status",
                     "failed", "gap", "deep", "shallow", "stuck", "bounds", "flips", "beyond"});
  for (const auto& [label, totals] : grouped.totals()) {
    const grade::AnswerCount& a = totals.answers;
    table.add({grouped.name(label), count(a.answers), count(a.silent), digits(a.margin),
               count(a.within_resolution), digits(a.resolution), count(a.honest),
               count(a.not_reported), count(a.crashed + a.timed_out), digits(a.distance),
               digits(a.too_deep), digits(a.too_shallow), digits(a.does_not_separate),
               count(a.bounds), count(totals.flips.flips),
               grouped.is_ours(label) ? count(a.beyond + totals.flips.beyond) : "-"});
  }
  return table;
}

constexpr std::size_t shown_lines = 30;  // lines shown of faults of ours

constexpr std::string_view summary_key =
    "silent: on the wrong side of contact, with status `ok` or none; margin: the greatest exact\n"
    "|signed distance| of those; touching: answers `touching` within bounds on the signed "
    "distance,\n"
    "which are right if these hold; width: the greatest distance of the bounds; gave up: the "
    "status\n"
    "says so, or there is no answer; no status: answers without a status; failed: crashed or "
    "hung;\n"
    "gap, deep, shallow: the greatest errors of distance and depth; stuck: by how far the\n"
    "reported translation does not separate; bounds: certified bounds that miss the exact value;\n"
    "flips: other answers to the same pair in another form; beyond: ours, beyond the documented\n"
    "margins. All against the exact answer for the bits that the algorithm was given; lengths as\n"
    "parts of the pair's size.\n";

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
  for (std::string& line : broken_family_promises(*request, family_failures)) {
    lines.push_back(std::move(line));
  }
  for (const BroadCheck& check : broad) {
    if (check.good() || check.entry->info.origin != Origin::ours) continue;
    lines.push_back(fmt::format("{} on boxes '{}', seed {}: {}", check.entry->info.name,
                                check.scene->name, request->seed, check.faults()));
  }
  return lines;
}

std::string summary_text(const CheckReport& report, std::size_t page_width) {
  std::string text;
  if (!report.request->narrow.empty()) {
    text = summary_table(GroupedCounts(report)).text(page_width) + '\n' + std::string(summary_key) +
           '\n';
  }
  if (report.request->regime_jobs() > 0 || !report.broad.empty()) text += checked_text(report);
  text += family_summary(*report.request, report.tally->families(), page_width);
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
  std::vector<SummaryRow> rows;
  for (const auto& [key, answers] : report.tally->answers()) {
    const auto flips = report.tally->flips().find(key);
    rows.push_back(
        {key, answers, flips == report.tally->flips().end() ? FlipCount() : flips->second});
  }
  record::write_rows(file, rows, report.request->subjects());
}

}  // namespace touchstone::check
