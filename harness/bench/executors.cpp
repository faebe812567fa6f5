// Benchmarks of executors of two threads: how long a loop takes, of each kind of threads.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <thread>

#include "algorithms/core/executor/executor.h"
#include "harness/base/enumerators.h"
#include "harness/bench/benchmarks.h"

namespace touchstone::bench {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int width = 2;

void stay_busy(std::chrono::nanoseconds time) {
  const auto end = Clock::now() + time;
  while (Clock::now() < end) {
  }
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Measures in a thread of its own, because the threads of an executor stay pinned.
void measure(benchmark::State& state, ExecutorKind kind,
             const std::function<double(Executor&)>& take) {
  std::thread([&] {
    Executor executor(width, Pinning::one_a_thread, kind);
    for (int i = 0; i < 100; ++i) take(executor);
    for (auto _ : state) state.SetIterationTime(take(executor));
  }).join();
}

// A loop of so many tasks of a microsecond, or of two empty ones, which the threads share however short
// it is: the loop before it, which is not timed, says that its tasks are long.
double shared(Executor& executor, std::size_t microseconds) {
  using namespace std::chrono_literals;
  constexpr auto long_task = 30us;
  std::chrono::nanoseconds time = long_task;
  const auto body = [&time](std::size_t, int) {
    if (time > 0ns) stay_busy(time);
  };
  executor.run(width, body);
  time = microseconds == 0 ? 0us : 1us;
  const auto start = Clock::now();
  executor.run(microseconds == 0 ? width : microseconds, body);
  return seconds_since(start);
}

// A loop as algorithms run it: the executor knows what its tasks take.
double known(Executor& executor, std::size_t microseconds) {
  using namespace std::chrono_literals;
  const auto start = Clock::now();
  executor.run(microseconds, [](std::size_t, int) { stay_busy(1us); });
  return seconds_since(start);
}

}  // namespace

void register_executor_benchmarks() {
  const auto add = [](const std::string& name, ExecutorKind kind, std::size_t microseconds,
                      double (*take)(Executor&, std::size_t)) {
    benchmark::RegisterBenchmark(
        name.c_str(),
        [=](benchmark::State& state) {
          measure(state, kind, [=](Executor& executor) { return take(executor, microseconds); });
        })
        ->UseManualTime()
        ->Iterations(20'000)
        ->Unit(benchmark::kMicrosecond);
  };
  for (const ExecutorKind kind : base::enumerators<ExecutorKind>) {
    add(fmt::format("executors/{}/fork-join", to_string(kind)), kind, 0, shared);
    for (const std::size_t microseconds : {2, 4, 8, 16, 64}) {
      add(fmt::format("executors/{}/shared/{}us", to_string(kind), microseconds), kind,
          microseconds, shared);
      add(fmt::format("executors/{}/loop/{}us", to_string(kind), microseconds), kind, microseconds,
          known);
    }
  }
}

}  // namespace touchstone::bench
