// Draws the cases of a cell, runs every algorithm on them, and counts its answers.
#include "harness/check/axes/stress_cell.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "harness/check/families/family_job.h"
#include "harness/grade/answer_count.h"
#include "harness/grade/pair_size.h"
#include "harness/process/queries/limited_query.h"

namespace touchstone::check {
namespace {

class CellWork {
 public:
  CellWork(const StressRequest& request, std::size_t cell, oracle::Oracle& oracle)
      : request_(request), cell_(cell) {
    result_.summary.cell = static_cast<std::uint32_t>(cell);
    cases_ = true_cases(request, cell, oracle, result_.summary);
  }

  CellResult run() {
    for (const auto& [entry, scalar] : request_.algorithms()) {
      for (const Task task : all_tasks) ask(entry, scalar, task);
    }
    return std::move(result_);
  }

 private:
  void ask(std::uint32_t entry, Precision scalar, Task task) {
    const NarrowPhaseEntry& algorithm = *request_.narrow[entry];
    std::vector<process::LimitedQuery> queries;
    std::vector<grade::TrueCase*> of;  // one for each query
    for (grade::TrueCase& c : cases_) {
      const files::Case& pair = c.pair();
      if (!offers(algorithm, pair.shape_a.kind, pair.shape_b.kind, task)) continue;
      queries.push_back({&pair, task});
      of.push_back(&c);
    }
    if (queries.empty()) return;
    StressRow row;
    row.cell = static_cast<std::uint32_t>(cell_);
    row.entry = entry;
    row.scalar = scalar;
    row.task = task;
    const process::QueryLimits limits = {.seconds = request_.time_limit, .lost = most_lost};
    const std::vector<Outcome> outcomes =
        process::ask_limited(algorithm, {.scalar = scalar}, queries, limits);
    double worst = -1;  // badness
    for (std::size_t i = 0; i < queries.size(); ++i) {
      if (process::is_not_asked(outcomes[i])) {
        ++row.skipped;
      } else {
        count(row, *of[i], outcomes[i], worst);
      }
    }
    result_.rows.push_back(row);
  }

  void count(StressRow& row, grade::TrueCase& c, const Outcome& outcome, double& worst) {
    const NarrowPhaseEntry& algorithm = *request_.narrow[row.entry];
    const grade::Query query = {static_cast<std::uint32_t>(cell_), row.entry, row.scalar, row.task};
    const bool extreme = request_.cells[cell_].regime.extreme;
    const grade::GradedAnswer answer = grade::grade_answer(algorithm, extreme, query, c, outcome);
    const grade::AnswerClass became = grade::class_of(algorithm, answer, extreme);
    row.add(became);
    grade::keep_greater(row.margin, grade::wrong_margin(algorithm, answer));
    grade::keep_greater(row.error, worst_error(algorithm, answer));
    const auto index = static_cast<std::int64_t>(c.index());
    if (became == grade::AnswerClass::crashed || became == grade::AnswerClass::hung) {
      if (row.lost < 0) row.lost = index;
    } else if (became == grade::AnswerClass::silent) {
      const double bad =
          badness(grade::wrong_margin(algorithm, answer), worst_error(algorithm, answer));
      if (bad > worst) {
        row.worst = index;
        worst = bad;
      }
    }
  }

  const StressRequest& request_;
  std::size_t cell_;
  std::vector<grade::TrueCase> cases_;
  CellResult result_;
};

}  // namespace

std::vector<grade::TrueCase> true_cases(const StressRequest& request, std::size_t cell,
                                        oracle::Oracle& oracle, CellSummary& summary) {
  const StressCell& place = request.cells[cell];
  const auto asked = static_cast<std::uint64_t>(request.cases);
  const std::uint64_t slots = std::min(asked, place.axis->most_cases(place.value().value));
  std::vector<grade::TrueCase> cases;
  for (std::uint64_t slot = 0; slot < slots; ++slot) {
    bool found = false;
    for (std::uint64_t attempt = 0; attempt < tries && !found; ++attempt) {
      const std::uint64_t index = slot * tries + attempt;
      grade::TrueCase c(make(place.regime, request.seed, index), index, oracle);
      const oracle::Measure& exact = c.truth(Encoding::as_given).measure;
      found = place.axis->accepts == nullptr ||
              place.axis->accepts(place.value().value, exact, grade::pair_size(c.pair()));
      if (!found) continue;
      if (exact.answer == Answer::unknown) ++summary.unresolved;
      cases.push_back(std::move(c));
    }
    if (!found) ++summary.dropped;
  }
  summary.cases = static_cast<std::int32_t>(cases.size());
  return cases;
}

CellResult do_stress_job(const StressRequest& request, std::size_t job, oracle::Oracle& oracle) {
  if (job < request.cells.size()) return CellWork(request, job, oracle).run();
  CellResult result;
  const auto family = static_cast<std::uint32_t>(job - request.cells.size());
  result.families =
      count_as_drawn(request, family, 0, cases_of_round(request, *request.families[family], 0));
  return result;
}

}  // namespace touchstone::check
