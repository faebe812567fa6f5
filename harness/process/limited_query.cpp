// Runs queries in children, each under a limit of processor time and one of wall-clock time.
#include "harness/process/limited_query.h"

#include <sys/time.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <functional>
#include <map>
#include <memory>
#include <span>

#include "harness/base/clock.h"
#include "harness/process/isolate.h"
#include "harness/process/solve_case.h"

namespace touchstone::process {
namespace {

constexpr double clock_factor = 20;  // wall clock, in units of the processor time
constexpr double bind_seconds = 3;   // processor time
constexpr std::size_t memory = std::size_t{1} << 30;
constexpr std::size_t many_vertices = 5000;

// Sets a timer that ends this process with SIGPROF after `seconds` of processor time; 0: no timer.
void limit_processor_time(double seconds) {
  const double whole = std::floor(seconds);
  itimerval timer = {};
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - whole) * 1e6);
  setitimer(ITIMER_PROF, &timer, nullptr);
}

bool is_large(const Shape& shape) {
  return shape.kind == ShapeKind::hull && shape.hull->vertices.size() > many_vertices;
}

// The bound large bodies that a child keeps from query to query.
using Bound = std::map<const files::Case*, std::unique_ptr<BoundCase>>;

struct Asked {
  struct Range {
    std::size_t first, end;
  };
  std::vector<ItemState> states;  // one for each place
  std::vector<Range> by_clock;    // places that exceeded the wall clock, but not the processor time
};

class Asker {
 public:
  Asker(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
        const std::vector<LimitedQuery>& queries, const QueryLimits& limits)
      : entry_(entry), settings_(settings), queries_(queries), limits_(limits) {
    large_ = std::ranges::any_of(queries, [](const LimitedQuery& query) {
      return is_large(query.pair->shape_a) || is_large(query.pair->shape_b);
    });
  }

  // Runs the queries at these places.
  Asked ask(std::span<const std::size_t> places, SharedArray<Outcome>& outcomes) const {
    const IsolationLimits isolation = {.item_seconds = clock_factor * limits_.seconds,
                                       .setup_seconds = clock_factor * bind_seconds,
                                       .failures = limits_.lost,
                                       .memory = memory};
    const IsolationReport report = isolate(places.size(), isolation, [&]() -> ItemWork {
      const auto bound = std::make_shared<Bound>();
      limit_processor_time(bind_seconds);
      for (std::size_t i = 0; large_ && i < places.size(); ++i) {
        const files::Case* const c = queries_[places[i]].pair;
        if (!bound->contains(c)) (*bound)[c] = std::make_unique<BoundCase>(entry_, settings_, *c);
      }
      limit_processor_time(0);
      return [&, bound](std::size_t i) {
        const LimitedQuery& query = queries_[places[i]];
        limit_processor_time(limits_.seconds);
        outcomes[places[i]] = large_ ? bound->at(query.pair)->solve(query.task)
                                     : solve_case(entry_, settings_, *query.pair, query.task);
        limit_processor_time(0);
      };
    });
    Asked asked = {report.states, {}};
    for (const IsolationFailure& failure : report.failures) {
      const std::size_t end = failure.in_setup ? places.size() : failure.item + 1;
      if (failure.signal == SIGPROF) {
        std::fill(asked.states.begin() + static_cast<std::ptrdiff_t>(failure.item),
                  asked.states.begin() + static_cast<std::ptrdiff_t>(end), ItemState::timed_out);
      }
      if (failure.state == ItemState::timed_out) asked.by_clock.push_back({failure.item, end});
    }
    return asked;
  }

 private:
  const NarrowPhaseEntry& entry_;
  const NarrowPhaseSettings& settings_;
  const std::vector<LimitedQuery>& queries_;
  const QueryLimits& limits_;
  bool large_ = false;
};

}  // namespace

std::vector<Outcome> ask_limited(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                                 const std::vector<LimitedQuery>& queries,
                                 const QueryLimits& limits) {
  const Asker asker(entry, settings, queries, limits);
  SharedArray<Outcome> outcomes(queries.size());
  std::vector<std::size_t> all(queries.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  Asked asked = asker.ask(all, outcomes);
  // A second attempt distinguishes a query that hangs from a machine that was suspended.
  for (const Asked::Range& range : asked.by_clock) {
    const std::span<const std::size_t> again(all.data() + range.first, range.end - range.first);
    std::ranges::copy(asker.ask(again, outcomes).states,
                      asked.states.begin() + static_cast<std::ptrdiff_t>(range.first));
  }
  std::vector<Outcome> result(outcomes.span().begin(), outcomes.span().end());
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (asked.states[i] == ItemState::done) continue;
    result[i] = Outcome{};
    result[i].status =
        asked.states[i] == ItemState::not_run ? Status::unsupported : status_of(asked.states[i]);
  }
  return result;
}

bool is_not_asked(const Outcome& outcome) { return outcome.status == Status::unsupported; }

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
