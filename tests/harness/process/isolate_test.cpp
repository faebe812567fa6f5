// Tests that isolated work survives crashes, hangs and floods of output.
#include "harness/process/isolate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "harness/base/clock.h"
#include "tests/harness/process/no_child_is_left.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

// Limits for work that ends by itself, also on a busy machine, and for work that never ends.
constexpr process::IsolationLimits patient = {.item_seconds = 60, .setup_seconds = 60};
constexpr process::IsolationLimits quick = {.item_seconds = 1, .setup_seconds = 1};

// Seven items that write their squares, except item 3, which does `harm`.
struct SevenItems {
  process::SharedArray<int> squares{7};
  process::IsolationReport report;

  explicit SevenItems(const std::function<void()>& harm,
                      const process::IsolationLimits& limits = patient) {
    report = process::isolate(squares.size(), limits, [&] {
      return [&](std::size_t item) {
        if (item == 3) harm();
        squares[item] = static_cast<int>(item * item);
      };
    });
  }

  void expect_only_item_3_lost(process::ItemState state) const {
    ASSERT_EQ(report.failures.size(), 1u);
    EXPECT_EQ(report.failures[0].item, 3u);
    EXPECT_EQ(report.failures[0].state, state);
    EXPECT_FALSE(report.failures[0].in_setup);
    for (std::size_t i = 0; i < 7; ++i) {
      EXPECT_EQ(report.states[i], i == 3 ? state : process::ItemState::done) << i;
      EXPECT_EQ(squares[i], i == 3 ? 0 : static_cast<int>(i * i)) << i;
    }
  }
};

TEST(Isolate, DoesTheWorkInAnotherProcess) {
  process::SharedArray<pid_t> pids(100);
  int here = 0;
  const process::IsolationReport report = process::isolate(pids.size(), patient, [&] {
    return [&](std::size_t item) {
      pids[item] = getpid();
      ++here;
    };
  });
  EXPECT_TRUE(report.failures.empty());
  EXPECT_EQ(std::ranges::count(report.states, process::ItemState::done), 100);
  EXPECT_EQ(here, 0);
  EXPECT_NE(pids[0], getpid());
  EXPECT_EQ(std::ranges::count(pids.span(), pids[0]), 100) << "one child for all";
  expect_no_child_is_left();
}

TEST(Isolate, NothingToDo) {
  const process::IsolationReport report =
      process::isolate(0, patient, []() -> process::ItemWork { std::abort(); });
  EXPECT_TRUE(report.states.empty());
  EXPECT_TRUE(report.failures.empty());
}

TEST(Isolate, Crash) {
  const SevenItems run([] {
    std::fputs("the last words\n", stderr);
    std::raise(SIGSEGV);
  });
  run.expect_only_item_3_lost(process::ItemState::crashed);
  EXPECT_EQ(run.report.failures[0].signal, SIGSEGV);
  EXPECT_EQ(run.report.failures[0].reason(),
            "killed by signal 11 (Segmentation fault): the last words");
  expect_no_child_is_left();
}

TEST(Isolate, AbortAsOfAnAssertion) {
  const SevenItems run([] { std::abort(); });
  run.expect_only_item_3_lost(process::ItemState::crashed);
  EXPECT_EQ(run.report.failures[0].signal, SIGABRT);
}

TEST(Isolate, HangAsleepAndBusy) {
  const SevenItems asleep(
      [] {
        for (;;) pause();
      },
      quick);
  asleep.expect_only_item_3_lost(process::ItemState::timed_out);
  EXPECT_EQ(asleep.report.failures[0].reason(), "no answer in time");
  volatile bool forever = true;
  const SevenItems busy(
      [&] {
        while (forever) {
        }
      },
      quick);
  busy.expect_only_item_3_lost(process::ItemState::timed_out);
  expect_no_child_is_left();
}

TEST(Isolate, HangWithEveryFileClosed) {
  const SevenItems run(
      [] {
        for (int i = 0; i < 100; ++i) close(i);
        for (;;) pause();
      },
      quick);
  run.expect_only_item_3_lost(process::ItemState::timed_out);
}

TEST(Isolate, Throw) {
  const SevenItems run([] { throw std::runtime_error("too thin"); });
  run.expect_only_item_3_lost(process::ItemState::threw);
  EXPECT_EQ(run.report.failures[0].reason(), "threw: too thin");
  const SevenItems number([] { throw 3; });
  number.expect_only_item_3_lost(process::ItemState::threw);
  const SevenItems wordy([] { throw std::runtime_error(std::string(100000, 'x')); });
  wordy.expect_only_item_3_lost(process::ItemState::threw);
}

