// Tests that a worker pool takes results in order and reports lost workers.
#include "harness/process/worker_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/harness/process/no_child_is_left.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

TEST(WorkerPool, ResultsComeInOrderFromAllWorkers) {
  std::vector<std::size_t> order;
  std::set<std::string> pids;
  process::run_jobs(
      5, 105, 3,
      []() -> process::JobWork {
        return [](std::size_t job) {
          usleep(static_cast<useconds_t>(job % 7 * 300));
          return std::to_string(getpid()) + std::string(job * 1000, '.');
        };
      },
      [&](std::size_t job, const std::string& result) {
        order.push_back(job);
        const std::size_t digits = result.find('.');
        EXPECT_EQ(result.size() - digits, job * 1000);
        pids.insert(result.substr(0, digits));
        return true;
      });
  ASSERT_EQ(order.size(), 100u);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i + 5);
  EXPECT_GE(pids.size(), 2u);
  EXPECT_FALSE(pids.contains(std::to_string(getpid())));
  expect_no_child_is_left();
}

TEST(WorkerPool, EndsWhenItIsTold) {
  std::size_t last = 0;
  process::run_jobs(
      0, static_cast<std::size_t>(-1), 2,
      []() -> process::JobWork { return [](std::size_t) { return std::string(); }; },
      [&](std::size_t job, const std::string&) {
        last = job;
        return job < 50;
      });
  EXPECT_EQ(last, 50u);
  expect_no_child_is_left();
}

TEST(WorkerPool, NoJobs) {
  process::run_jobs(
      3, 3, 2, []() -> process::JobWork { throw std::logic_error("not to be called"); },
      [](std::size_t, const std::string&) { return true; });
}

void run_with_harm(const std::function<void()>& harm) {
  process::run_jobs(
      0, 10, 2,
      [&]() -> process::JobWork {
        return [&](std::size_t job) {
          if (job == 4) harm();
          return std::string();
        };
      },
      [](std::size_t, const std::string&) { return true; });
}

std::string message_of(const std::function<void()>& harm) {
  try {
    run_with_harm(harm);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(WorkerPool, ALostWorkerIsAnError) {
  EXPECT_EQ(message_of([] { throw std::runtime_error("too much"); }), "job 4: too much");
  expect_no_child_is_left();
  EXPECT_THAT(message_of([] { std::raise(SIGKILL); }), HasSubstr("killed by signal 9"));
  expect_no_child_is_left();
  EXPECT_THAT(message_of([] { _exit(3); }), HasSubstr("exit(3)"));
  expect_no_child_is_left();
}

}  // namespace
}  // namespace touchstone
