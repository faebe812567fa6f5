// The clock of all measurements.
#pragma once

#include <chrono>

namespace touchstone {

// Wall-clock time since it was made, from a clock that never goes back.
class Stopwatch {
 public:
  using Clock = std::chrono::steady_clock;

  double seconds() const { return std::chrono::duration<double>(now_() - start_).count(); }
  void restart() { start_ = now_(); }

  // Tests of what is made of times put a clock of their own in its place, for their process and
  // what it forks.
  static void use(Clock::time_point (*now)()) { now_ = now; }

 private:
  inline static Clock::time_point (*now_)() = [] { return Clock::now(); };
  Clock::time_point start_ = now_();
};

}  // namespace touchstone
