#include "algorithms/core/executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace {

using touchstone::Executor;

TEST(Executor, RunsEachTaskOnceAtEveryWidth) {
  for (const int width : {1, 2, 3, 5}) {
    Executor executor(width);
    for (const std::size_t tasks : {0u, 1u, 2u, 1000u}) {
      std::vector<int> runs(tasks, 0);
      executor.run(tasks, [&](std::size_t task, int) { ++runs[task]; });
      EXPECT_EQ(runs, std::vector<int>(tasks, 1)) << "width " << width;
    }
  }
}

TEST(Executor, NoTwoTasksShareAWorkerAtOnce) {
  constexpr int width = 4;
  Executor executor(width);
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

TEST(Executor, HandsExceptionsOn) {
  for (const int width : {1, 2}) {
    Executor executor(width);
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

TEST(Executor, RefusesNoThreads) { EXPECT_THROW(Executor(0), std::invalid_argument); }

}  // namespace
