// Reads the system's pressure and steal counters and the run delay of this process, and flags noisy
// rounds.
#include "harness/measure/noise.h"

#include <fmt/core.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <thread>

namespace touchstone::measure {
namespace {

constexpr double pressure_share = 0.5;
constexpr double steal_share = 0.01;
constexpr double preempted_share = 0.05;
constexpr double busy_percent = 5;

// Returns the number behind "key" on the line that begins with `line`.
std::optional<double> pressure_value(const std::filesystem::path& proc, std::string_view key) {
  std::ifstream stream(proc / "pressure/cpu");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t at = line.find(key);
    if (!line.starts_with("some ") || at == std::string::npos) continue;
    std::istringstream number(line.substr(at + key.size()));
    double value = 0;
    if (number >> value) return value;
  }
  return {};
}

std::optional<double> stolen_seconds(const std::filesystem::path& proc) {
  std::ifstream stream(proc / "stat");
  std::string name;
  double user = 0, nice = 0, system = 0, idle = 0, iowait = 0, irq = 0, softirq = 0, steal = 0;
  if (!(stream >> name >> user >> nice >> system >> idle >> iowait >> irq >> softirq >> steal) ||
      name != "cpu") {
    return {};
  }
  return steal / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace

NoiseReading NoiseReading::now(const std::filesystem::path& proc) {
  NoiseReading reading;
  if (const auto total = pressure_value(proc, "total=")) reading.waited = *total * 1e-6;
  reading.stolen = stolen_seconds(proc);
  return reading;
}

std::string noise_flags(const NoiseReading& before, const NoiseReading& after, double seconds,
                        double workers_waited) {
  std::string flags;
  const auto add = [&](bool raised, const char* flag) {
    if (raised) flags += (flags.empty() ? "" : "+") + std::string(flag);
  };
  const auto grew = [](const std::optional<double>& from, const std::optional<double>& to) {
    return from && to ? *to - *from : 0.0;
  };
  add(grew(before.waited, after.waited) > pressure_share * seconds, "pressure");
  add(grew(before.stolen, after.stolen) > steal_share * seconds, "steal");
  add(workers_waited > preempted_share * seconds, "preempted");
  return flags;
}

NoiseJudge& noise_judge() {
  static NoiseJudge judge = &noise_flags;
  return judge;
}

MachineLoad MachineLoad::now(const std::filesystem::path& proc) {
  MachineLoad load;
  load.pressure = pressure_value(proc, "avg10=");
  std::ifstream stream(proc / "loadavg");
  double one = 0, five = 0, fifteen = 0;
  int running = 0;
  char slash = 0;
  if (stream >> one >> five >> fifteen >> running >> slash && slash == '/') load.running = running;
  return load;
}

std::string MachineLoad::objection() const {
  if (!pressure || !running) {
    return fmt::format("the load is unknown: {} cannot be read",
                       pressure ? "/proc/loadavg" : "/proc/pressure/cpu");
  }
  if (*pressure > busy_percent) {
    return fmt::format(
        "tasks waited for a processor for {:.1f} % of the last ten seconds "
        "(/proc/pressure/cpu); expected at most {:g} %",
        *pressure, busy_percent);
  }
  // This process is one of the running tasks.
  if (*running > 1) {
    return fmt::format("{} other task{} at work (/proc/loadavg); expected none", *running - 1,
                       *running == 2 ? " is" : "s are");
  }
  return "";
}

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
