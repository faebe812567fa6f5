// A row of stress.csv: counts of one algorithm's answers to one task in one cell.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <vector>

#include "harness/check/axes/stress_request.h"
#include "harness/grade/wrong.h"
#include "harness/record/row.h"

namespace touchstone::check {

struct StressRow {
  std::uint32_t cell = 0, entry = 0;  // places in the request
  Precision scalar{};
  Task task{};
  std::array<std::int32_t, grade::all_answer_classes.size()> counts{};
  std::int32_t skipped = 0;       // queries left out after too many crashes and hangs
  double margin = Outcome::none;  // greatest of the cell: see wrong_margin and worst_error
  double error = Outcome::none;
  // Indices of cases, or -1: the worst silent error, and the first query that crashed or hung.
  std::int64_t worst = -1;
  std::int64_t lost = -1;

  std::int32_t count(grade::AnswerClass outcome) const {
    return counts[static_cast<std::size_t>(outcome)];
  }
  // Returns the number of graded answers.
  std::int32_t answers() const {
    return std::accumulate(counts.begin(), counts.end(), std::int32_t{0});
  }
  void add(grade::AnswerClass outcome) { ++counts[static_cast<std::size_t>(outcome)]; }
};

// Returns how bad a silent error is: a wrong side of contact is worse than a wrong number. An
// argument is NaN if there is no such error; if both are, the result is 0.
inline double badness(double margin, double error) {
  if (!std::isnan(margin)) return 1e3 * (1 + margin);
  return std::isnan(error) ? 0 : std::min(error, 1e3);
}

// Returns the axes of the request's cells, in order.
std::vector<const StressAxis*> axes_of(const StressRequest& request);

// Visits the columns `axis` and `value`, which identify the row's cell.
template <class Row, class Visit>
void cell_columns(Row& row, Visit& visit, const StressRequest& request) {
  const std::vector<const StressAxis*> axes = axes_of(request);
  // A sweep of families alone has no cells, and no rows.
  const StressAxis* const of_row = request.cells.empty() ? nullptr : request.cells[row.cell].axis;
  auto axis = static_cast<std::size_t>(std::ranges::find(axes, of_row) - axes.begin());
  visit("axis", record::place_in(axis, axes.size(), [&](std::size_t i) { return axes[i]->name; }),
        "The axis.");
  std::vector<std::uint32_t> cells;  // cells of the axis
  for (std::uint32_t i = 0; i < request.cells.size(); ++i) {
    if (request.cells[i].axis == axes[axis]) cells.push_back(i);
  }
  auto place = static_cast<std::size_t>(std::ranges::find(cells, row.cell) - cells.begin());
  visit("value",
        record::place_in(place, cells.size(),
                         [&](std::size_t i) { return request.cells[cells[i]].value().name; }),
        "The value on the axis.");
  if constexpr (!std::is_const_v<Row>) {
    if (!cells.empty()) row.cell = cells[place];
  }
}

template <record::row_of<StressRow> Row, class Visit>
void columns(Row& row, Visit visit, const StressRequest& request) {
  cell_columns(row, visit, request);
  visit("algorithm",
        record::place_in(row.entry, request.narrow.size(),
                         [&](std::size_t i) { return request.narrow[i]->info.name; }),
        "The narrow phase.");
  visit("scalar", row.scalar, "Precision that it computes in.");
  visit("task", row.task, "What it was asked.");
  for (const grade::AnswerClass one : grade::all_answer_classes) {
    visit(to_string(one), row.counts[static_cast<std::size_t>(one)], "Answers of this class.");
  }
  visit("skipped", row.skipped, "Queries that were not asked, after too many crashes and hangs.");
  visit("worst_margin", record::rounded(row.margin, 3),
        "Greatest exact distance or depth that was called wrongly, part of the scale.");
  visit("worst_error", record::rounded(row.error, 3),
        "Greatest error of a number, part of the scale.");
  visit("worst_index", row.worst, "Case of the silent error that is furthest off.");
  visit("lost_index", row.lost, "Case of the first query that crashed or hung.");
}

}  // namespace touchstone::check
