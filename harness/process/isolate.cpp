// Runs items in children, watches their time, and starts a new child after each failure.
#include "harness/process/isolate.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>

#include "harness/base/clock.h"
#include "harness/process/child_process.h"

namespace touchstone::process {
namespace {

constexpr int tick_milliseconds = 20;

// The state that a child shares with its parent.
struct Progress {
  // Number of items begun since the parent made this, plus one for each child's setup. It goes up
  // whenever the child's time starts afresh.
  std::atomic<std::uint64_t> beats = 0;
  std::atomic<bool> in_setup = false;
  std::atomic<std::size_t> item = 0;  // item at hand
  std::atomic<bool> done = false;     // all items are done
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

// Runs in the child: the setup, then the items.
void work_through(std::size_t first, Progress& progress, SharedArray<ItemState>& states,
                  const std::function<ItemWork()>& setup) {
  const ItemWork work = setup();
  // This comes first, so that the setup's time does not count for an item.
  progress.beats.fetch_add(1);
  progress.in_setup.store(false);
  for (std::size_t item = first; item < states.size(); ++item) {
    progress.item.store(item);
    states[item] = ItemState::running;
    progress.beats.fetch_add(1);
    work(item);
    states[item] = ItemState::done;
  }
  progress.done.store(true);
  _exit(EXIT_SUCCESS);  // leaves before `work` is destroyed, which may hold broken data
}

// Returns when the child has ended, and stops it when it takes too long over one item. Returns
// false if it stopped the child just after the child had gone on to another item, which is not at
// fault.
bool watch(ChildProcess& child, const IsolationLimits& limits, const Progress& progress) {
  std::uint64_t beats = progress.beats.load();
  base::Stopwatch stopwatch;
  while (!child.has_ended()) {
    const double allowed = progress.in_setup.load() ? limits.setup_seconds : limits.item_seconds;
    if (const std::uint64_t now = progress.beats.load(); now != beats) {
      beats = now;
      stopwatch.restart();
    }
    if (stopwatch.seconds() > allowed) {
      child.stop();
      return progress.beats.load() == beats;
    }
    child.listen(tick_milliseconds);
  }
  return true;
}

}  // namespace

IsolationReport isolate(std::size_t items, const IsolationLimits& limits,
                        const std::function<ItemWork()>& setup) {
  IsolationReport report;
  SharedArray<ItemState> states(items);
  SharedArray<Progress> shared(1);
  Progress& progress = shared[0];
  for (std::size_t first = 0; first < items && report.failures.size() < limits.failures;) {
    progress.item.store(first);
    progress.in_setup.store(true);
    progress.beats.fetch_add(1);
    ChildProcess child({.memory = limits.memory},
                       [&] { work_through(first, progress, states, setup); });
    const bool in_time = watch(child, limits, progress);
    if (progress.done.load()) break;
    if (!in_time) {
      first = progress.item.load();
      continue;
    }
    IsolationFailure& failure = report.failures.emplace_back(child.failure());
    failure.item = progress.item.load();
    failure.in_setup = progress.in_setup.load();
    if (failure.in_setup) {
      std::ranges::fill(states.span().subspan(first), failure.state);
      break;
    }
    states[failure.item] = failure.state;
    first = failure.item + 1;
  }
  report.states.assign(states.span().begin(), states.span().end());
  return report;
}

}  // namespace touchstone::process
