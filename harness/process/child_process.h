// A forked child of this process: every child of the harness is one.
//
// It dies with its parent, has a limit of memory, and leaves behind how it ended and its last
// words.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>

#include "harness/process/ending.h"
#include "harness/process/shared_array.h"

namespace touchstone::process {

// Throws std::logic_error when this process has more threads than the calling one: a forked child
// then finds their locks held for ever. An Executor of more than one thread that has been used is
// such a case, since oneTBB keeps its threads. ThreadSanitizer has a thread of its own, so nothing
// is checked under it, nor where the system does not list the threads.
void expect_one_thread();

class ChildProcess {
 public:
  static constexpr std::size_t no_limit = static_cast<std::size_t>(-1);
  static constexpr std::size_t kept_words = 400;  // bytes

  struct Settings {
    // Bytes that the child may add to what is there; beyond, its allocations fail. A sanitizer maps
    // terabytes, so the limit is not kept under one.
    std::size_t memory = no_limit;
    // The child calls this first, while it may still open its own files in /proc.
    std::function<void()> before = [] {};
  };

  // Forks. The child runs `work` and leaves with status 0; an exception ends it, and its text is
  // kept. The child dies with this process, dumps no core, leaves interrupts to its parent, and
  // what it prints is kept from the terminal. Throws std::system_error.
  ChildProcess(const Settings& settings, const std::function<void()>& work);
  ~ChildProcess();  // kills a child that is alive
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  bool alive() const { return pid_ > 0; }
  // Becomes readable when the child prints; -1 when it will not print any more.
  int words() const { return words_at_end_ ? -1 : words_; }
  // Takes what the child printed; waits so long for it when there is nothing.
  void listen(int milliseconds);
  // Looks, without waiting, whether the child has ended by itself.
  bool has_ended();
  // Waits until the child ends by itself, and stops it when that takes longer than so many seconds.
  void wait(double seconds);
  // Ends the child for taking too long.
  void stop();
  // How it ended, with its last words; `item` and `in_setup` are the caller's to fill in.
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
