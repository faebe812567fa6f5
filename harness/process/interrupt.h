// Interrupts of long work, which ends then at a place where nothing is lost.
#pragma once

namespace touchstone::process {

// While one lives, SIGINT and SIGTERM only set a flag that the work reads. A second SIGINT, of a user
// who does not want to wait, ends the program as usual; schedulers send SIGTERM more than once, and
// kill later. Guards may be nested, in the program's only thread; the outermost one counts.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  // Returns the signal that was caught, or 0.
  static int signal();
  static bool raised() { return signal() != 0; }
};

}  // namespace touchstone::process
