// Part of the executor: when to wake a crew that sleeps. Loops that follow each other are likely to go
// on, and find awake who is woken for one of them. So threads are woken when they have missed as much
// as one long loop.
#pragma once

#include <chrono>

namespace touchstone {

class WakeRule {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Threads stay awake for this long after a loop: the next one of the same frame is near.
  static constexpr auto awake_for = std::chrono::microseconds(100);
  // Measured: waking a thread pays for a loop that takes a thread this long, or for several.
  static constexpr double least_seconds = 30e-6;

  // Without `adds_up` a loop counts for itself alone: threads that do not wait awake would sleep again
  // before the next one.
  explicit WakeRule(bool adds_up) : adds_up_(adds_up) {}

  // Says whether to wake the crew for a loop that begins now and would take one thread so many
  // seconds. `sleeps` is true if a thread of the crew does.
  bool wakes(bool sleeps, Time begin, double seconds) {
    if (!sleeps || !adds_up_ || begin - last_end_ > awake_for) missed_ = 0;
    if (!sleeps) return false;
    missed_ += seconds;
    if (missed_ < least_seconds) return false;
    missed_ = 0;
    return true;
  }
  void end_loop(Time end) { last_end_ = end; }

 private:
  const bool adds_up_;
  Time last_end_;      // of the last loop
  double missed_ = 0;  // seconds of loops since a thread fell asleep, was woken, or loops paused
};

}  // namespace touchstone
