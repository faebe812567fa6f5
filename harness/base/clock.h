// The clock of all measurements.
#pragma once

#include <chrono>

namespace touchstone::base {

// Wall-clock time since construction, from a clock that never goes backward.
class Stopwatch {
 public:
  using Clock = std::chrono::steady_clock;

  double seconds() const { return std::chrono::duration<double>(now_() - start_).count(); }
  void restart() { start_ = now_(); }

  // Replaces the clock in this process and its children. Tests of code that depends on times use
  // it.
  static void use(Clock::time_point (*now)()) { now_ = now; }

 private:
  inline static Clock::time_point (*now_)() = [] { return Clock::now(); };
  Clock::time_point start_ = now_();
};

}  // namespace touchstone::base
