#include "harness/grade/guarded_solve.h"

#include <algorithm>

#include "harness/base/clock.h"
#include "harness/process/isolate.h"

namespace touchstone {

void solve_guarded(const std::function<std::unique_ptr<NarrowPhase>()>& make, Task task,
                   const PairBatch& batch, std::span<Outcome> outcomes, double time_limit,
                   std::size_t memory_limit) {
  SharedArray<Outcome> shared(batch.size());
  const Stopwatch total;
  const IsolationLimits limits = {
      .item_seconds = time_limit, .failures = 3, .memory = memory_limit};
  const IsolationReport report = isolate(batch.size(), limits, [&]() -> ItemWork {
    const std::shared_ptr<NarrowPhase> algorithm = make();
    return [&, algorithm](std::size_t i) {
      if (total.seconds() > time_limit) {
        shared[i].status = Status::timed_out;
        return;
      }
      PairBatch one = batch;
      one.pairs.first = batch.pairs.first.subspan(i, 1);
      one.pairs.second = batch.pairs.second.subspan(i, 1);
      algorithm->solve(task, one, shared.span().subspan(i, 1));
    };
  });
  std::ranges::copy(shared.span(), outcomes.begin());
  Status last = Status::crashed;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (report.states[i] == ItemState::done) continue;
    if (report.states[i] != ItemState::not_run) {
      last = report.states[i] == ItemState::timed_out ? Status::timed_out : Status::crashed;
    }
    outcomes[i] = Outcome{};
    outcomes[i].status = last;
  }
}

}  // namespace touchstone