TEST(Isolate, Exit) {
  const SevenItems run([] { _exit(7); });
  run.expect_only_item_3_lost(process::ItemState::crashed);
  EXPECT_EQ(run.report.failures[0].exit_code, 7);
  const SevenItems success([] { _exit(0); });
  success.expect_only_item_3_lost(process::ItemState::crashed);
  EXPECT_EQ(success.report.failures[0].reason(), "left by exit(0)");
}

TEST(Isolate, AllocatesWithoutEnd) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the limit is not kept under a sanitizer";
#else
  process::IsolationLimits limits = patient;
  limits.memory = std::size_t{64} << 20;
  const SevenItems run(
      [] {
        std::vector<std::vector<char>> all;
        for (;;) all.emplace_back(1 << 20, 'x');
      },
      limits);
  run.expect_only_item_3_lost(process::ItemState::threw);
  EXPECT_THAT(run.report.failures[0].words, HasSubstr("bad_alloc"));
#endif
}

int recurse(int depth) {
  volatile char frame[4096] = {};
  frame[0] = static_cast<char>(depth);
  return depth == -1 ? 0 : recurse(depth + 1) + frame[0];
}

TEST(Isolate, RecursesWithoutEnd) {
  const SevenItems run([] { recurse(0); });
  run.expect_only_item_3_lost(process::ItemState::crashed);
}

TEST(Isolate, PrintsWithoutEnd) {
  const SevenItems run(
      [] {
        for (;;) std::fputs("noise\n", stderr);
      },
      quick);
  run.expect_only_item_3_lost(process::ItemState::timed_out);
  EXPECT_LE(run.report.failures[0].words.size(), 400u);
}

TEST(Isolate, EveryItemCrashes) {
  const process::IsolationReport report =
      process::isolate(20, patient, [] { return [](std::size_t) { std::abort(); }; });
  EXPECT_EQ(report.failures.size(), 20u);
  EXPECT_EQ(std::ranges::count(report.states, process::ItemState::crashed), 20);
}

TEST(Isolate, GivesUpAfterTooManyFailures) {
  process::IsolationLimits limits = patient;
  limits.failures = 2;
  const process::IsolationReport report = process::isolate(9, limits, [] {
    return [](std::size_t item) {
      if (item % 2 == 1) std::abort();
    };
  });
  EXPECT_EQ(report.failures.size(), 2u);
  EXPECT_THAT(report.states,
              ::testing::ElementsAre(process::ItemState::done, process::ItemState::crashed,
                                     process::ItemState::done, process::ItemState::crashed,
                                     process::ItemState::not_run, process::ItemState::not_run,
                                     process::ItemState::not_run, process::ItemState::not_run,
                                     process::ItemState::not_run));
}

TEST(Isolate, FailureOfTheSetupEndsIt) {
  const auto states = [](const std::function<process::ItemWork()>& setup,
                         const process::IsolationLimits& limits = patient) {
    const process::IsolationReport report = process::isolate(3, limits, setup);
    EXPECT_EQ(report.failures.size(), 1u);
    EXPECT_TRUE(report.failures.at(0).in_setup);
    EXPECT_EQ(std::ranges::count(report.states, report.states[0]), 3);
    return report.states[0];
  };
  EXPECT_EQ(states([]() -> process::ItemWork { std::abort(); }), process::ItemState::crashed);
  EXPECT_EQ(states([]() -> process::ItemWork { throw std::runtime_error("no"); }),
            process::ItemState::threw);
  EXPECT_EQ(states(
                []() -> process::ItemWork {
                  for (;;) pause();
                },
                quick),
            process::ItemState::timed_out);
}

TEST(Isolate, ManySlowItemsAreNotOneHang) {
  const process::IsolationReport report = process::isolate(12, quick, [] {
    return [](std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(120)); };
  });
  EXPECT_TRUE(report.failures.empty());
}

TEST(Isolate, WhatIsBufferedIsWrittenOnce) {
  const std::string name = testing::TempDir() + "isolate_buffered.txt";
  std::FILE* const file = std::fopen(name.c_str(), "w");
  ASSERT_NE(file, nullptr);
  std::fputs("before ", file);
  process::isolate(3, patient, [] {
    return [](std::size_t item) {
      if (item == 1) std::exit(1);
    };
  });
  std::fputs("after", file);
  std::fclose(file);
  std::string text;
  std::getline(std::ifstream(name), text);
  EXPECT_EQ(text, "before after");
  std::remove(name.c_str());
}

TEST(Isolate, ManyItemsCostLittle) {
  constexpr std::size_t count = 200000;
  process::SharedArray<std::uint32_t> out(count);
  const process::IsolationReport report = process::isolate(count, patient, [&] {
    return [&](std::size_t item) { out[item] = static_cast<std::uint32_t>(item) + 1; };
  });
  EXPECT_TRUE(report.failures.empty());
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(out[i], i + 1);
}

}  // namespace
}  // namespace touchstone
