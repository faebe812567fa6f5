// Solves a batch of pairs one by one in an isolated child.
#include "harness/process/queries/guarded_solve.h"

#include <algorithm>

#include "harness/base/clock.h"
#include "harness/process/isolate.h"

namespace touchstone::process {

void solve_guarded(const std::function<std::unique_ptr<NarrowPhase>()>& make, Task task,
                   const PairBatch& batch, std::span<Outcome> outcomes, double time_limit,
                   std::size_t memory_limit) {
  const auto solver = [&]() -> SolveBatch {
    return [task, algorithm = std::shared_ptr<NarrowPhase>(make())](const PairBatch& one,
                                                                    std::span<Outcome> outcome) {
      algorithm->solve(task, one, outcome);
    };
  };
  solve_guarded(solver, batch, outcomes, time_limit, memory_limit);
}

void solve_guarded(const std::function<SolveBatch()>& make, const PairBatch& batch,
                   std::span<Outcome> outcomes, double time_limit, std::size_t memory_limit) {
  const base::Stopwatch total;
  const IsolationLimits limits = {
      .item_seconds = time_limit, .failures = 3, .memory = memory_limit};
  const auto solved = isolated_answers<Outcome>(batch.size(), limits, [&] {
    return [&, solve = make()](std::size_t i) {
      Outcome outcome;
      if (total.seconds() > time_limit) {
        outcome.status = Status::timed_out;
        return outcome;
      }
      PairBatch one = batch;
      one.pairs.first = batch.pairs.first.subspan(i, 1);
      one.pairs.second = batch.pairs.second.subspan(i, 1);
      solve(one, {&outcome, 1});
      return outcome;
    };
  });
  std::ranges::copy(solved.answers, outcomes.begin());
}

}  // namespace touchstone::process
