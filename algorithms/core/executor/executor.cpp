// The executor's choice between one thread and its crew, and the pinning of threads.
#include "algorithms/core/executor/executor.h"

#if defined(__linux__)
#include <sched.h>
#endif

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <typeinfo>
#include <vector>

#include "algorithms/core/executor/executor_crew.h"

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
  const void* crew = nullptr;
  int worker = 0;
};
thread_local Place place;

// What a task took when a body of this type last ran; 0 if that is not known. A type may lose its
// entry to another.
struct Estimate {
  const std::type_info* type = nullptr;
  double seconds_a_task = 0;
};

}  // namespace

class Executor::Crew : public ExecutorCrew {
 public:
  using ExecutorCrew::ExecutorCrew;

  void run(std::size_t tasks, const Body& body);

 private:
  double& seconds_of(const Body& body) {
    const auto* const type = &body.target_type();
    Estimate& estimate = estimates_[type->hash_code() % estimates_.size()];
    if (estimate.type != type) estimate = {type, 0};
    return estimate.seconds_a_task;
  }

  std::array<Estimate, 64> estimates_;
};

void Executor::Crew::run(std::size_t tasks, const Body& body) {
  double& seconds_a_task = seconds_of(body);
  const double seconds = seconds_a_task * static_cast<double>(tasks);
  Share own;
  // Of a type that has not run before nothing is known, so the crew is told of its tasks.
  if (seconds == 0 || seconds >= least_shared_seconds) {
    own = share(tasks, body, seconds);
  } else {
    const auto start = std::chrono::steady_clock::now();
    for (; own.tasks < tasks; ++own.tasks) body(own.tasks, 0);
    own.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  if (own.tasks > 0) seconds_a_task = own.seconds / static_cast<double>(own.tasks);
}

Executor::Executor(int width, Pinning pinning) : width_(width), pinning_(pinning) {
  if (width < 1) throw std::invalid_argument("an executor has at least one thread");
  const std::size_t processors = allowed_processors().size();
  if (processors < static_cast<std::size_t>(width)) pinning_ = Pinning::none;
  if (width == 1) return;
  crew_ = std::make_unique<Crew>(width, static_cast<std::size_t>(width) <= processors,
                                 [this](int worker) {
                                   pin(worker);
                                   place = {crew_.get(), worker};
                                 });
}

Executor::~Executor() = default;

void Executor::pin(int worker) const {
  if (pinning_ == Pinning::none || width_ == 1) return;
  pin_to(allowed_processors()[static_cast<std::size_t>(worker)]);
}

void Executor::run(std::size_t tasks,
                   const std::function<void(std::size_t task, int worker)>& body) {
  const bool is_inner = crew_ && place.crew == crew_.get();
  if (!crew_ || tasks <= 1 || is_inner) {
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
  place = {crew_.get(), 0};
  crew_->run(tasks, body);
}

}  // namespace touchstone
