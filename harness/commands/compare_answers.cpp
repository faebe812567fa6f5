// Words for the answers that changed from a check to another.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "harness/base/table.h"
#include "harness/check/changed_answers.h"
#include "harness/commands/commands.h"
#include "harness/commands/compare.h"

namespace touchstone::commands {
namespace {

using check::AnswerComparison;
using check::AnswerCount;
using check::VersionChange;

constexpr std::size_t most_changes = 20;

base::Table table_of(const std::vector<AnswerCount>& counts) {
  base::Table table({"library", "scalar", "A", "B", "compared", "became wrong", "lost",
                     "became right", "changed otherwise"},
                    4);
  const auto version = [](const std::string& text) { return text.empty() ? "-" : text; };
  for (const AnswerCount& one : counts) {
    table.add({one.library, std::string(to_string(one.scalar)), version(one.version_a),
               version(one.version_b), fmt::format("{}", one.compared),
               fmt::format("{}", one.wrong), fmt::format("{}", one.lost),
               fmt::format("{}", one.right), fmt::format("{}", one.other)});
  }
  return table;
}

std::string case_text(const VersionChange& one) {
  return one.index < 0 ? one.regime
                       : fmt::format("{}/{} {}-{} {}", one.regime, one.index, one.kind_a,
                                     one.kind_b, one.task);
}

std::string exact_text(const VersionChange& one) {
  if (std::isnan(one.exact_lower)) return one.exact;
  return fmt::format("{}, {:.6g} m", one.exact, (one.exact_lower + one.exact_upper) / 2);
}

// An error within `max_error` is none.
std::string answer_text(const std::string& answer, double error, double max_error) {
  return error > max_error ? fmt::format("{}, off by {:.1e}", answer, error) : answer;
}

base::Table table_of(const std::vector<const VersionChange*>& changes, double max_error) {
  base::Table table({"case", "library", "exact", "answer in A", "answer in B"}, 5);
  for (const VersionChange* one : changes) {
    table.add({case_text(*one), fmt::format("{} {}", one->library, to_string(one->scalar)),
               exact_text(*one), answer_text(one->before, one->error_before, max_error),
               answer_text(one->after, one->error_after, max_error)});
  }
  return table;
}

// Adds the changes of this kind, the greatest errors first.
void add_changes(Judgement& judged, const AnswerComparison& comparison, std::string_view became,
                 std::string_view title, double max_error, bool all) {
  std::vector<const VersionChange*> found;
  for (const VersionChange& one : comparison.changes) {
    if (one.became == became) found.push_back(&one);
  }
  if (found.empty()) return;
  std::ranges::stable_sort(found, [](const VersionChange* x, const VersionChange* y) {
    return std::max(x->error_before, x->error_after) > std::max(y->error_before, y->error_after);
  });
  const std::size_t more = all || found.size() <= most_changes ? 0 : found.size() - most_changes;
  found.resize(found.size() - more);
  judged.text += fmt::format("\n{}\n", title);
  for (const VersionChange* one : found) {
    judged.text += fmt::format("  {}, {} {}: exactly {}; {} -> {}\n", case_text(*one), one->library,
                               to_string(one->scalar), exact_text(*one),
                               answer_text(one->before, one->error_before, max_error),
                               answer_text(one->after, one->error_after, max_error));
  }
  judged.markdown += fmt::format("\n**{}**\n\n{}", title, table_of(found, max_error).markdown());
  if (more == 0) return;
  const std::string rest = fmt::format("and {} more (--all, --csv)\n", more);
  judged.text += "  " + rest;
  judged.markdown += "\n" + rest;
}

}  // namespace

Judgement compare_answers(const CompareRequest& request, double max_error) {
  const AnswerComparison comparison = check::compare_answers(request.a, request.b, max_error);
  if (!request.csv.empty()) record::write_rows(request.csv, comparison.changes);
  std::int64_t compared_answers = 0, wrong = 0, lost = 0, right = 0, other = 0;
  for (const AnswerCount& one : comparison.counts) {
    compared_answers += one.compared;
    wrong += one.wrong;
    lost += one.lost;
    right += one.right;
    other += one.other;
  }
  const std::string sum = fmt::format(
      "{} answers compared: {} became wrong, {} lost, {} became right, {} changed otherwise",
      compared_answers, wrong, lost, right, other);
  const std::string rule = fmt::format(
      "Wrong: on the other side of contact, or a number off, by more than {:g} of the "
      "size. Lost: right in A, and given up in B.",
      max_error);
  Judgement judged;
  judged.status = comparison.has_regressed() ? exit_measured_wrong : exit_done;
  const base::Table counts = table_of(comparison.counts);
  judged.text = counts.text(base::page_width());
  judged.markdown = fmt::format("### Answers: {}\n\n{}\n\n{}",
                                wrong + lost > 0 ? "FAILED" : "passed", sum, counts.markdown());
  add_changes(judged, comparison, "wrong", "Became wrong", max_error, request.all);
  add_changes(judged, comparison, "lost", "Lost", max_error, request.all);
  add_changes(judged, comparison, "right", "Became right", max_error, request.all);
  if (request.all) add_changes(judged, comparison, "other", "Changed otherwise", max_error, true);
  for (const std::string& remark : comparison.remarks) {
    judged.text += "\n" + remark;
    judged.markdown += "\n" + remark + "\n";
  }
  judged.text += fmt::format("\n{}\n{}\n", sum, rule);
  judged.markdown += fmt::format("\n{}\n", rule);
  return judged;
}

}  // namespace touchstone::commands
