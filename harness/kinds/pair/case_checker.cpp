// Counts the graded cases of pairs, and reports them at the terminal and on a page.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "harness/base/table.h"
#include "harness/grade/wrong.h"
#include "harness/kinds/pair/pair_checkers.h"

namespace touchstone::kinds {
namespace {

// Counts by algorithm, scalar and group of regimes, for all tables.
class GroupedCounts {
 public:
  explicit GroupedCounts(const CaseChecker& checker) : request_(checker.subjects()) {
    for (const auto& [key, counted] : checker.answers()) {
      const std::string& group = request_.regimes[key.regime]->group;
      totals_[{key.entry, key.scalar}].answers.add(counted);
      by_group_[{{key.entry, key.scalar}, group}].add(counted);
    }
    for (const auto& [key, counted] : checker.flips()) {
      totals_[{key.entry, key.scalar}].flips.add(counted);
    }
    for (const Regime* regime : request_.regimes) {
      if (std::ranges::find(groups_, regime->group) == groups_.end()) {
        groups_.push_back(regime->group);
      }
    }
  }

  struct Totals {
    grade::AnswerCount answers;
    FlipCount flips;
  };
  const std::map<CheckedAlgorithm, Totals>& totals() const { return totals_; }

  // A table with a row for each algorithm: its name, then what `cells` gives for its totals.
  template <class Cells>
  base::Table table(std::vector<std::string> header, const Cells& cells) const {
    base::Table table(std::move(header));
    for (const auto& [label, totals] : totals_) {
      std::vector<std::string> row = {request_.name(label)};
      for (std::string& cell : cells(label, totals)) row.push_back(std::move(cell));
      table.add(std::move(row));
    }
    return table;
  }
  // A table with a column for each group: `cell` gives that of an algorithm's counts, which has answers there.
  template <class Cell>
  std::string table_of_groups(const Cell& cell) const {
    std::vector<std::string> header = {"algorithm"};
    header.insert(header.end(), groups_.begin(), groups_.end());
    const auto cells = [&](const CheckedAlgorithm& label, const Totals&) {
      std::vector<std::string> row;
      for (const std::string& group : groups_) {
        const auto at = by_group_.find({label, group});
        row.push_back(at == by_group_.end() ? "" : cell(at->second));
      }
      return row;
    };
    return table(std::move(header), cells).markdown();
  }

