// Part of the executor: threads that help the caller with the tasks of a loop.
// Paper: Markatos, LeBlanc, "Using Processor Affinity in Loop Scheduling on Shared-Memory
//        Multiprocessors", IEEE Transactions on Parallel and Distributed Systems 5, 1994.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "algorithms/core/executor/executor_threads.h"
#include "algorithms/core/executor/wake_rule.h"

namespace touchstone {

// A loop is open while its tasks are handed out. A thread of the crew enters an open loop, takes
// tasks until none is left, and leaves; the caller takes tasks too, closes the loop and waits until
// all have left. All this goes through one atomic number, which threads that are awake watch.
//
// The tasks are cut into one range for each thread. Each takes those of its own range, and then those
// that are left of the others': loops over the same places one after the other find in a core's cache
// what it wrote there, and threads seldom touch the same counter.
class ExecutorCrew final : public ExecutorThreads {
 public:
  // Threads call `begin` with their number, in [1, width), when they start. They wait awake if
  // there is a processor for each.
  ExecutorCrew(int width, bool may_spin, Begin begin);
  ~ExecutorCrew() override;
  ExecutorCrew(const ExecutorCrew&) = delete;
  ExecutorCrew& operator=(const ExecutorCrew&) = delete;

 private:
  // Measured: two threads that are awake take less time than one for loops of at least this.
  static constexpr double least_shared_seconds = 3e-6;

  Share share(std::size_t tasks, const Body& body, double seconds) override;

  // Bits of state_: a loop is open; the crew is to end; above them the number of the threads in the
  // loop, and above these the number of the loop.
  static constexpr std::uint64_t is_open = 1;
  static constexpr std::uint64_t is_over = 2;
  static constexpr std::uint64_t one_inside = 4;
  static constexpr std::uint64_t all_inside = 0xffff'fffc;
  static constexpr int loop_bits = 32;

  void start_threads();
  void wake();
  void work_as(int worker);
  bool enter(std::uint64_t& loop);
  void sleep(std::uint64_t loop);
  // A range of the tasks, in a cache line of its own.
  struct alignas(64) Range {
    std::atomic<std::size_t> next = 0;
    std::size_t end = 0;  // it changes only while nobody is inside
  };

  void cut(std::size_t tasks);
  bool run_next(int worker);

  const int width_;
  const bool may_spin_;
  const Begin begin_;
  std::vector<std::thread> threads_;

  // The loop; it changes only while nobody is inside.
  const Body* body_ = nullptr;
  std::exception_ptr failure_;  // guarded by mutex_

  WakeRule wake_rule_;

  alignas(64) std::atomic<std::uint64_t> state_ = 0;
  std::vector<Range> ranges_;  // one for each thread, the caller's first
  alignas(64) std::atomic<int> asleep_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;  // there is a new loop, or the crew is to end
};

}  // namespace touchstone
