#include "algorithms/core/executor/executor.h"

#include <gtest/gtest.h>
#if defined(__linux__)
#include <sched.h>
#endif

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "algorithms/core/executor/wake_rule.h"

namespace {

using touchstone::Executor;
using touchstone::ExecutorKind;
using touchstone::Pinning;
using touchstone::WakeRule;

// Each test runs with the threads of the crew and with oneTBB's.
class Executors : public testing::TestWithParam<ExecutorKind> {};
INSTANTIATE_TEST_SUITE_P(Of, Executors, testing::Values(ExecutorKind::crew, ExecutorKind::onetbb),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

TEST_P(Executors, RunsEachTaskOnceAtEveryWidth) {
  for (const int width : {1, 2, 3, 4, 5}) {
    Executor executor(width, Pinning::none, GetParam());
    for (const std::size_t tasks : {0u, 1u, 2u, 1000u}) {
      std::vector<int> runs(tasks, 0);
      executor.run(tasks, [&](std::size_t task, int) { ++runs[task]; });
      EXPECT_EQ(runs, std::vector<int>(tasks, 1)) << "width " << width;
    }
  }
}

TEST_P(Executors, NoTwoTasksShareAWorkerAtOnce) {
  constexpr int width = 4;
  Executor executor(width, Pinning::none, GetParam());
  std::vector<std::atomic<int>> busy(width);
  std::atomic<int> clashes{0};
  executor.run(2000, [&](std::size_t, int worker) {
    ASSERT_GE(worker, 0);
    ASSERT_LT(worker, width);
    if (busy[static_cast<std::size_t>(worker)].fetch_add(1) != 0) ++clashes;
    busy[static_cast<std::size_t>(worker)].fetch_sub(1);
  });
  EXPECT_EQ(clashes, 0);
}

// Each thread has a range of its own, and takes what is left of the other's. The first loop tells that
// tasks take so long that a thread which has fallen asleep is woken before the second one's first task,
// which waits for it.
TEST_P(Executors, ATaskThatWaitsLeavesItsRangeToOthers) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t tasks = 64;
  for (const std::size_t waiting : {std::size_t{0}, tasks / 2}) {
    Executor executor(2, Pinning::none, GetParam());
    bool waits = false;
    std::atomic<std::size_t> others{0};
    const auto body = [&](std::size_t task, int) {
      const auto begin = Clock::now();
      if (!waits) {
        while (Clock::now() < begin + std::chrono::microseconds(50)) {
        }
        return;
      }
      if (task != waiting) {
        ++others;
        return;
      }
      while (others < tasks - 1 && Clock::now() < begin + std::chrono::seconds(20)) {
        std::this_thread::yield();
      }
      EXPECT_EQ(others, tasks - 1);
    };
    executor.run(tasks, body);
    waits = true;
    executor.run(tasks, body);
    EXPECT_EQ(others, tasks - 1);
  }
}

#if defined(__linux__)
TEST_P(Executors, PinnedThreadsHaveAProcessorEach) {
  // The test runs in a thread of its own, because pins stay.
  std::thread([] {
    cpu_set_t allowed;
    ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
    if (CPU_COUNT(&allowed) < 2) GTEST_SKIP() << "there is one processor only";
    // The second is made by a thread that the first has pinned.
    for (int made = 0; made < 2; ++made) {
      Executor executor(2, Pinning::one_a_thread, GetParam());
      std::array<std::set<int>, 2> seen;
      for (int run = 0; run < 200; ++run) {
        executor.run(64, [&](std::size_t, int worker) {
          seen[static_cast<std::size_t>(worker)].insert(sched_getcpu());
        });
      }
      EXPECT_EQ(seen[0].size(), 1u);
      EXPECT_LE(seen[1].size(), 1u);
      if (!seen[1].empty()) {
        EXPECT_NE(*seen[0].begin(), *seen[1].begin());
      }
    }
    // More threads than processors are left to the system.
    Executor wide(CPU_SETSIZE, Pinning::one_a_thread, GetParam());
    std::atomic<int> tasks = 0;
    wide.run(100, [&](std::size_t, int) { ++tasks; });
    EXPECT_EQ(tasks, 100);
  }).join();
}
#endif

TEST_P(Executors, HandsExceptionsOn) {
  for (const int width : {1, 2, 4}) {
    Executor executor(width, Pinning::none, GetParam());
    EXPECT_THROW(executor.run(100,
                              [](std::size_t task, int) {
                                if (task == 57) throw std::runtime_error("57");
                              }),
                 std::runtime_error);
    int after = 0;
    executor.run(1, [&](std::size_t, int) { ++after; });
    EXPECT_EQ(after, 1);
  }
}

// Loops of all lengths, one after the other and after rests in which the threads fall asleep.
TEST_P(Executors, RunsLoopAfterLoop) {
  for (const int width : {2, 3}) {
    Executor executor(width, Pinning::none, GetParam());
    std::vector<std::atomic<int>> workers(static_cast<std::size_t>(width));
    std::size_t all = 0;
    for (int loop = 0; loop < 3000; ++loop) {
      const auto tasks = static_cast<std::size_t>(loop % 9);
      std::vector<int> runs(tasks, 0);
      executor.run(tasks, [&](std::size_t task, int worker) {
        ++runs[task];
        ++workers[static_cast<std::size_t>(worker)];
      });
      ASSERT_EQ(runs, std::vector<int>(tasks, 1)) << loop;
      all += tasks;
      if (loop % 100 == 0) std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    std::size_t sum = 0;
    for (const std::atomic<int>& runs : workers) sum += static_cast<std::size_t>(runs);
    EXPECT_EQ(sum, all);
    EXPECT_GT(workers[0], 0);
    // The caller's first task tells that tasks take long. Its next ones wait for another thread, which
    // a busy machine may not run for some time.
    std::atomic<int> of_caller = 0, of_others = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    executor.run(6, [&](std::size_t, int worker) {
      if (worker != 0) ++of_others;
      if (worker == 0 && ++of_caller > 1) {
        while (of_others == 0 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    });
    EXPECT_GT(of_others, 0) << "tasks that take long are shared, whoever slept before";
  }
}

// What the threads of a loop write is seen after it, and by the next one.
TEST_P(Executors, LoopsSeeWhatTheOnesBeforeWrote) {
  Executor executor(2, Pinning::none, GetParam());
  std::vector<std::uint64_t> values(64, 1);
  for (int loop = 0; loop < 500; ++loop) {
    std::vector<std::uint64_t> next(values.size());
    executor.run(values.size(), [&](std::size_t task, int) {
      std::uint64_t value = values[task] + 3 * values[(task + 1) % values.size()];
      for (int i = 0; i < 200; ++i) value = value * 6364136223846793005u + 1;
      next[task] = value;
    });
    for (std::size_t task = 0; task < values.size(); ++task) {
      std::uint64_t value = values[task] + 3 * values[(task + 1) % values.size()];
      for (int i = 0; i < 200; ++i) value = value * 6364136223846793005u + 1;
      ASSERT_EQ(next[task], value);
    }
    values = next;
  }
}

// An exception leaves no more tasks, and what was written before it is seen.
TEST_P(Executors, HandsOnWhatAnExceptionSays) {
  Executor executor(2, Pinning::none, GetParam());
  for (int loop = 0; loop < 50; ++loop) {
    std::vector<int> done(64, 0);
    std::string words;
    try {
      executor.run(done.size(), [&](std::size_t task, int) {
        std::this_thread::sleep_for(std::chrono::microseconds(10));
        if (task % 16 == 15) throw std::runtime_error("task " + std::to_string(task));
        ++done[task];
      });
    } catch (const std::runtime_error& error) {
      words = error.what();
    }
    EXPECT_TRUE(words.starts_with("task ")) << words;
    EXPECT_LT(std::accumulate(done.begin(), done.end(), 0), 60);
  }
}

// Two executors, of which the inner one is used by one thread at a time.
TEST_P(Executors, ALoopInATaskOfAnotherExecutorHasItsOwnThreads) {
  Executor outer(2, Pinning::none, GetParam());
  for (const ExecutorKind kind : {ExecutorKind::crew, ExecutorKind::onetbb}) {
    std::vector<std::unique_ptr<Executor>> inner;
    for (int worker = 0; worker < outer.width(); ++worker)
      inner.push_back(std::make_unique<Executor>(3, Pinning::none, kind));
    std::vector<std::atomic<int>> runs(16 * 16);
    std::atomic<int> others = 0;
    for (int loop = 0; loop < 20; ++loop) {
      outer.run(16, [&](std::size_t task, int worker) {
        inner[static_cast<std::size_t>(worker)]->run(16, [&](std::size_t own, int) {
          std::this_thread::sleep_for(std::chrono::microseconds(5));
          ++runs[task * 16 + own];
        });
        // The task goes on as the outer executor's worker.
        outer.run(2, [&](std::size_t, int same) { others += same == worker ? 0 : 1; });
      });
    }
    for (const std::atomic<int>& run : runs) ASSERT_EQ(run, 20);
    EXPECT_EQ(others, 0);
  }
}

#if defined(__linux__)
std::ptrdiff_t threads_of_process() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

// A process that forks has no threads left of executors that it had.
TEST_P(Executors, LeaveNoThreads) {
  const std::ptrdiff_t before = threads_of_process();
  for (int made = 0; made < 3; ++made) {
    Executor executor(2, Pinning::none, GetParam());
    std::atomic<int> others = 0;
    bool waits = false;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    const auto body = [&](std::size_t, int worker) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (worker != 0) ++others;
      while (waits && others == 0 && std::chrono::steady_clock::now() < end) {
        std::this_thread::yield();
      }
    };
    executor.run(4, body);  // it tells that tasks take long
    waits = true;
    executor.run(4, body);
    EXPECT_GT(others, 0);
    EXPECT_GT(threads_of_process(), before);
  }
  EXPECT_EQ(threads_of_process(), before);
}
#endif

// Loops of 12 us, of which each alone is too short.
TEST(WakeRule, CountsShortLoopsThatFollowEachOther) {
  using std::chrono::microseconds;
  constexpr double seconds = 12e-6;
  const auto wakes = [](WakeRule& rule, WakeRule::Time begin, bool sleeps = true) {
    const bool result = rule.wakes(sleeps, begin, seconds);
    rule.end_loop(begin + microseconds(12));
    return result;
  };
  const WakeRule::Time now{std::chrono::hours(1)};
  WakeRule rule(true);
  EXPECT_FALSE(wakes(rule, now));
  EXPECT_FALSE(wakes(rule, now + microseconds(50)));
  EXPECT_TRUE(wakes(rule, now + microseconds(100)));
  EXPECT_FALSE(wakes(rule, now + microseconds(150))) << "it begins anew";
  EXPECT_FALSE(wakes(rule, now + microseconds(200)));
  EXPECT_FALSE(wakes(rule, now + microseconds(400))) << "loops paused";
  EXPECT_FALSE(wakes(rule, now + microseconds(450)));
  EXPECT_FALSE(wakes(rule, now + microseconds(500), false)) << "all were awake";
  EXPECT_FALSE(wakes(rule, now + microseconds(550)));
  EXPECT_FALSE(wakes(rule, now + microseconds(600)));
  EXPECT_TRUE(wakes(rule, now + microseconds(650)));
  EXPECT_TRUE(rule.wakes(true, now + microseconds(700), WakeRule::least_seconds));
  WakeRule alone(false);
  for (int loop = 0; loop < 10; ++loop) EXPECT_FALSE(wakes(alone, now + microseconds(20 * loop)));
  EXPECT_TRUE(alone.wakes(true, now + microseconds(300), WakeRule::least_seconds));
}

TEST_P(Executors, ALoopInATaskIsItsWorkersOwn) {
  for (const int width : {1, 2, 4}) {
    Executor executor(width, Pinning::none, GetParam());
    std::vector<std::atomic<int>> runs(32 * 32);
    std::atomic<int> others = 0;
    executor.run(32, [&](std::size_t outer, int worker) {
      executor.run(32, [&](std::size_t inner, int own) {
        ++runs[outer * 32 + inner];
        others += own == worker ? 0 : 1;
      });
    });
    for (const std::atomic<int>& run : runs) ASSERT_EQ(run, 1);
    EXPECT_EQ(others, 0);
  }
}

TEST_P(Executors, RefuseNoThreads) {
  EXPECT_THROW(Executor(0, Pinning::none, GetParam()), std::invalid_argument);
}

}  // namespace
