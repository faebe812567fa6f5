// The executor on oneTBB, and the pinning of its threads.
#include "algorithms/core/executor.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

#if defined(__linux__)
#include <sched.h>
#endif

#include <optional>
#include <stdexcept>
#include <vector>

#if defined(TOUCHSTONE_THREAD_SANITIZER)
// Debian's libtbb is not instrumented, and half of oneTBB is in headers. So the build does not
// instrument this file either, and ThreadSanitizer does not see the fork and the join. These two
// functions announce them, once, for every algorithm.
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

namespace {

// They announce the join where a scope ends, also when an exception leaves it.
struct JoinAfter {
  void* join;
  ~JoinAfter() { TOUCHSTONE_HAPPENS_AFTER(join); }
};
struct JoinBefore {
  void* join;
  ~JoinBefore() { TOUCHSTONE_HAPPENS_BEFORE(join); }
};

// The processors that this process may use; empty if the system does not report them. The list is
// read before the first pin, because a pinned thread, and those that it starts, have one left.
const std::vector<int>& allowed_processors() {
  static const std::vector<int> processors = [] {
    std::vector<int> allowed;
#if defined(__linux__)
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) {
      for (int i = 0; i < CPU_SETSIZE; ++i) {
        if (CPU_ISSET(i, &set)) allowed.push_back(i);
      }
    }
#endif
    return allowed;
  }();
  return processors;
}

// Pins each thread that enters the arena to the processor of its place there.
class Pins final : public oneapi::tbb::task_scheduler_observer {
 public:
  explicit Pins(oneapi::tbb::task_arena& arena) : task_scheduler_observer(arena) { observe(true); }
  ~Pins() override { observe(false); }
  Pins(const Pins&) = delete;
  Pins& operator=(const Pins&) = delete;

  void on_scheduler_entry(bool) override {
#if defined(__linux__)
    thread_local int pinned = -1;
    const int place = oneapi::tbb::this_task_arena::current_thread_index();
    const int processor = allowed_processors()[static_cast<std::size_t>(place)];
    if (pinned == processor) return;
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(processor, &set);
    if (sched_setaffinity(0, sizeof set, &set) == 0) pinned = processor;
#endif
  }
};

}  // namespace

struct Executor::Arena {
  Arena(int width, Pinning pinning) : arena(width) {
    arena.initialize();
    if (pinning == Pinning::none) return;
    if (allowed_processors().size() < static_cast<std::size_t>(width)) return;
    pins.emplace(arena);
  }
  oneapi::tbb::task_arena arena;
  std::optional<Pins> pins;
};

Executor::Executor(int width, Pinning pinning) : width_(width) {
  if (width < 1) throw std::invalid_argument("an executor has at least one thread");
  if (width > 1) arena_ = std::make_unique<Arena>(width, pinning);
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
  const JoinAfter joined{&join};
  arena_->arena.execute([&] {
    using Range = oneapi::tbb::blocked_range<std::size_t>;
    oneapi::tbb::parallel_for(
        Range(0, tasks, 1),
        [&](const Range& range) {
          TOUCHSTONE_HAPPENS_AFTER(&fork);
          const JoinBefore joins{&join};
          const int worker = oneapi::tbb::this_task_arena::current_thread_index();
          for (std::size_t task = range.begin(); task != range.end(); ++task) body(task, worker);
        },
        oneapi::tbb::simple_partitioner());
  });
}

}  // namespace touchstone
