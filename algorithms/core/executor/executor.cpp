// The executor's choice of threads, and their pinning.
#include "algorithms/core/executor/executor.h"

#if defined(__linux__)
#include <sched.h>
#endif

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "algorithms/core/executor/executor_threads.h"

namespace touchstone {
namespace {

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

void pin_to(int processor) {
#if defined(__linux__)
  thread_local int pinned = -1;
  if (pinned == processor) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(processor, &set);
  if (sched_setaffinity(0, sizeof set, &set) == 0) pinned = processor;
#else
  static_cast<void>(processor);
#endif
}

// The executor whose task this thread runs, and as which worker.
struct Place {
  const void* threads = nullptr;
  int worker = 0;
};
thread_local Place place;

}  // namespace

std::string_view to_string(ExecutorKind kind) {
  switch (kind) {
    case ExecutorKind::crew: return "crew";
    case ExecutorKind::onetbb: return "onetbb";
  }
  return "?";
}

Executor::Executor(int width, Pinning pinning, ExecutorKind kind)
    : width_(width), pinning_(pinning) {
  if (width < 1) throw std::invalid_argument("an executor has at least one thread");
  const bool has_processors = static_cast<std::size_t>(width) <= allowed_processors().size();
  if (!has_processors) pinning_ = Pinning::none;
  if (width == 1) return;
  // More threads than this bring nothing, where an executor is wider than the machine.
  constexpr int most = 8;
  const int count = has_processors ? width : std::min(width, most);
  auto begin = [this](int worker) {
    pin(worker);
    place = {threads_.get(), worker};
  };
  if (kind == ExecutorKind::onetbb) {
    threads_ = make_onetbb_threads(count, begin);
  } else {
    threads_ = make_crew(count, has_processors, begin);
  }
}

Executor::~Executor() = default;

void Executor::pin(int worker) const {
  if (pinning_ == Pinning::none || width_ == 1) return;
  pin_to(allowed_processors()[static_cast<std::size_t>(worker)]);
}

void Executor::run(std::size_t tasks,
                   const std::function<void(std::size_t task, int worker)>& body) {
  const bool is_inner = threads_ && place.threads == threads_.get();
  if (!threads_ || tasks <= 1 || is_inner) {
    const int worker = is_inner ? place.worker : 0;
    for (std::size_t task = 0; task < tasks; ++task) body(task, worker);
    return;
  }
  struct Leave {
    Place outer;
    ~Leave() { place = outer; }
  };
  const Leave leave{place};
  pin(0);
  place = {threads_.get(), 0};
  threads_->run(tasks, body);
}

}  // namespace touchstone
