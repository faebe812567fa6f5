// Noise: other work of the machine during a measurement, and the time in which this process waited
// for a processor.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace touchstone::measure {

// Counters of the system, ever growing; a counter that the system lacks is empty.
struct NoiseReading {
  std::optional<double> waited;  // seconds in which some task waited for a processor
  std::optional<double> stolen;  // seconds that the hypervisor gave to others, over all processors

  // `proc` is the folder of the counters.
  static NoiseReading now(const std::filesystem::path& proc = "/proc");
};

// Returns the flags of a round joined by '+'; the text is empty if the round was quiet or nothing
// is known. "pressure": some task of the machine waited for a processor for over half of the round
// (a program that only measures makes a tenth to a third itself, by waking its threads). "steal":
// over a hundredth was stolen. "preempted": the workers were ready for over a twentieth of it and
// had no processor.
std::string noise_flags(const NoiseReading& before, const NoiseReading& after, double seconds,
                        double workers_waited);

// The function that flags the rounds: noise_flags, or a substitute in a test.
using NoiseJudge = decltype(&noise_flags);
NoiseJudge& noise_judge();

// The share of the last ten seconds in which some task waited for a processor, in percent, and the
// number of tasks that run or wait to run now; a value that the system lacks is empty.
struct MachineLoad {
  std::optional<double> pressure;
  std::optional<int> running;

  static MachineLoad now(const std::filesystem::path& proc = "/proc");
  // The reason against the start of a measurement; empty if it may start, "unknown ..." if nothing
  // is known.
  std::string objection() const;
};

// Returns seconds, summed over the existing threads (proc(5), /proc/PID/schedstat); nothing if the
// system does not report it. Unlike the number of switches it measures the time lost.
std::optional<double> run_delay();

// Returns when this process has been at rest for a tenth of a millisecond, or after five: a thread
// of an executor looks for more work for a while before it sleeps, and would do so in the time of
// the next contestant.
void come_to_rest();

}  // namespace touchstone::measure
