// Part of the executor: oneTBB's threads, in an arena of the executor's width.
// Paper: Kukanov, Voss, "The Foundations for Scalable Multi-core Software in Intel Threading Building
//        Blocks", Intel Technology Journal 11(4), 2007.
//
// Each task is a leaf of a parallel_for whose range is halved down to single tasks
// (simple_partitioner), so that a thread without work may steal any of them. The threads belong to the
// process and are ended with its last executor of this kind.
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <chrono>
#include <new>
#include <optional>
#include <utility>

#include "algorithms/core/executor/executor_threads.h"

#if defined(TOUCHSTONE_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#endif

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

// A place at which threads meet. oneTBB makes what was written before release() visible after
// acquire(). Its library is not instrumented, so the thread sanitizer has to be told of it.
class Meeting {
 public:
  void release() {
#if defined(TOUCHSTONE_THREAD_SANITIZER)
    __tsan_release(this);
#endif
  }
  void acquire() {
#if defined(TOUCHSTONE_THREAD_SANITIZER)
    __tsan_acquire(this);
#endif
  }
};

// Calls release() at the end of a task and acquire() at the end of a loop, whether they throw or not.
struct Releases {
  Meeting& meeting;
  ~Releases() { meeting.release(); }
};
struct Acquires {
  Meeting& meeting;
  ~Acquires() { meeting.acquire(); }
};

class OneTbbThreads final : public ExecutorThreads {
 public:
  OneTbbThreads(int width, Begin begin)
      : ExecutorThreads(least_shared_seconds),
        begin_(std::move(begin)),
        scheduler_(oneapi::tbb::attach{}),
        limit_(std::in_place, oneapi::tbb::global_control::max_allowed_parallelism, most_threads),
        arena_(width) {}
  ~OneTbbThreads() override {
    arena_.terminate();
    limit_.reset();
    // Waits until the threads have ended, unless others use them.
    oneapi::tbb::finalize(scheduler_, std::nothrow);
  }
  OneTbbThreads(const OneTbbThreads&) = delete;
  OneTbbThreads& operator=(const OneTbbThreads&) = delete;

 private:
  // Measured: two threads take less time than one for loops of at least this.
  static constexpr double least_shared_seconds = 10e-6;
  // Without a limit oneTBB starts no more threads than the first caller had processors, and a pinned
  // one has a single one. The arenas keep to their widths.
  static constexpr std::size_t most_threads = 1024;

  Share share(std::size_t tasks, const Body& body, double seconds) override;

  const Begin begin_;
  oneapi::tbb::task_scheduler_handle scheduler_;
  std::optional<oneapi::tbb::global_control> limit_;
  oneapi::tbb::task_arena arena_;
  Meeting fork_, join_;
};

ExecutorThreads::Share OneTbbThreads::share(std::size_t tasks, const Body& body,
                                            double /*seconds*/) {
  namespace tbb = oneapi::tbb;
  Share own;  // the caller alone writes it
  const auto start = Clock::now();
  const Acquires joins{join_};
  fork_.release();
  const auto leaf = [&](const tbb::blocked_range<std::size_t>& range) {
    fork_.acquire();
    const Releases joins_loop{join_};
    const int worker = tbb::this_task_arena::current_thread_index();
    begin_(worker);
    for (std::size_t task = range.begin(); task != range.end(); ++task) body(task, worker);
    if (worker != 0) return;
    own.tasks += range.size();
    own.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  };
  arena_.execute([&] {
    // An exception of an outer loop does not end this one.
    tbb::task_group_context context(tbb::task_group_context::isolated);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tasks), leaf, tbb::simple_partitioner(),
                      context);
  });
  return own;
}

}  // namespace

std::unique_ptr<ExecutorThreads> make_onetbb_threads(int width, ExecutorThreads::Begin begin) {
  return std::make_unique<OneTbbThreads>(width, std::move(begin));
}

}  // namespace touchstone
