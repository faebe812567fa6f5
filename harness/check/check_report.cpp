// Writes the summary of a check as text and as CSV.
#include "harness/check/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "harness/base/table.h"
#include "harness/check/check_rows.h"
#include "harness/check/envelope.h"
#include "harness/check/family_tables.h"
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

// The faults of graded cases beyond the margins.
std::vector<std::string> wrong_cases(const CheckReport& report) {
  const CheckRequest& request = *report.request;
  std::vector<std::string> lines;
  for (const FailureCase& failure : report.failures) {
    if (!failure.answer.beyond) continue;
    lines.push_back(fmt::format("{} {} {} on {}: {}",
                                request.narrow[failure.answer.entry]->info.name,
                                to_string(failure.answer.scalar), to_string(failure.answer.task),
                                failure.id, failure.what));
  }
  for (const VariantFailure& failure : report.variant_failures) {
    const VariantCount& count = failure.count;
    lines.push_back(fmt::format(
        "{} {} {} on {} and its variant '{}': {} answers in another form differ, by {:.0e} of the "
        "size",
        request.narrow[count.entry]->info.name, to_string(count.scalar), to_string(count.task),
        failure.id, count.kind, count.beyond, std::max(count.worst_flip, count.worst_difference)));
  }
  for (const TruthFailure& failure : report.truth_failures) {
    lines.push_back(fmt::format(
        "{}: {} certificates of the oracle refused, {} boxes that do not hold their body; first {} "
        "in {}",
        request.regimes[failure.job.regime]->name, failure.job.refused, failure.job.boxes_broken,
        failure.id, failure.file.string()));
  }
  return lines;
}

// The counts in which ours is silently wrong or lost.
std::vector<std::string> wrong_counts(const CheckReport& report) {
  std::vector<std::string> lines;
  for (const auto& [key, count] : report.tally.verdicts()) {
    const NarrowPhaseEntry& entry = *report.request->narrow[key.entry];
    if (entry.info.origin != Origin::ours || entry.traits.approximate) continue;
    if (count.silent + count.lost == 0) continue;
    lines.push_back(fmt::format("{} on {}: of {} pairs {} silently wrong, {} failed; first case {}",
                                report.request->name({key.entry, key.scalar}),
                                report.request->regimes[key.regime]->name, count.pairs,
                                count.silent, count.lost, count.first_wrong));
  }
  return lines;
}

std::string counts_text(const CheckReport& report, std::size_t page_width) {
  const CheckRequest& request = *report.request;
  std::map<CheckedAlgorithm, VerdictCount> totals;
  for (const auto& [key, one] : report.tally.verdicts()) totals[{key.entry, key.scalar}].add(one);
  base::Table table({"algorithm", "pairs", "separated", "touching", "overlapping", "unresolved",
                     "silent errors", "gave up", "failed"});
  for (const auto& [algorithm, sum] : totals) {
    table.add({request.name(algorithm), count(sum.pairs), count(sum.separated), count(sum.touching),
               count(sum.overlapping), count(sum.unresolved), count(sum.silent), count(sum.honest),
               count(sum.lost)});
  }
  std::string text = request.narrow.empty() ? "" : table.text(page_width);
  text += family_summary(report, page_width);
  const auto all = static_cast<std::int64_t>(request.period());
  if (report.jobs < all && !report.interrupted) {
    text += fmt::format(
        "\nOnly {} of {} regimes and families were asked, each {} cases; --count {} asks "
        "all.\n",
        report.jobs, all, cases_of_a_count_job, all * cases_of_a_count_job);
  }
  for (const std::string& line : report.ours_wrong()) text += "Wrong: " + line + '\n';
  return text;
}

std::string cases_text(const CheckReport& report, std::size_t page_width) {
  std::string text;
  if (!report.request->narrow.empty()) {
    text = summary_table(GroupedCounts(report)).text(page_width) + '\n' + std::string(summary_key) +
           '\n';
  }
  if (report.request->regime_jobs() > 0 || !report.broad.empty()) text += checked_text(report);
  text += family_summary(report, page_width);
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

}  // namespace

std::vector<std::string> CheckReport::ours_wrong() const {
  std::vector<std::string> lines;
  switch (request->mode) {
    case CheckMode::cases: lines = wrong_cases(*this); break;
    case CheckMode::axes: lines = broken_promises(*request, tally.axis_counts()); break;
    case CheckMode::count: lines = wrong_counts(*this); break;
  }
  for (const auto& [count, command] : family_failures) {
    const kinds::Contestant& contestant = request->contestants[count.contestant];
    if (!contestant.promised) continue;
    lines.push_back(fmt::format(
        "{} on {}, {}: of {} cases {} missed, {} false, {} inexact, {} failed; first case {}: {}",
        contestant.name(), request->families[count.family]->name, to_string(count.form),
        count.cases, count.missed, count.false_hits, count.inexact, count.failed, count.first_wrong,
        command));
  }
  for (const BroadCheck& check : broad) {
    if (check.good() || check.entry->info.origin != Origin::ours) continue;
    lines.push_back(fmt::format("{} on boxes '{}', seed {}: {}", check.entry->info.name,
                                check.scene->name, request->seed, check.faults()));
  }
  return lines;
}

std::string summary_text(const CheckReport& report, std::size_t page_width) {
  if (report.request->mode == CheckMode::cases) return cases_text(report, page_width);
  std::string text = report.request->mode == CheckMode::axes ? axes_text(report, page_width)
                                                             : counts_text(report, page_width);
  if (!report.request->broad.empty()) {
    text += fmt::format(
        "\nNot asked: {} of the kind box, whose scenes have no axes and are not counted; "
        "`touchstone "
        "check --kind box` checks them.\n",
        report.request->broad.size());
  }
  return text;
}

void write_summary(const CheckReport& report, const std::filesystem::path& file) {
  std::vector<SummaryRow> rows;
  for (const auto& [key, answers] : report.tally.answers()) {
    const auto flips = report.tally.flips().find(key);
    rows.push_back(
        {key, answers, flips == report.tally.flips().end() ? FlipCount() : flips->second});
  }
  record::write_rows(file, rows, report.request->subjects());
}

}  // namespace touchstone::check
