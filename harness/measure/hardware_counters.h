// The processor's own counters, if the kernel allows to read them (perf_event_open(2)).
#pragma once

#include <cstdint>

namespace touchstone::measure {

// Counts one kind of event, in user space, in the thread that opened it and in all threads that it
// starts afterwards.
class EventCounter {
 public:
  // `type` and `config` have the meaning of those in perf_event_attr.
  EventCounter(std::uint32_t type, std::uint64_t config);
  ~EventCounter();
  EventCounter(const EventCounter&) = delete;
  EventCounter& operator=(const EventCounter&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  void start();
  // Returns the count since start(); -1 if the kernel refused the counter, or never ran it. If it
  // shared a register of the processor with others, the count is scaled up to the whole time.
  std::int64_t count() const;

 private:
  struct Reading {
    std::uint64_t value = 0, enabled = 0, running = 0;  // times in nanoseconds
  };
  Reading read() const;

  int descriptor_;
  Reading before_;
};

struct HardwareCounts {
  std::int64_t cycles = -1, instructions = -1, branch_misses = -1, cache_misses = -1;
};

// The object must be made before the threads that it counts; it is read outside the clock.
class HardwareCounters {
 public:
  HardwareCounters();
  void start();
  HardwareCounts counts() const;  // the counts since start()

 private:
  EventCounter cycles_, instructions_, branch_misses_, cache_misses_;
};

}  // namespace touchstone::measure
