// A forked child of this process: every child of the harness is one.
//
// The child dies with its parent and has a limit of memory. It leaves behind how it ended, and its
// last words.
#pragma once

#include <sys/mman.h>
#include <sys/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "algorithms/core/status.h"

namespace touchstone::process {

// An array of `size` value-initialised elements. Elements hold no pointers to memory of their own.
template <class T>
class SharedArray {
 public:
  static_assert(std::is_trivially_destructible_v<T>);

  explicit SharedArray(std::size_t size) : size_(size) {
    if (size == 0) return;
    void* const memory = mmap(nullptr, size * sizeof(T), PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    data_ = static_cast<T*>(memory);
    std::uninitialized_value_construct_n(data_, size);
  }
  ~SharedArray() {
    if (data_ != nullptr) munmap(data_, size_ * sizeof(T));
  }
  SharedArray(const SharedArray&) = delete;
  SharedArray& operator=(const SharedArray&) = delete;

  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  std::span<T> span() { return {data_, size_}; }
  std::span<const T> span() const { return {data_, size_}; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

enum class ItemState : std::uint8_t {
  not_run,    // never begun, since too many items failed before it
  running,    // begun, and not ended yet
  done,       // its work returned
  threw,      // its work, or the setup before it, threw
  crashed,    // its work ended the child: a signal, an assertion, exit()
  timed_out,  // it was stopped
  garbage,    // its work threw Garbage
};

// Thrown by work that got an answer which cannot be read.
class Garbage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Returns "ok" for `done`, "threw", "crashed", "timed_out" or "garbage"; "not_run" for work that did not end.
std::string_view to_string(ItemState state);

// The status of an answer whose item ended in this state: ok for `done`, timed_out for a stopped
// item, garbage for what cannot be read, crashed for all else.
Status status_of(ItemState state);

// Returns whether an answer is missing because the query ended its process or was stopped, or cannot be read.
inline bool is_lost(Status status) {
  return status == Status::crashed || status == Status::timed_out || status == Status::garbage;
}

struct IsolationFailure {
  std::size_t item = 0;
  // The setup failed; `item` is the item that it preceded. This ends the whole work.
  bool in_setup = false;
  ItemState state = ItemState::crashed;
  int signal = 0;     // signal that ended the child, or 0
  int exit_code = 0;  // status of a child that left by exit()
  std::string words;  // text of the exception, and the last output of the child; may be empty

  // Returns words such as "killed by signal 11 (Segmentation fault)" or "no answer in time".
  std::string reason() const;
};

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
    ItemState state;  // threw or garbage; not_run if nothing was thrown
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
