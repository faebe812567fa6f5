// Formats what was found along axes as tables for the terminal and for a page.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "harness/base/table.h"
#include "harness/check/check_report.h"
#include "harness/check/check_rows.h"
#include "harness/check/envelope.h"
#include "harness/check/family_tables.h"
#include "harness/record/machine.h"

namespace touchstone::check {
namespace {

constexpr std::size_t most_lines = 40;  // number of failures listed

std::string promise(const CheckReport& report, std::span<const Reach> reaches) {
  const CheckRequest& request = *report.request;
  const bool asked =
      std::ranges::any_of(reaches,
                          [&](const Reach& reach) {
                            return request.narrow[reach.entry]->info.origin == Origin::ours &&
                                   reach.scalar == Precision::float64;
                          }) ||
      std::ranges::any_of(request.contestants, &kinds::Contestant::promised);
  if (!asked) return "";
  const std::vector<std::string> broken = report.ours_wrong();
  if (broken.empty()) {
    return "In double, none of our own algorithms is silently wrong, crashes or hangs.\n";
  }
  std::string text = "In double, of our own algorithms:\n\n";
  for (std::size_t i = 0; i < std::min(most_lines, broken.size()); ++i) {
    text += "- " + broken[i] + "\n";
  }
  if (broken.size() > most_lines) {
    text += fmt::format("- and {} more\n", broken.size() - most_lines);
  }
  return text;
}

std::string axis_ranges(const CheckRequest& request) {
  base::Table lines({"axis", "from", "to", "unit", "what"});
  for (const Axis* axis : axes_of(request.subjects())) {
    lines.add(
        {axis->name, axis->values.front().name, axis->values.back().name, axis->unit, axis->what});
  }
  return lines.markdown();
}

std::string failure_lines(const CheckReport& report) {
  const CheckRequest& request = *report.request;
  base::Table lines({"algorithm", "task", "case", "what is wrong", "file"});
  for (const FailureCase& failure : report.failures) {
    lines.add({request.name({failure.answer.entry, failure.answer.scalar}),
               std::string(to_string(failure.answer.task)), failure.id,
               failure.what.empty() ? "no longer, when asked again" : failure.what,
               failure.file.filename().string()});
  }
  if (lines.is_empty()) return "";
  return "## Cases to replay\n\nThe worst silent errors of the peers, and what of ours is wrong in "
         "double, each shrunk as far as it still is. Files are in `failures/`; `touchstone query "
         "FILE --narrow ALGORITHM --task TASK --scalar SCALAR --out answers.csv` shows them "
         "again.\n\n" +
         lines.markdown();
}

}  // namespace

std::string axes_text(const CheckReport& report, std::size_t page_width) {
  const CheckRequest& request = *report.request;
  const std::vector<Reach> reaches = envelope(request, report.tally.axis_counts());
  std::string text;
  if (!request.contestants.empty()) {
    text =
        "Of bodies that are not convex, rays, points and motion, the first value with an answer "
        "that is missed, false or inexact, or with a query that failed; after a slash the first "
        "that was given up:\n" +
        axis_tables(report, page_width) + "\n";
  }
  if (request.regime_jobs() == 0) return text + promise(report, reaches);
  text +=
      "First value at which an answer is silently on the wrong side of contact, or crashes or "
      "hangs:\n\n";
  text += table(request, reaches, EnvelopeTable::side).text(page_width);
  text += "\n... or has a wrong number; \"(input)\": only because the input was rounded:\n\n";
  text += table(request, reaches, EnvelopeTable::wrong).text(page_width);
  text += "\nFirst value at which the algorithm gave up:\n\n";
  text += table(request, reaches, EnvelopeTable::honest).text(page_width);
  std::int64_t skipped = 0, dropped = 0;
  for (const AxisCount& row : report.tally.axis_counts()) skipped += row.skipped;
  for (const AxisSummary& of_value : report.tally.axis_summaries()) dropped += of_value.dropped;
  if (skipped > 0) {
    text += fmt::format("\n{} queries were skipped after {} that crashed or hung at their value.\n",
                        skipped, most_lost);
  }
  if (dropped > 0) {
    text += fmt::format("{} cases could not be drawn as their value asks.\n", dropped);
  }
  return text + "\n" + promise(report, reaches);
}

std::string axes_page(const CheckReport& report, const std::string& command,
                      const std::string& pictures) {
  const CheckRequest& request = *report.request;
  const std::vector<Reach> reaches = envelope(request, report.tally.axis_counts());
  std::string text = fmt::format(
      "# Where each algorithm breaks\n\nMade by `{}` (seed {}, {} cases of each value, fewer of "
      "large hulls; {} s of the processor a query). Along each axis one property of a pair grows "
      "to "
      "its extreme while all else stays mild; every answer is held against exact "
      "arithmetic.\n\n{}\n",
      command, request.seed, request.cases, request.time_limit,
      record::facts_as_list({"compiler", "bullet", "fcl", "libccd", "ode", "commit"}));
  text += axis_ranges(request) + "\n" + promise(report, reaches) + "\n";
  text += axis_sections(report);
  text +=
      "## First value on the wrong side of contact\n\nCounted from the mild end of each axis: an "
      "answer is overlapping for bodies that are apart, or the reverse, with status `ok` or "
      "none; or the query crashes or hangs. `-`: nowhere on the axis. "
      "Empty: it takes no such pairs.\n\n";
  text += table(request, reaches, EnvelopeTable::side).markdown();
  text +=
      "\n## First value that is wrong in any way\n\nThe same, or a distance, depth or separating "
      "translation off by more than 1e-9 of the size in double and 1e-4 in float, or a certified "
      "bound by more than the margins of `harness/grade/margins.h`. What an algorithm was given "
      "counts: *(input)* is where it was right about that, and only the conversion of the input to "
      "its scalar made the answer wrong.\n\n";
  text += table(request, reaches, EnvelopeTable::wrong).markdown();
  text += "\n## First value at which it gave up\n\n";
  text += table(request, reaches, EnvelopeTable::honest).markdown();
  if (!pictures.empty()) {
    text += fmt::format(
        "\n## Maps\n\nA row an axis, from its mild end at the left; a field is filled by the "
        "shares of "
        "its answers.\n\n![Maps of our algorithms]({0}/stress_ours.svg)\n\n![Maps of the "
        "peers]({0}/stress_peers.svg)\n",
        pictures);
  }
  const std::string failures = failure_lines(report);
  return failures.empty() ? text : text + "\n" + failures;
}

}  // namespace touchstone::check
