// The one clock that everything is timed with.
#pragma once

#include <chrono>

namespace touchstone {

// Seconds since it was made, by the monotonic clock.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace touchstone
