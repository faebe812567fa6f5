// How a broad phase's tasks count their work side by side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/core/broad_phase_work.h"

namespace touchstone {

// Of one task. Counted a run of boxes at a time, in registers, and stored once.
struct TaskWork {
  std::uint64_t box_tests = 0, node_visits = 0, candidates = 0;

  // Pairs that nothing but the test of their boxes decides.
  void test_in_full(std::uint64_t pairs) {
    box_tests += pairs;
    candidates += pairs;
  }
};

// A place for each task, as in a PairSink: no sum depends on who did what. Keeps its memory.
class WorkCount {
 public:
  void start(std::size_t tasks) { tasks_.assign(tasks, {}); }
  TaskWork& task(std::size_t index) { return tasks_[index]; }

  // `bytes`: what the algorithm itself holds.
  BroadPhaseWork sum(std::size_t bytes) const {
    TaskWork all;
    for (const TaskWork& task : tasks_) {
      all.box_tests += task.box_tests;
      all.node_visits += task.node_visits;
      all.candidates += task.candidates;
    }
    return {.box_tests = static_cast<std::int64_t>(all.box_tests),
            .node_visits = static_cast<std::int64_t>(all.node_visits),
            .candidates = static_cast<std::int64_t>(all.candidates),
            .bytes = static_cast<std::int64_t>(bytes + held_bytes())};
  }
  std::size_t held_bytes() const { return tasks_.capacity() * sizeof(TaskWork); }

 private:
  std::vector<TaskWork> tasks_;
};

// Memory that vectors, and kernels which say so themselves, have reserved.
template <class Item>
std::size_t held_bytes(const std::vector<Item>& items) {
  return items.capacity() * sizeof(Item);
}
template <class Kernel>
requires requires(const Kernel& kernel) { kernel.held_bytes(); }
std::size_t held_bytes(const Kernel& kernel) { return kernel.held_bytes(); }
template <class... Parts>
requires(sizeof...(Parts) > 1) std::size_t held_bytes(const Parts&... parts) {
  return (std::size_t{0} + ... + held_bytes(parts));
}

}  // namespace touchstone
