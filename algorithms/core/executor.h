// The threads that an algorithm may use. Algorithms are handed one and never start threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace touchstone {

// Whether each thread is kept on a processor of its own, of those that the process may use. Left to
// itself the system may let two threads take turns on one for milliseconds, which is what would be
// measured then.
enum class Pinning : std::uint8_t {
  none,
  one_a_thread,  // where there are enough processors; the caller's thread too, and for good
};

// A oneTBB arena of a fixed width.
class Executor {
 public:
  // `width` >= 1 threads, the caller's among them.
  explicit Executor(int width, Pinning pinning = Pinning::none);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  int width() const { return width_; }

  // Calls body(task, worker) for each task in [0, tasks) and returns when all are done; worker is
  // in [0, width), and no two calls with the same worker run at once. The first exception of a body
  // is rethrown. Tasks run in any order: for results that do not depend on the width, cut the work
  // by its size and not by the width, and let each task write where only it writes.
  void run(std::size_t tasks, const std::function<void(std::size_t task, int worker)>& body);

 private:
  struct Arena;
  int width_;
  std::unique_ptr<Arena> arena_;  // null at width 1: everything then runs in the caller
};

}  // namespace touchstone
