// The threads that an algorithm may use. Algorithms receive an executor and never start threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

namespace touchstone {

// The pinning of each thread to a processor of its own, among those that the process may use.
// Without it the system may let two threads share one processor for milliseconds, which would
// distort measurements.
enum class Pinning : std::uint8_t {
  none,
  one_a_thread,  // if there are enough processors; pins the caller's thread too, and for good
};

// Whose threads an executor uses. Both run the same tasks and give the same results.
enum class ExecutorKind : std::uint8_t {
  crew,    // our own: few instructions to fork and join
  onetbb,  // oneTBB's, in an arena of the executor's width
};
std::string_view to_string(ExecutorKind kind);
inline constexpr ExecutorKind usual_executor = ExecutorKind::crew;

class ExecutorThreads;

// A fixed number of threads: the caller's and others, which are started when they are first needed.
// Between two calls of run() they wait awake for a short time, and then asleep.
class Executor {
 public:
  // Makes an executor of `width` >= 1 threads, including the caller's. At width 1 there are no others,
  // of whichever kind.
  explicit Executor(int width, Pinning pinning = Pinning::none, ExecutorKind kind = usual_executor);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  int width() const { return width_; }

  // Calls body(task, worker) for each task in [0, tasks) and returns when all are done. `worker` is
  // in [0, width), and two calls with the same worker never run at once. The first exception of a
  // body is rethrown. Tasks run in any order. For results that do not depend on the width, cut the
  // work by its size and not by the width, and let each task write only to its own places. One
  // thread at a time calls it, or a body does, whose worker then does all tasks of the inner call,
  // unless the outer call has a single task: then the threads share the inner one.
  //
  // The caller works alone where more threads would be slower. It knows so from what the tasks of
  // the same type of body took before, so give each loop a body of a type of its own, as a lambda
  // has.
  void run(std::size_t tasks, const std::function<void(std::size_t task, int worker)>& body);

  // Pins the calling thread to the processor of this worker, if this executor's threads are pinned:
  // for a library that has threads of its own.
  void pin(int worker) const;

 private:
  int width_;
  Pinning pinning_;
  std::unique_ptr<ExecutorThreads> threads_;  // null at width 1: the caller then runs all tasks
};

}  // namespace touchstone
