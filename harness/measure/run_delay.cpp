// Reads the run delay of this process's threads.
#include "harness/measure/run_delay.h"

#include <time.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>

namespace touchstone::measure {
namespace {

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

std::optional<double> run_delay() {
  std::error_code error;
  std::optional<double> sum;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task", error)) {
    std::ifstream stream(thread.path() / "schedstat");
    double running = 0, waiting = 0;  // nanoseconds
    if (stream >> running >> waiting) sum = sum.value_or(0) + 1e-9 * waiting;
  }
  return sum;
}

void come_to_rest() {
  constexpr std::chrono::microseconds pause(100);
  constexpr double at_rest = 20e-6;  // seconds that the pause itself takes
  double before = processor_seconds();
  for (int i = 0; i < 50; ++i) {
    std::this_thread::sleep_for(pause);
    const double now = processor_seconds();
    if (now - before < at_rest) return;
    before = now;
  }
}

}  // namespace touchstone::measure
