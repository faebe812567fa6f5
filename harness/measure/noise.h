// Other work of the machine while something was timed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace touchstone::measure {

// Counters of the system, ever growing; empty where the system does not tell.
struct NoiseReading {
  std::optional<double> waited;  // seconds in which some task waited for a processor
  std::optional<double> stolen;  // seconds that the hypervisor gave to others, over all processors

  // `proc` is where the system tells.
  static NoiseReading now(const std::filesystem::path& proc = "/proc");
};

// Flags of a round joined by '+', empty where it was quiet or nothing is known: "pressure" where
// some task of the machine waited for a processor for over half of it (a program that does nothing
// but measure makes a tenth to a third itself, by waking its threads), "steal" where over a
// hundredth was stolen, "preempted" where the workers were ready for over a twentieth of it and had
// no processor.
std::string noise_flags(const NoiseReading& before, const NoiseReading& after, double seconds,
                        double workers_waited);

// The function that flags the rounds: noise_flags, unless a test put another in its place.
using NoiseJudge = decltype(&noise_flags);
NoiseJudge& noise_judge();

// The share of the last ten seconds in which some task waited for a processor, in percent, and how
// many tasks run or wait to run now; empty where the system does not tell.
struct MachineLoad {
  std::optional<double> pressure;
  std::optional<int> running;

  static MachineLoad now(const std::filesystem::path& proc = "/proc");
  // Why no measurement should begin; empty where it may, "unknown ..." where nothing is known.
  std::string objection() const;
};

}  // namespace touchstone::measure
