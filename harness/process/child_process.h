// A forked child of this process: every child of the harness is one.
//
// The child dies with its parent and has a limit of memory. It leaves behind how it ended, and its
// last words.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>

#include "harness/process/ending.h"
#include "harness/process/shared_array.h"

namespace touchstone::process {

// Throws std::logic_error if this process has more threads than the calling one, since a forked
// child then finds their locks held for ever. A used Executor of more than one thread is such a
// case until it is destroyed. Nothing is checked under ThreadSanitizer, which has a
// thread of its own, or where the system does not list the threads.
void expect_one_thread();

class ChildProcess {
 public:
  static constexpr std::size_t no_limit = static_cast<std::size_t>(-1);
  static constexpr std::size_t kept_words = 400;  // bytes

  struct Settings {
    // Bytes that the child may add to its memory; further allocations fail. The limit is not set
    // under a sanitizer, which maps terabytes.
    std::size_t memory = no_limit;
    // The child calls this first, while it may still open its own files in /proc.
    std::function<void()> before = [] {};
  };

  // Forks. The child runs `work` and leaves with status 0; an exception ends it, and its text is
  // kept. The child dies with this process, dumps no core, leaves SIGINT and SIGTERM to its parent, and
  // prints nothing on the terminal. Throws std::system_error.
  ChildProcess(const Settings& settings, const std::function<void()>& work);
  ~ChildProcess();  // kills the child if it is alive
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  bool alive() const { return pid_ > 0; }
  // A descriptor that becomes readable when the child prints; -1 when the child will print no more.
  int words() const { return words_at_end_ ? -1 : words_; }
  // Reads the child's output; waits up to `milliseconds` if there is none yet.
  void listen(int milliseconds);
  // Returns without waiting whether the child has ended by itself.
  bool has_ended();
  // Waits until the child ends by itself, and stops it after `seconds`.
  void wait(double seconds);
  // Ends the child because it takes too long.
  void stop();
  // Returns how the child ended, with its last words; the caller fills in `item` and `in_setup`.
  IsolationFailure failure();

 private:
  struct Thrown {
    bool is_set;
    std::array<char, kept_words> text;
  };

  [[noreturn]] void run(pid_t parent, int output, const Settings& settings,
                        const std::function<void()>& work);

  pid_t pid_ = -1;
  int status_ = 0;
  bool stopped_ = false;
  int words_ = -1;
  bool words_at_end_ = false;
  bool heard_ = false;
  std::string text_;
  SharedArray<Thrown> thrown_{1};
};

}  // namespace touchstone::process
