// Part of the executor: the choice between its threads and the caller alone.
#include "algorithms/core/executor/executor_threads.h"

#include <chrono>

namespace touchstone {

double& ExecutorThreads::seconds_of(const Body& body) {
  const auto* const type = &body.target_type();
  Estimate& estimate = estimates_[type->hash_code() % estimates_.size()];
  if (estimate.type != type) estimate = {type, 0};
  return estimate.seconds_a_task;
}

void ExecutorThreads::run(std::size_t tasks, const Body& body) {
  double& seconds_a_task = seconds_of(body);
  const double seconds = seconds_a_task * static_cast<double>(tasks);
  Share own;
  // Of a type that has not run before nothing is known, so the threads are told of its tasks.
  if (seconds == 0 || seconds >= least_shared_seconds_) {
    own = share(tasks, body, seconds);
  } else {
    const auto start = std::chrono::steady_clock::now();
    for (; own.tasks < tasks; ++own.tasks) body(own.tasks, 0);
    own.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  if (own.tasks > 0) seconds_a_task = own.seconds / static_cast<double>(own.tasks);
}

}  // namespace touchstone
