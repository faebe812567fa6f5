// Tests of workers, healthy and harmful.
#include "harness/measure/worker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>

#include "algorithms/core/executor/executor.h"
#include "tests/harness/process/no_child_is_left.h"

namespace touchstone {
namespace {

// A sampler that answers with the frame; at frame 3 it does harm.
class Fake final : public measure::Sampler {
 public:
  explicit Fake(std::function<void()> harm) : harm_(std::move(harm)) {}
  measure::SampleReply sample(const measure::SampleRequest& request) override {
    if (request.frame == 3) harm_();
    measure::SampleReply reply;
    reply.pairs = request.frame;
    return reply;
  }

 private:
  std::function<void()> harm_;
};

process::IsolationFailure failure_of(const std::function<void()>& harm, double seconds = 60) {
  measure::Worker worker([&] { return std::make_unique<Fake>(harm); },
                         {.memory = std::size_t{256} << 20, .layout = 1});
  EXPECT_FALSE(worker.wait_until_made(60));
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    const auto reply = worker.ask({.frame = frame}, 60);
    EXPECT_TRUE(reply && reply->pairs == frame);
  }
  EXPECT_FALSE(worker.ask({.frame = 3}, seconds));
  EXPECT_FALSE(worker.alive());
  EXPECT_FALSE(worker.ask({.frame = 4}, 10)) << "dead is dead";
  return worker.failure();
}

TEST(Worker, ACrashIsTold) {
  const process::IsolationFailure failure = failure_of([] {
    std::fputs("the last words\n", stderr);
    std::raise(SIGSEGV);
  });
  EXPECT_EQ(failure.state, process::ItemState::crashed);
  EXPECT_EQ(failure.signal, SIGSEGV);
  EXPECT_EQ(failure.words, "the last words");
  expect_no_child_is_left();
}

TEST(Worker, AHangIsEnded) {
  EXPECT_EQ(failure_of([] { pause(); }, 0.3).state, process::ItemState::timed_out);
  expect_no_child_is_left();
}

TEST(Worker, WhatIsThrownIsTold) {
  const process::IsolationFailure failure =
      failure_of([] { throw std::runtime_error("no such luck"); });
  EXPECT_EQ(failure.state, process::ItemState::threw);
  EXPECT_EQ(failure.words, "no such luck");
}

TEST(Worker, LeavingIsTold) {
  const process::IsolationFailure failure = failure_of([] { _exit(7); });
  EXPECT_EQ(failure.state, process::ItemState::crashed);
  EXPECT_EQ(failure.exit_code, 7);
}

TEST(Worker, WhatPrintsALotIsHeardAndNotStopped) {
  const process::IsolationFailure failure = failure_of([] {
    for (int i = 0; i < 100'000; ++i) std::fputs("talk talk talk\n", stderr);
    std::abort();
  });
  EXPECT_EQ(failure.signal, SIGABRT);
  EXPECT_THAT(failure.words, testing::EndsWith("talk"));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Worker, ALeakEndsAtTheLimit) {
  const process::IsolationFailure failure = failure_of([] {
    for (;;) {
      volatile char* const lost = new char[1 << 20];
      lost[0] = 1;
    }
  });
  EXPECT_EQ(failure.state, process::ItemState::threw);
  EXPECT_THAT(failure.words, testing::HasSubstr("bad_alloc"));
}
#endif

TEST(Worker, AFailureBeforeTheFirstSampleIsTold) {
  measure::Worker worker(
      []() -> std::unique_ptr<measure::Sampler> { throw std::runtime_error("not today"); }, {});
  const auto failure = worker.wait_until_made(60);
  ASSERT_TRUE(failure);
  EXPECT_TRUE(failure->in_setup);
  EXPECT_EQ(failure->words, "not today");
}

// Returns true if `use` makes forking refused. It runs in a process of its own, whose threads may
// stay.
bool refuses_to_fork_after(const std::function<void()>& use) {
  const pid_t child = fork();
  if (child == 0) {
    use();
    try {
      measure::Worker worker([] { return std::make_unique<Fake>([] {}); }, {});
      _exit(worker.wait_until_made(60) ? 2 : 0);
    } catch (const std::logic_error&) {
      _exit(1);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) < 2);
  return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

TEST(Worker, IsNotForkedByAProcessOfSeveralThreads) {
  const auto use_and_keep = [](int width) {
    auto executor = std::make_unique<Executor>(width);
    std::atomic<int> sum = 0;
    executor->run(1000, [&](std::size_t, int) { ++sum; });
    EXPECT_EQ(sum, 1000);
    return executor;
  };
  const auto use = [&](int width) { use_and_keep(width); };
  EXPECT_FALSE(refuses_to_fork_after([] {}));
  EXPECT_FALSE(refuses_to_fork_after([&] { use(1); }));
#if !defined(__SANITIZE_THREAD__)
  EXPECT_FALSE(refuses_to_fork_after([&] { use(2); }));
  EXPECT_TRUE(refuses_to_fork_after([&] { static_cast<void>(use_and_keep(2).release()); }));
  EXPECT_TRUE(refuses_to_fork_after([] { std::thread([] { pause(); }).detach(); }));
#endif
}

TEST(Worker, LayoutsDiffer) {
  // The address of new memory shows where the heap begins.
  struct Where final : measure::Sampler {
    measure::SampleReply sample(const measure::SampleRequest&) override {
      measure::SampleReply reply;
      char here = 0;
      const auto heap = std::make_unique<char[]>(5000);
      reply.pairs = static_cast<std::int64_t>(reinterpret_cast<std::uintptr_t>(heap.get()));
      reply.contacts = static_cast<std::int64_t>(reinterpret_cast<std::uintptr_t>(&here));
      return reply;
    }
  };
  std::set<std::int64_t> heaps, stacks;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    measure::Worker worker([] { return std::make_unique<Where>(); }, {.layout = seed});
    EXPECT_FALSE(worker.wait_until_made(60));
    const auto reply = worker.ask({}, 60);
    ASSERT_TRUE(reply);
    heaps.insert(reply->pairs);
    stacks.insert(reply->contacts);
  }
  EXPECT_GE(heaps.size(), 3u);
  EXPECT_GE(stacks.size(), 7u);
}

}  // namespace
}  // namespace touchstone
