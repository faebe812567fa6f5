// Opens and reads the processor's counters.
#include "harness/measure/hardware_counters.h"

#if defined(__linux__)
#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include <cmath>
#include <initializer_list>

namespace touchstone::measure {

#if defined(__linux__)

EventCounter::EventCounter(std::uint32_t type, std::uint64_t config) {
  perf_event_attr event{};
  event.size = sizeof event;
  event.type = type;
  event.config = config;
  event.inherit = 1;
  event.exclude_kernel = 1;
  event.exclude_hv = 1;
  event.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
  constexpr pid_t this_thread = 0;
  constexpr int any_processor = -1;
  constexpr int no_group = -1;  // a group cannot be inherited
  descriptor_ = static_cast<int>(syscall(SYS_perf_event_open, &event, this_thread, any_processor,
                                         no_group, PERF_FLAG_FD_CLOEXEC));
}

EventCounter::~EventCounter() {
  if (is_open()) close(descriptor_);
}

EventCounter::Reading EventCounter::read() const {
  Reading reading;
  if (::read(descriptor_, &reading, sizeof reading) != sizeof reading) return {};
  return reading;
}

HardwareCounters::HardwareCounters()
    : cycles_(PERF_TYPE_HARDWARE, PERF_COUNT_HW_CPU_CYCLES),
      instructions_(PERF_TYPE_HARDWARE, PERF_COUNT_HW_INSTRUCTIONS),
      branch_misses_(PERF_TYPE_HARDWARE, PERF_COUNT_HW_BRANCH_MISSES),
      cache_misses_(PERF_TYPE_HARDWARE, PERF_COUNT_HW_CACHE_MISSES) {}

#else

EventCounter::EventCounter(std::uint32_t, std::uint64_t) : descriptor_(-1) {}
EventCounter::~EventCounter() = default;
EventCounter::Reading EventCounter::read() const { return {}; }
HardwareCounters::HardwareCounters()
    : cycles_(0, 0), instructions_(0, 0), branch_misses_(0, 0), cache_misses_(0, 0) {}

#endif

void EventCounter::start() {
  if (is_open()) before_ = read();
}

std::int64_t EventCounter::count() const {
  if (!is_open()) return -1;
  const Reading now = read();
  const std::uint64_t running = now.running - before_.running;
  if (now.running <= before_.running || now.value < before_.value) return -1;
  const double part =
      static_cast<double>(now.enabled - before_.enabled) / static_cast<double>(running);
  return std::llround(static_cast<double>(now.value - before_.value) * part);
}

void HardwareCounters::start() {
  for (EventCounter* event : {&cycles_, &instructions_, &branch_misses_, &cache_misses_}) {
    event->start();
  }
}

HardwareCounts HardwareCounters::counts() const {
  return {.cycles = cycles_.count(),
          .instructions = instructions_.count(),
          .branch_misses = branch_misses_.count(),
          .cache_misses = cache_misses_.count()};
}

}  // namespace touchstone::measure
