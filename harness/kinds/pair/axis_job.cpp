// The job of an axis' value: draws its cases, runs every algorithm on them, and counts its answers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "harness/grade/graded_answer.h"
#include "harness/grade/margins.h"
#include "harness/kinds/pair/axes/axes.h"
#include "harness/kinds/pair/pair_checkers.h"
#include "harness/process/child_process.h"
#include "harness/process/limited_query.h"

namespace touchstone::kinds {
namespace {

// The number as its row has it, so that work that was resumed has the same result as a whole one.
double as_written(double x) { return std::strtod(fmt::format("{:.2e}", x).c_str(), nullptr); }

class AxisJob {
 public:
  AxisJob(const PairRequest& request, std::uint32_t regime, oracle::Oracle& oracle)
      : request_(request), regime_(regime) {
    cases_ = axis_cases(request, regime, oracle, summary_);
  }

  AxisRows run() {
    for (const auto& [entry, scalar] : request_.algorithms) {
      for (const Task task : all_tasks) ask(entry, scalar, task);
    }
    rows_.of<AxisSummary>() = {summary_};
    return std::move(rows_);
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
    AxisCount row;
    row.regime = regime_;
    row.entry = entry;
    row.scalar = scalar;
    row.task = task;
    const process::QueryLimits limits = {.seconds = request_.time_limit, .lost = most_lost};
    const std::vector<Outcome> outcomes =
        process::ask_limited(algorithm, {.scalar = scalar}, queries, limits);
    double worst = -1;  // badness
    std::size_t lost = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      lost += process::is_lost(outcomes[i].status) ? 1 : 0;
      if (!process::is_not_asked(outcomes[i])) {
        add_to(row, *of[i], outcomes[i], worst);
      } else if (lost >= most_lost) {  // otherwise a peer refused it
        ++row.skipped;
      }
    }
    if (row.answers() == 0) return;
    row.margin = as_written(row.margin);
    row.error = as_written(row.error);
    rows_.of<AxisCount>().push_back(row);
  }

  void add_to(AxisCount& row, grade::TrueCase& c, const Outcome& outcome, double& worst) {
    const NarrowPhaseEntry& algorithm = *request_.narrow[row.entry];
    const grade::Query query = {regime_, row.entry, row.scalar, row.task};
    const bool extreme = request_.regimes[regime_]->extreme;
    const grade::GradedAnswer answer = grade::grade_answer(algorithm, extreme, query, c, outcome);
    const grade::AnswerClass became = grade::class_of(algorithm, answer, extreme);
    ++row.counts[static_cast<std::size_t>(became)];
    const double margin = grade::wrong_margin(algorithm, answer);
    const double error = grade::worst_error(algorithm, answer);
    grade::keep_greater(row.margin, margin);
    grade::keep_greater(row.error, error);
    const auto index = static_cast<std::int64_t>(c.index());
    if (became == grade::AnswerClass::crashed || became == grade::AnswerClass::hung) {
      if (row.lost < 0) row.lost = index;
    } else if (became == grade::AnswerClass::silent && badness(margin, error) > worst) {
      row.worst = index;
      worst = badness(margin, error);
    }
  }

  const PairRequest& request_;
  std::uint32_t regime_;
  AxisSummary summary_;
  std::vector<grade::TrueCase> cases_;
  AxisRows rows_;
};

}  // namespace

std::vector<grade::TrueCase> axis_cases(const PairRequest& request, std::uint32_t regime,
                                        oracle::Oracle& oracle, AxisSummary& summary) {
  const Regime& of = *request.regimes[regime];
  const Axis& axis = *of.axis;
  const auto asked = static_cast<std::uint64_t>(request.cases);
  const std::uint64_t slots = std::min(asked, axis.most_cases(of.parameter));
  summary.regime = regime;
  std::vector<grade::TrueCase> cases;
  for (std::uint64_t slot = 0; slot < slots; ++slot) {
    bool found = false;
    for (std::uint64_t attempt = 0; attempt < tries && !found; ++attempt) {
      const std::uint64_t index = slot * tries + attempt;
      grade::TrueCase c(make(of, request.seed, index), index, oracle);
      const oracle::Measure& exact = c.truth(Encoding::as_given).measure;
      found =
          axis.accepts == nullptr || axis.accepts(of.parameter, exact, grade::pair_size(c.pair()));
      if (!found) continue;
      if (exact.answer == Answer::unknown) ++summary.unresolved;
      cases.push_back(std::move(c));
    }
    if (!found) ++summary.dropped;
  }
  summary.cases = static_cast<std::int64_t>(cases.size());
  return cases;
}

double badness(double margin, double error) {
  if (!std::isnan(margin)) return 1e3 * (1 + margin);
  return std::isnan(error) ? 0 : std::min(error, 1e3);
}

std::string AxisChecker::certificates(std::uint32_t family) {
  AxisSummary summary;
  std::string lines;
  for (const grade::TrueCase& c :
       axis_cases(request_, request_.regime_of(family), oracle_, summary)) {
    lines += proof_line(c.pair(), oracle_);
  }
  return lines;
}

AxisRows AxisChecker::rows_of_job(std::uint32_t family, std::uint64_t /*round*/) {
  return AxisJob(request_, request_.regime_of(family), oracle_).run();
}

}  // namespace touchstone::kinds