 private:
  const PairRequest& request_;
  std::map<CheckedAlgorithm, Totals> totals_;
  std::map<std::pair<CheckedAlgorithm, std::string>, grade::AnswerCount> by_group_;
  std::vector<std::string> groups_;
};

using Cells = std::vector<std::string>;

std::string count(std::int64_t n) { return std::to_string(n); }

// Returns the first digit and the exponent of an error, or "-" for NaN.
std::string digits(double x) {
  if (std::isnan(x)) return "-";
  return x == 0 ? "0" : fmt::format("{:.0e}", x);
}

base::Table summary_table(const PairRequest& request, const GroupedCounts& grouped) {
  return grouped.table(
      {"", "answers", "silent", "margin", "touching", "width", "gave up", "no status", "failed",
       "gap", "deep", "shallow", "stuck", "bounds", "flips", "beyond"},
      [&](const CheckedAlgorithm& label, const GroupedCounts::Totals& totals) -> Cells {
        const grade::AnswerCount& a = totals.answers;
        return {count(a.answers),
                count(a.silent),
                digits(a.margin),
                count(a.within_resolution),
                digits(a.resolution),
                count(a.honest),
                count(a.not_reported),
                count(a.crashed + a.timed_out),
                digits(a.distance),
                digits(a.too_deep),
                digits(a.too_shallow),
                digits(a.does_not_separate),
                count(a.bounds),
                count(totals.flips.flips),
                request.is_ours(label.entry) ? count(a.beyond + totals.flips.beyond) : "-"};
      });
}

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

// The contestants of a file of cases, by their scores.
base::Table score_table(const PairRequest& request, const std::map<RegimeKey, GradeCount>& grades) {
  std::vector<std::pair<RegimeKey, GradeCount>> sorted(grades.begin(), grades.end());
  std::ranges::stable_sort(sorted, std::greater(),
                           [](const auto& one) { return one.second.score(); });
  base::Table table({"", "answers", "right", "no fault", "gave up", "failed", "wrong", "score"});
  for (const auto& [key, grade] : sorted) {
    table.add({request.name({key.entry, key.scalar}), count(grade.cases), count(grade.right),
               count(grade.near + grade.bound), count(grade.gave_up), count(grade.failed),
               count(grade.silent()), count(grade.score())});
  }
  return table;
}

constexpr std::string_view score_key =
    "score: 1 for each right answer, -16 for each wrong one (missed, false or inexact), 0 for all\n"
    "else; no fault: near, or a bound by design. After a hundred crashes and hangs a contestant "
    "is\n"
    "asked no more.\n";

// The checks of cases, certificates and boxes.
std::string checked_text(const std::vector<JobSummary>& jobs) {
  JobSummary all;
  for (const JobSummary& job : jobs) all.add(job);
  return fmt::format(
      "{} cases, {} of them undecided by the oracle's enclosure; {} exact answers proven by a "
      "certificate, {} refused.\n{} boxes of bodies hold all of their body, {} do not.\n",
      all.cases, all.unresolved, all.proven, all.refused, all.boxes - all.boxes_broken,
      all.boxes_broken);
}

std::string sides_of_contact(const GroupedCounts& grouped) {
  return "\n## Side of contact\n\nA silent error is an answer on the wrong side of contact with "
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
         "says how many of them were called contact.\n\n" +
         grouped
             .table({"algorithm", "answers", "silent, given", "margin", "silent, end to end",
                     "margin", "within resolution", "width", "gave up", "up to", "no status",
                     "crashed", "hung", "touching: contact"},
                    [](const CheckedAlgorithm&, const GroupedCounts::Totals& totals) -> Cells {
                      const grade::AnswerCount& a = totals.answers;
                      return {count(a.answers),
                              count(a.silent),
                              digits(a.margin),
                              count(a.silent_end),
                              digits(a.margin_end),
                              count(a.within_resolution),
                              digits(a.resolution),
                              count(a.honest),
                              digits(a.honest_margin),
                              count(a.not_reported),
                              count(a.crashed),
                              count(a.timed_out),
                              fmt::format("{} of {}", a.touching_contact, a.touching)};
                    })
             .markdown();
}

std::string lengths(const PairRequest& request, const GroupedCounts& grouped) {
  return "\n## Distances and depths\n\n*Stuck*: by how far the reported translation does not "
         "separate the bodies; *excess*: by how far the reported direction needs more than the "
         "least translation. *Off body*: how far a witness point is from its body. *Bounds*: how "
         "many certified bounds miss the exact value. A depth marked `<=` is labelled as an upper "
         "bound.\n\n" +
         grouped
             .table(
                 {"algorithm", "distance", "end to end", "too deep", "too shallow", "end to end",
                  "stuck", "excess", "off body", "bounds", "NaN"},
                 [&](const CheckedAlgorithm& label, const GroupedCounts::Totals& totals) -> Cells {
                   const grade::AnswerCount& a = totals.answers;
                   const bool is_bound = request.narrow[label.entry]->traits.depth_is_bound;
                   return {digits(a.distance),
                           digits(a.distance_end),
                           (is_bound ? "<= " : "") + digits(a.too_deep),
                           digits(a.too_shallow),
                           digits(a.depth_end),
                           digits(a.does_not_separate),
                           digits(a.excess),
                           digits(a.witness),
                           count(a.bounds),
                           count(a.not_a_number)};
                 })
             .markdown();
}

std::string silent_errors_by_group(const GroupedCounts& grouped) {
  return "\n## Silent errors by group of regimes\n\nHow many answers were silent errors against "
         "what was given, and the margin.\n\n" +
         grouped.table_of_groups([](const grade::AnswerCount& a) {
           return a.silent == 0 ? "0" : fmt::format("{} ({})", a.silent, digits(a.margin));
         });
}

std::string depths_by_group(const GroupedCounts& grouped) {
  return "\n## Worst depth by group of regimes\n\nThe greater of too deep and too shallow, "
         "against what was given; distances where the algorithm has no depth.\n\n" +
         grouped.table_of_groups([](const grade::AnswerCount& a) {
           const double worst = std::fmax(a.too_deep, a.too_shallow);
           return digits(std::isnan(worst) ? a.distance : worst);
         });
}

std::string other_forms(const GroupedCounts& grouped) {
  return "\n## The same pair in another form\n\nSwapped, moved and scaled exactly, or with its "
         "vertices in another order, a pair has the same answer.\n\n" +
         grouped
             .table(
                 {"algorithm", "compared", "other side of contact", "margin", "worst difference"},
                 [](const CheckedAlgorithm&, const GroupedCounts::Totals& totals) -> Cells {
                   const FlipCount& f = totals.flips;
                   return {count(f.compared), count(f.flips), digits(f.worst_flip),
                           digits(f.worst_difference)};
                 })
             .markdown();
}

}  // namespace

void CaseChecker::add(const grade::GradedAnswer& answer) {
  const RegimeKey key = {answer.entry, answer.scalar, answer.regime};
  answers_[key].add(answer);
  grades_[key].add(request_.graded(answer), static_cast<std::int64_t>(answer.index));
  // Answers of ours beyond the margins come before all that are within them.
  const double bad = answer.beyond ? 1e10 + badness(answer) : badness(answer);
  if (bad == 0) return;
  std::vector<Worst>& worst = worst_[key];
  const auto at = std::ranges::find_if(worst, [&](const Worst& one) { return one.badness < bad; });
  worst.insert(at, {bad, answer});
  constexpr std::size_t kept = 3;
  if (worst.size() > kept) worst.pop_back();
}

void CaseChecker::add(const VariantCount& count) {
  flips_[{count.entry, count.scalar, count.regime}].add(count);
  if (count.beyond > 0) variants_beyond_.push_back(count);
}

std::vector<grade::GradedAnswer> CaseChecker::failing_answers() const {
  std::vector<grade::GradedAnswer> all;
  for (const auto& [key, worst] : worst_) {
    const bool ours = request_.is_ours(key.entry);
    for (const Worst& one : worst) {
      // An answer of ours within the margins is no failure; of other algorithms one failure is
      // enough.
      if (ours && !one.answer.beyond) continue;
      all.push_back(one.answer);
      if (!ours) break;
    }
  }
  return all;
}

void CaseChecker::finish() {
  failures_ = write_failures(request_, failing_answers());
  variant_failures_ = write_variant_failures(request_, variants_beyond_);
  truth_failures_ = write_truth_failures(request_, jobs_);
  std::vector<SummaryRow> rows;
  for (const auto& [key, answers] : answers_) {
    const auto flips = flips_.find(key);
    rows.push_back(
        {key, answers, flips == flips_.end() ? FlipCount() : flips->second, grades_.at(key)});
  }
  record::write_rows(request_.out / "summary.csv", rows, request_);
}

std::vector<std::string> CaseChecker::ours_wrong() const {
  std::vector<std::string> lines;
  for (const FailureCase& failure : failures_) {
    if (!failure.answer.beyond) continue;
    lines.push_back(fmt::format("{} {} {} on {}: {}",
                                request_.narrow[failure.answer.entry]->info.name,
                                to_string(failure.answer.scalar), to_string(failure.answer.task),
                                failure.id, failure.what));
  }
  for (const VariantFailure& failure : variant_failures_) {
    const VariantCount& count = failure.count;
    lines.push_back(fmt::format(
        "{} {} {} on {} and its variant '{}': {} answers in another form differ, by {:.0e} of the "
        "size",
        request_.narrow[count.entry]->info.name, to_string(count.scalar), to_string(count.task),
        failure.id, count.kind, count.beyond, std::max(count.worst_flip, count.worst_difference)));
  }
  for (const TruthFailure& failure : truth_failures_) {
    lines.push_back(fmt::format(
        "{}: {} certificates of the oracle refused, {} boxes that do not hold their body; first {} "
        "in {}",
        request_.regimes[failure.job.regime]->name, failure.job.refused, failure.job.boxes_broken,
        failure.id, failure.file.string()));
  }
  return lines;
}

std::vector<std::string> CaseChecker::commands() const {
  std::set<std::string> commands;
  for (const FailureCase& failure : failures_) {
    if (failure.answer.beyond) commands.insert(failure.command(request_));
  }
  for (const VariantFailure& failure : variant_failures_) {
    commands.insert(query_command(request_, failure.query, failure.file));
  }
  return {commands.begin(), commands.end()};
}

std::string CaseChecker::text(std::size_t page_width) const {
  if (request_.narrow.empty()) return "";
  std::string text = summary_table(request_, GroupedCounts(*this)).text(page_width) + '\n' +
                     std::string(summary_key) + '\n';
  if (request_.is_of_file()) {
    text += score_table(request_, grades_).text(page_width) + '\n' + std::string(score_key) + '\n';
  }
  return text + checked_text(jobs_);
}

std::string CaseChecker::page(const std::string& /*pictures*/) const {
  if (request_.narrow.empty()) return "";
  const GroupedCounts grouped(*this);
  return sides_of_contact(grouped) + lengths(request_, grouped) + silent_errors_by_group(grouped) +
         depths_by_group(grouped) + other_forms(grouped);
}

std::string CaseChecker::page_end() const {
  if (request_.narrow.empty()) return "";
  std::string text =
      "\n## What was checked beside them\n\n" + checked_text(jobs_) +
      "\n## One failure of each\n\nThe worst of each algorithm. The case files are what "
      "`check` leaves in its folder; `touchstone query` shows each again.\n\n";
  std::map<CheckedAlgorithm, const FailureCase*> worst;
  for (const FailureCase& failure : failures_) {
    const FailureCase*& slot = worst[{failure.answer.entry, failure.answer.scalar}];
    if (slot == nullptr || badness(failure.answer) > badness(slot->answer)) slot = &failure;
  }
  base::Table table({"algorithm", "task", "case", "what"}, 4);
  for (const auto& [label, failure] : worst) {
    table.add({request_.name(label), std::string(to_string(failure->answer.task)), failure->id,
               failure->what});
  }
  return text + (worst.empty() ? "None.\n" : table.markdown());
}

}  // namespace touchstone::kinds
