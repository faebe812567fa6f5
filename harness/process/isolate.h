// Work done in a forked child, so that a crash or a hang of a library costs only the item at hand.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace touchstone {

enum class ItemState : std::uint8_t {
  not_run,    // never begun: the failures before it were too many
  running,    // begun, and not ended yet
  done,       // its work returned
  threw,      // its work, or the setup before it, threw
  crashed,    // it ended the child: a signal, an assertion, exit()
  timed_out,  // it was stopped
};

struct IsolationLimits {
  static constexpr std::size_t no_limit = static_cast<std::size_t>(-1);
  double item_seconds = 5;  // wall clock; an item is stopped at most a twentieth of a second later
  double setup_seconds = 60;        // the same for the setup of a child
  std::size_t failures = no_limit;  // no further item is begun after these
  std::size_t memory = std::size_t{4}
                       << 30;  // bytes that a child may add to what is there; beyond,
                               // its allocations fail. Not kept under a sanitizer.
};

struct IsolationFailure {
  std::size_t item = 0;
  bool in_setup = false;  // `item` is then the one that the setup was for; it ends the whole work
  ItemState state = ItemState::crashed;
  int signal = 0;     // that ended the child, or 0
  int exit_code = 0;  // of a child that left by exit()
  std::string words;  // what was thrown, or the last that the child printed; may be empty

  // "killed by signal 11 (Segmentation fault)", "no answer in time", ...
  std::string reason() const;
};

struct IsolationReport {
  std::vector<ItemState> states;           // of each item
  std::vector<IsolationFailure> failures;  // in the order of the items
};

using ItemWork = std::function<void(std::size_t item)>;

// Runs the items 0, 1, ... in order in a child process: `setup` once in each child, then the work
// that it returned on each item. After a failure a new child goes on at the next item; a failure of
// the setup would come again, so it ends the work, and its state is that of all items that are
// left.
//
// Results are written to SharedArrays; whatever else the child changes is lost with it. What it
// prints is kept from the terminal. Its memory is the caller's at the time of the call, but of the
// caller's threads only the calling one goes on in it: the work must not use an Executor that was
// made before. The child dies with the caller. An item costs a few stores; there is no fork for it.
IsolationReport isolate(std::size_t items, const IsolationLimits& limits,
                        const std::function<ItemWork()>& setup);

// Memory for `size` elements, value-initialised, that a child and its parent both see. Elements
// hold no pointers to memory of their own.
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

}  // namespace touchstone
