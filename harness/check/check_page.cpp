// Writes the Markdown page of a check: the errors of each algorithm.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "harness/base/table.h"
#include "harness/check/check_report.h"
#include "harness/check/family_tables.h"
#include "harness/check/grouped_counts.h"
#include "harness/grade/wrong.h"
#include "harness/record/machine.h"

namespace touchstone::check {
namespace {

std::string introduction(const CheckReport& report, const std::string& command) {
  const CheckRequest& request = *report.request;
  std::string text = "# Who is wrong where\n\n";
  text += fmt::format(
      "Made by `{}` (seed {}, {} cases of each of {} regimes in a round). Every answer is graded "
      "against exact arithmetic. Lengths are parts of the pair's size, or of its distance where "
      "that is greater; each number is the greatest that was seen.\n\n",
      command, request.seed, request.cases, request.regimes.size());
  return text + record::facts_as_list({"compiler", "bullet", "fcl", "libccd", "ode", "mujoco",
                                       "embree", "cgal", "boost_geometry", "commit"});
}

std::string sides_of_contact(const GroupedCounts& grouped) {
  std::string text =
      "\n## Side of contact\n\nA silent error is an answer on the wrong side of contact with "
      "status `ok` "
      "or none. *Given* is against the exact answer for the bits that the "
      "algorithm was given, after conversion to float or to a quaternion; *end to end* is "
      "against the pair as the case has it. *Margin* is the greatest exact distance or depth "
      "of a silent error. *Within resolution* are answers `touching` with bounds "
      "on "
      "the signed distance: they are right if the bounds hold, and take no side; *width* is the "
      "greatest distance of the bounds. *Gave up*: the status says that the answer is not to be "
      "trusted, or there is no answer; *up to* is the greatest exact distance or depth there. "
      "Pairs that touch exactly are not scored otherwise: the column "
      "says how many of them were called contact.\n\n";
  base::Table table({"algorithm", "answers", "silent, given", "margin", "silent, end to end",
                     "margin", "within resolution", "width", "gave up", "up to", "no status",
                     "crashed", "hung", "touching: contact"});
  for (const auto& [label, totals] : grouped.totals()) {
    const grade::AnswerCount& a = totals.answers;
    table.add({grouped.name(label), count(a.answers), count(a.silent), digits(a.margin),
               count(a.silent_end), digits(a.margin_end), count(a.within_resolution),
               digits(a.resolution), count(a.honest), digits(a.honest_margin),
               count(a.not_reported), count(a.crashed), count(a.timed_out),
               fmt::format("{} of {}", a.touching_contact, a.touching)});
  }
  return text + table.markdown();
}

std::string lengths(const CheckReport& report, const GroupedCounts& grouped) {
  std::string text =
      "\n## Distances and depths\n\n*Stuck*: by how far the reported translation does not "
      "separate the bodies; *excess*: by how far the reported direction needs more than the "
      "least translation. *Off body*: how far a witness point is from its body. *Bounds*: how "
      "many certified bounds miss the exact value. A depth marked `<=` is labelled as an upper "
      "bound.\n\n";
  base::Table table({"algorithm", "distance", "end to end", "too deep", "too shallow", "end to end",
                     "stuck", "excess", "off body", "bounds", "NaN"});
  for (const auto& [label, totals] : grouped.totals()) {
    const grade::AnswerCount& a = totals.answers;
    const bool is_bound = report.request->narrow[label.entry]->traits.depth_is_bound;
    table.add({grouped.name(label), digits(a.distance), digits(a.distance_end),
               (is_bound ? "<= " : "") + digits(a.too_deep), digits(a.too_shallow),
               digits(a.depth_end), digits(a.does_not_separate), digits(a.excess),
               digits(a.witness), count(a.bounds), count(a.not_a_number)});
  }
  return text + table.markdown();
}

std::vector<std::string> group_header(const GroupedCounts& grouped) {
  std::vector<std::string> header = {"algorithm"};
  header.insert(header.end(), grouped.groups().begin(), grouped.groups().end());
  return header;
}

std::string silent_errors_by_group(const GroupedCounts& grouped) {
  std::string text =
      "\n## Silent errors by group of regimes\n\nHow many answers were silent errors against "
      "what was given, and the margin.\n\n";
  base::Table table(group_header(grouped));
  for (const auto& [label, totals] : grouped.totals()) {
    std::vector<std::string> row = {grouped.name(label)};
    for (const std::string& group : grouped.groups()) {
      const grade::AnswerCount* a = grouped.of(label, group);
      row.push_back(a == nullptr     ? ""
                    : a->silent == 0 ? "0"
                                     : fmt::format("{} ({})", a->silent, digits(a->margin)));
    }
    table.add(std::move(row));
  }
  return text + table.markdown();
}

std::string depths_by_group(const GroupedCounts& grouped) {
  std::string text =
      "\n## Worst depth by group of regimes\n\nThe greater of too deep and too shallow, "
      "against what was given; distances where the algorithm has no depth.\n\n";
  base::Table table(group_header(grouped));
  for (const auto& [label, totals] : grouped.totals()) {
    std::vector<std::string> row = {grouped.name(label)};
    for (const std::string& group : grouped.groups()) {
      const grade::AnswerCount* a = grouped.of(label, group);
      double worst = grade::Grade::none;
      if (a != nullptr) worst = std::fmax(a->too_deep, a->too_shallow);
      if (a != nullptr && std::isnan(worst)) worst = a->distance;
      row.push_back(a == nullptr ? "" : digits(worst));
    }
    table.add(std::move(row));
  }
  return text + table.markdown();
}

std::string other_forms(const GroupedCounts& grouped) {
  std::string text =
      "\n## The same pair in another form\n\nSwapped, moved and scaled exactly, or with its "
      "vertices in another order, a pair has the same answer.\n\n";
  base::Table table(
      {"algorithm", "compared", "other side of contact", "margin", "worst difference"});
  for (const auto& [label, totals] : grouped.totals()) {
    const FlipCount& f = totals.flips;
    table.add({grouped.name(label), count(f.compared), count(f.flips), digits(f.worst_flip),
               digits(f.worst_difference)});
  }
  return text + table.markdown();
}

std::string broad_phases(const CheckReport& report) {
  if (report.broad.empty()) return "";
  std::string text =
      "\n## Broad phases\n\nAgainst every pair of closed boxes, on scenes that touch, "
      "coincide, have no volume, or are huge, tiny or far away.\n\n";
  base::Table table({"algorithm", "scenes", "wrong", "first fault"}, 4);
  for (const BroadPhaseEntry* entry : report.request->broad) {
    int scenes = 0, wrong = 0;
    std::string first;
    for (const BroadCheck& check : report.broad) {
      if (check.entry != entry) continue;
      ++scenes;
      if (check.good()) continue;
      if (wrong++ == 0) {
        const std::string faults = check.faults();
        first = fmt::format("{}: {}", check.scene->name, faults.substr(0, faults.find(';')));
      }
    }
    table.add({entry->info.name, count(scenes), count(wrong), first});
  }
  return text + table.markdown();
}

std::string one_failure_of_each(const CheckReport& report, const GroupedCounts& grouped) {
  std::string text =
      "\n## One failure of each\n\nThe worst of each algorithm. The case files are what "
      "`check` leaves in its folder; `touchstone query` shows each again.\n\n";
  std::map<CheckedAlgorithm, const FailureCase*> worst;
  for (const FailureCase& failure : report.failures) {
    const FailureCase*& slot = worst[{failure.answer.entry, failure.answer.scalar}];
    if (slot == nullptr || badness(failure.answer) > badness(slot->answer)) slot = &failure;
  }
  base::Table table({"algorithm", "task", "case", "what"}, 4);
  for (const auto& [label, failure] : worst) {
    table.add({grouped.name(label), std::string(to_string(failure->answer.task)), failure->id,
               failure->what});
  }
  if (worst.empty()) return text + "None.\n";
  return text + table.markdown();
}

}  // namespace

std::string page_text(const CheckReport& report, const std::string& command,
                      const std::string& pictures) {
  if (report.request->mode == CheckMode::axes) return axes_page(report, command, pictures);
  const GroupedCounts grouped(report);
  return introduction(report, command) + sides_of_contact(grouped) + lengths(report, grouped) +
         silent_errors_by_group(grouped) + depths_by_group(grouped) + other_forms(grouped) +
         broad_phases(report) + family_sections(report) + "\n## What was checked beside them\n\n" +
         checked_text(report) + one_failure_of_each(report, grouped);
}

}  // namespace touchstone::check
