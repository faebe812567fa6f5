// Part of the executor: the threads behind it, of our crew or of oneTBB, and the choice between them
// and the caller alone.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <typeinfo>

namespace touchstone {

class ExecutorThreads {
 public:
  using Body = std::function<void(std::size_t task, int worker)>;
  // A thread calls it with its number, in [0, width), before it runs tasks of this executor.
  using Begin = std::function<void(int worker)>;

  virtual ~ExecutorThreads() = default;
  ExecutorThreads(const ExecutorThreads&) = delete;
  ExecutorThreads& operator=(const ExecutorThreads&) = delete;

  // Runs all tasks and returns when they are done. Rethrows the first exception of a body. The caller
  // is worker 0, and has called `begin` itself. It works alone where the last loop of the same type
  // of body says that others would not make it faster.
  void run(std::size_t tasks, const Body& body);

 protected:
  // What the caller did of a loop.
  struct Share {
    std::size_t tasks = 0;
    double seconds = 0;
  };

  // Loops that take one thread less time than this are run by the caller alone.
  explicit ExecutorThreads(double least_shared_seconds)
      : least_shared_seconds_(least_shared_seconds) {}

  // Runs all tasks with the threads; `seconds` is what one thread would take, or 0 if that is not
  // known. Rethrows the first exception of a body.
  virtual Share share(std::size_t tasks, const Body& body, double seconds) = 0;

 private:
  // What a task took when a body of this type last ran; 0 if that is not known. A type may lose its
  // entry to another.
  struct Estimate {
    const std::type_info* type = nullptr;
    double seconds_a_task = 0;
  };
  double& seconds_of(const Body& body);

  const double least_shared_seconds_;
  std::array<Estimate, 64> estimates_;
};

// Makes the threads of an executor of `width` >= 2. Those of the crew wait awake if there are as many
// processors.
std::unique_ptr<ExecutorThreads> make_crew(int width, bool may_spin, ExecutorThreads::Begin begin);
std::unique_ptr<ExecutorThreads> make_onetbb_threads(int width, ExecutorThreads::Begin begin);

}  // namespace touchstone
