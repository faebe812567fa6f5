// Reports axes of pairs: the first failures along each, as tables and cases to replay.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "harness/base/table.h"
#include "harness/kinds/pair/pair_checkers.h"

namespace touchstone::kinds {
namespace {

constexpr std::size_t axes_of_a_peer = 3;
constexpr double most_vertices = 100;  // limit of a readable case

grade::Query query_of_row(const AxisCount& row) {
  return {row.regime, row.entry, row.scalar, row.task};
}

bool is_readable(const PairRequest& request, const AxisCount& row) {
  const Regime& regime = *request.regimes[row.regime];
  return regime.axis->name != "vertices" || regime.parameter <= most_vertices;
}

void find_of_ours(const PairRequest& request, const std::vector<AxisCount>& rows,
                  std::vector<WrongQuery>& found) {
  std::map<std::tuple<std::uint32_t, Task, const Axis*>, bool> known;
  for (const AxisCount& row : rows) {
    if (!request.is_ours(row.entry)) continue;
    if (row.scalar != Precision::float64 || !is_readable(request, row)) continue;
    if (row.worst < 0 && row.lost < 0) continue;
    if (!std::exchange(known[{row.entry, row.task, request.regimes[row.regime]->axis}], true)) {
      found.push_back({query_of_row(row), row.lost < 0 ? row.worst : row.lost});
    }
  }
}

void find_of_peers(const PairRequest& request, const std::vector<AxisCount>& rows,
                   std::vector<WrongQuery>& found) {
  std::map<std::pair<std::uint32_t, Precision>, std::vector<const AxisCount*>> silent, lost;
  for (const AxisCount& row : rows) {
    if (request.is_ours(row.entry)) continue;
    if (!is_readable(request, row)) continue;
    if (row.worst >= 0) silent[{row.entry, row.scalar}].push_back(&row);
    if (row.lost >= 0) lost[{row.entry, row.scalar}].push_back(&row);
  }
  for (auto& [subject, list] : silent) {
    std::ranges::stable_sort(list, [](const AxisCount* x, const AxisCount* y) {
      return badness(x->margin, x->error) > badness(y->margin, y->error);
    });
    std::vector<const Axis*> taken;
    for (const AxisCount* row : list) {
      const Axis* const axis = request.regimes[row->regime]->axis;
      if (taken.size() == axes_of_a_peer) break;
      if (std::ranges::find(taken, axis) != taken.end()) continue;
      taken.push_back(axis);
      found.push_back({query_of_row(*row), row->worst});
    }
  }
  for (const auto& [subject, list] : lost) {
    found.push_back({query_of_row(*list.front()), list.front()->lost});
  }
}

std::vector<WrongQuery> wrong_on_axes(const PairRequest& request,
                                      const std::vector<AxisCount>& rows) {
  std::vector<WrongQuery> found;
  find_of_ours(request, rows, found);
  find_of_peers(request, rows, found);
  std::ranges::stable_sort(found, {}, [](const WrongQuery& one) {
    return std::tuple(one.query.entry, one.query.scalar, one.query.task);
  });
  return found;
}

}  // namespace

// Of ours in double one case of each axis on which a task is silently wrong or lost, at the first such value; of a
// peer in a scalar the worst silent errors of three axes, and one query that it crashes or hangs in.
void AxisChecker::finish() {
  failures_ = write_failures(request_, ask_again(request_, wrong_on_axes(request_, counts_)));
  write_envelope(request_, counts_, request_.out / "envelope.csv");
}

std::vector<std::string> AxisChecker::ours_wrong() const {
  std::vector<std::string> lines;
  for (const AxisCount& row : counts_) {
    if (!request_.is_ours(row.entry) || row.scalar != Precision::float64) continue;
    const Regime& regime = *request_.regimes[row.regime];
    for (const grade::AnswerClass outcome :
         {grade::AnswerClass::silent, grade::AnswerClass::crashed, grade::AnswerClass::hung}) {
      if (row.count(outcome) == 0) continue;
      lines.push_back(fmt::format("{} {}: {} of {} {} at {} {}",
                                  request_.name({row.entry, row.scalar}), to_string(row.task),
                                  row.count(outcome), row.answers(), to_string(outcome),
                                  regime.axis->name, value_of(regime).name));
    }
  }
  return lines;
}

std::string AxisChecker::text(std::size_t page_width) const {
  if (request_.regimes.empty()) return "";
  const std::vector<Reach> all = reaches();
  std::string text =
      "First value at which an answer is silently on the wrong side of contact, or crashes or "
      "hangs:\n\n";
  text += table(request_, all, EnvelopeTable::side).text(page_width);
  text += "\n... or has a wrong number; \"(input)\": only because the input was rounded:\n\n";
  text += table(request_, all, EnvelopeTable::wrong).text(page_width);
  text += "\nFirst value at which the algorithm gave up:\n\n";
  text += table(request_, all, EnvelopeTable::honest).text(page_width);
  std::int64_t skipped = 0, dropped = 0;
  for (const AxisCount& row : counts_) skipped += row.skipped;
  for (const AxisSummary& of_value : summaries_) dropped += of_value.dropped;
  if (skipped > 0) {
    text += fmt::format("\n{} queries were skipped after {} that crashed or hung at their value.\n",
                        skipped, most_lost);
  }
  if (dropped > 0) {
    text += fmt::format("{} cases could not be drawn as their value asks.\n", dropped);
  }
  return text;
}

std::string AxisChecker::page(const std::string& pictures) const {
  if (request_.regimes.empty()) return "";
  const std::vector<Reach> all = reaches();
  base::Table ranges({"axis", "from", "to", "unit", "what"});
  for (const Axis* axis : request_.axes()) {
    ranges.add(
        {axis->name, axis->values.front().name, axis->values.back().name, axis->unit, axis->what});
  }
  std::string text = ranges.markdown();
  text +=
      "\n## First value on the wrong side of contact\n\nCounted from the mild end of each axis: an "
      "answer is overlapping for bodies that are apart, or the reverse, with status `ok` or "
      "none; or the query crashes or hangs. `-`: nowhere on the axis. "
      "Empty: it takes no such pairs.\n\n";
  text += table(request_, all, EnvelopeTable::side).markdown();
  text +=
      "\n## First value that is wrong in any way\n\nThe same, or a distance, depth or separating "
      "translation off by more than 1e-9 of the size in double and 1e-4 in float, or a certified "
      "bound by more than the margins of `harness/grade/margins.h`. What an algorithm was given "
      "counts: *(input)* is where it was right about that, and only the conversion of the input to "
      "its scalar made the answer wrong.\n\n";
  text += table(request_, all, EnvelopeTable::wrong).markdown();
  text += "\n## First value at which it gave up\n\n";
  text += table(request_, all, EnvelopeTable::honest).markdown();
  if (!pictures.empty()) {
    text += fmt::format(
        "\n## Maps\n\nA row an axis, from its mild end at the left; a field is filled by the "
        "shares of "
        "its answers.\n\n![Maps of our algorithms]({0}/stress_ours.svg)\n\n![Maps of the "
        "peers]({0}/stress_peers.svg)\n",
        pictures);
  }
  return text;
}

std::string AxisChecker::page_end() const {
  base::Table lines({"algorithm", "task", "case", "what is wrong", "file"});
  for (const FailureCase& failure : failures_) {
    lines.add({request_.name({failure.answer.entry, failure.answer.scalar}),
               std::string(to_string(failure.answer.task)), failure.id,
               failure.what.empty() ? "no longer, when asked again" : failure.what,
               failure.file.filename().string()});
  }
  if (lines.is_empty()) return "";
  return "\n## Cases to replay\n\nThe worst silent errors of the peers, and what of ours is wrong "
         "in "
         "double, each shrunk as far as it still is. Files are in `failures/`; `touchstone query "
         "FILE --narrow ALGORITHM --task TASK --scalar SCALAR --out answers.csv` shows them "
         "again.\n\n" +
         lines.markdown();
}

}  // namespace touchstone::kinds
