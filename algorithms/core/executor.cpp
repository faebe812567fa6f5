#include "algorithms/core/executor.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <stdexcept>

#if defined(TOUCHSTONE_THREAD_SANITIZER)
// Debian's libtbb is not instrumented, and half of oneTBB is in headers: so this file is not
// instrumented either (the build sees to it), and ThreadSanitizer knows nothing of the fork and the
// join. These two tell it, once, for every algorithm.
extern "C" {
void __tsan_acquire(void* address);
void __tsan_release(void* address);
}
#define TOUCHSTONE_HAPPENS_BEFORE(address) __tsan_release(address)
#define TOUCHSTONE_HAPPENS_AFTER(address) __tsan_acquire(address)
#else
#define TOUCHSTONE_HAPPENS_BEFORE(address) static_cast<void>(address)
#define TOUCHSTONE_HAPPENS_AFTER(address) static_cast<void>(address)
#endif

namespace touchstone {

struct Executor::Arena {
  explicit Arena(int width) : arena(width) { arena.initialize(); }
  oneapi::tbb::task_arena arena;
};

Executor::Executor(int width) : width_(width) {
  if (width < 1) throw std::invalid_argument("an executor has at least one thread");
  if (width > 1) arena_ = std::make_unique<Arena>(width);
}

Executor::~Executor() = default;

void Executor::run(std::size_t tasks,
                   const std::function<void(std::size_t task, int worker)>& body) {
  if (!arena_ || tasks <= 1) {
    for (std::size_t task = 0; task < tasks; ++task) body(task, 0);
    return;
  }
  char fork = 0;
  char join = 0;
  TOUCHSTONE_HAPPENS_BEFORE(&fork);
  arena_->arena.execute([&] {
    using Range = oneapi::tbb::blocked_range<std::size_t>;
    oneapi::tbb::parallel_for(
        Range(0, tasks, 1),
        [&](const Range& range) {
          TOUCHSTONE_HAPPENS_AFTER(&fork);
          const int worker = oneapi::tbb::this_task_arena::current_thread_index();
          for (std::size_t task = range.begin(); task != range.end(); ++task) body(task, worker);
          TOUCHSTONE_HAPPENS_BEFORE(&join);
        },
        oneapi::tbb::simple_partitioner());
  });
  TOUCHSTONE_HAPPENS_AFTER(&join);
}

}  // namespace touchstone
