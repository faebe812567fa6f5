// What every forked child of the harness needs: a parent that it dies with, a limit of memory, and
// somebody who hears its last words.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>

namespace touchstone {

// std::logic_error where this process has more threads than the calling one: a child that is forked
// then finds their locks held for ever. An Executor of more than one thread that has been used is
// such a case, since oneTBB keeps its threads. Not looked at under ThreadSanitizer, which has a
// thread of its own, or where the system does not tell.
void expect_one_thread();

// Lets this process add so many bytes to what it has; beyond, its allocations fail. Not kept under
// a sanitizer, which maps terabytes.
void allow_memory(std::size_t bytes);

// First thing in a child: it dies with `parent` (at once where that is gone), dumps no core, leaves
// an interrupt to its parent, and prints into `output`.
void begin_child(pid_t parent, int output);

// The end of what a child prints.
class LastWords {
 public:
  static constexpr std::size_t kept = 400;  // bytes

  // Takes the reading end of the pipe.
  explicit LastWords(int descriptor) : descriptor_(descriptor) {}
  ~LastWords();
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;

  // To wait for more; -1 when there will be none.
  int descriptor() const { return at_end_ ? -1 : descriptor_; }
  // Takes what is there; waits up to so long when it is nothing.
  void listen(int milliseconds);
  // All that was printed, without the white space at its end.
  std::string take();

 private:
  int descriptor_;
  bool at_end_ = false;
  bool heard_ = false;
  std::string text_;
};

// A pipe whose reading end hears a child's words, and whose writing end the child prints into. Both
// are closed on exec. Throws std::system_error.
struct WordsPipe {
  int listening, speaking;
};
WordsPipe make_words_pipe();

// Ends the process and takes its status.
int kill_and_wait(pid_t pid);

}  // namespace touchstone
