// A worker: one contestant in a process of its own, warm between samples.
// Its failure costs only its own samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "harness/measure/sampler.h"
#include "harness/process/child_process.h"

namespace touchstone::measure {

struct WorkerSettings {
  std::size_t memory = std::size_t{4} << 30;  // bytes that it may add to the memory in use
  std::uint64_t layout = 0;                   // seed of the place where its heap and stack begin
};

// The constructor forks the process, and the destructor ends it. The caller must be the only thread
// of its process (std::logic_error).
class Worker {
 public:
  // `make` is called in the worker; it makes the executor too, and keeps it alive.
  using Make = std::function<std::unique_ptr<Sampler>()>;
  Worker(const Make& make, const WorkerSettings& settings);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // Waits until `make` has returned; returns its failure, if any.
  std::optional<process::IsolationFailure> wait_until_made(double seconds);

  // Returns nothing if the worker crashed, left, threw or took longer than so many seconds: then it
  // has ended, and failure() describes how.
  std::optional<SampleReply> ask(const SampleRequest& request, double seconds);
  const process::IsolationFailure& failure() const { return failure_; }
  bool alive() const { return child_->alive(); }

 private:
  std::optional<SampleReply> wait(double seconds);
  void end(bool late);

  int line_ = -1;  // the socket of requests and replies, one a packet
  std::unique_ptr<process::ChildProcess> child_;
  process::IsolationFailure failure_;
};

}  // namespace touchstone::measure
