// Selects the worst cases of a sweep and runs them again.
#include "harness/check/axes/worst_cases.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "harness/grade/true_case.h"
#include "harness/process/queries/limited_query.h"

namespace touchstone::check {
namespace {

constexpr std::size_t axes_of_a_peer = 3;
constexpr double most_vertices = 100;  // limit of a readable case

struct Found {
  const StressRow* row;
  std::int64_t index;
};

bool is_readable(const StressRequest& request, const StressRow& row) {
  const StressCell& cell = request.cells[row.cell];
  return cell.axis->name != "vertices" || cell.value().value <= most_vertices;
}

void find_of_ours(const StressRequest& request, std::span<const StressRow> rows,
                  std::vector<Found>& found) {
  std::map<std::tuple<std::uint32_t, Task, const StressAxis*>, bool> known;
  for (const StressRow& row : rows) {
    if (request.narrow[row.entry]->info.origin != Origin::ours) continue;
    if (row.scalar != Precision::float64 || !is_readable(request, row)) continue;
    if (row.worst < 0 && row.lost < 0) continue;
    if (!std::exchange(known[{row.entry, row.task, request.cells[row.cell].axis}], true)) {
      found.push_back({&row, row.lost < 0 ? row.worst : row.lost});
    }
  }
}

void find_of_peers(const StressRequest& request, std::span<const StressRow> rows,
                   std::vector<Found>& found) {
  std::map<std::pair<std::uint32_t, Precision>, std::vector<const StressRow*>> silent, lost;
  for (const StressRow& row : rows) {
    if (request.narrow[row.entry]->info.origin == Origin::ours) continue;
    if (!is_readable(request, row)) continue;
    if (row.worst >= 0) silent[{row.entry, row.scalar}].push_back(&row);
    if (row.lost >= 0) lost[{row.entry, row.scalar}].push_back(&row);
  }
  for (auto& [subject, list] : silent) {
    std::ranges::stable_sort(list, [](const StressRow* x, const StressRow* y) {
      return badness(x->margin, x->error) > badness(y->margin, y->error);
    });
    std::vector<const StressAxis*> taken;
    for (const StressRow* row : list) {
      const StressAxis* const axis = request.cells[row->cell].axis;
      if (taken.size() == axes_of_a_peer) break;
      if (std::ranges::find(taken, axis) != taken.end()) continue;
      taken.push_back(axis);
      found.push_back({row, row->worst});
    }
  }
  for (const auto& [subject, list] : lost) found.push_back({list.front(), list.front()->lost});
}

}  // namespace

std::vector<grade::GradedAnswer> worst_cases(const StressRequest& request,
                                             std::span<const StressRow> rows) {
  std::vector<Found> found;
  find_of_ours(request, rows, found);
  find_of_peers(request, rows, found);
  std::ranges::stable_sort(found, {}, [](const Found& f) {
    return std::tuple(f.row->entry, f.row->scalar, f.row->task);
  });
  oracle::Oracle oracle;
  std::vector<grade::GradedAnswer> answers;
  for (const auto& [row, place] : found) {
    const auto index = static_cast<std::uint64_t>(place);
    grade::TrueCase c(make(request.cells[row->cell].regime, request.seed, index), index, oracle);
    const std::vector<Outcome> outcomes = process::ask_limited(
        *request.narrow[row->entry], {.scalar = row->scalar}, {{&c.pair(), row->task}},
        {.seconds = request.time_limit, .lost = most_lost});
    const grade::Query query = {row->cell, row->entry, row->scalar, row->task};
    answers.push_back(grade::grade_answer(*request.narrow[row->entry],
                                          request.cells[row->cell].regime.extreme, query, c,
                                          outcomes.front()));
  }
  return answers;
}

}  // namespace touchstone::check
