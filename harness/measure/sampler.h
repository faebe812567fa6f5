// The contract of everything that is measured: a sampler takes a request for a sample, and replies.
// Only its own calls to its algorithm are inside the clock.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/outcome.h"
#include "harness/measure/hardware_counters.h"

namespace touchstone::measure {

// Plain bytes without pointers, so that a worker process can send it.
class Durations {
 public:
  static constexpr std::size_t most = 6;           // names
  static constexpr std::size_t longest_name = 15;  // characters

  class Duration {
   public:
    double seconds = 0;
    std::string_view name() const { return name_.data(); }

   private:
    friend class Durations;
    std::array<char, longest_name + 1> name_{};
  };

  // Adds to the duration of that name, which begins at 0. Throws std::length_error if a name is too
  // long, or there are too many of them.
  void add(std::string_view name, double seconds);
  // Returns NaN if there is no duration of that name.
  double of(std::string_view name) const;
  double sum() const;
  // The durations in the order in which their names were added.
  std::span<const Duration> all() const { return {durations_.data(), count_}; }

 private:
  std::array<Duration, most> durations_{};
  std::size_t count_ = 0;
};

// A window of frames. The request names one of a sampler's inputs.
struct SampleRequest {
  std::uint32_t set = 0;    // number of the input
  std::uint32_t frame = 0;  // the first frame
  // the number of frames; the window continues from the scene's last frame to its first
  std::uint32_t frames = 1;
  bool hashed = false;       // if true, the pairs of a broad phase are hashed, between its frames
  bool skips_first = false;  // if true, the window continues at frame 1 instead of frame 0
};

// Sums over the window. A count that is missing is -1, and a number that is not known is NaN.
struct SampleReply {
  Durations durations;                 // the timed parts, in the order in which they ran
  double worst_frame = Outcome::none;  // seconds of a broad phase's longest frame
  std::int64_t pairs = 0;
  std::uint64_t pair_hash = 0;
  std::int64_t contacts = -1;
  std::uint64_t outcome_hash = 0;
  std::int64_t part_pairs = -1;  // pairs of parts in contact, if the task is to find all
  std::int64_t iterations = -1, support_calls = -1;
  BroadPhaseWork work;         // work of a frame that was `hashed`, because counting takes time
  Status status = Status::ok;  // the last status of a broad phase that was not ok
  // The worker fills in the following members.
  std::int64_t peak_kb = -1, minor_faults = -1;
  std::int64_t voluntary_switches = -1, involuntary_switches = -1;
  double waited = Outcome::none;  // seconds in which its threads were ready and had no processor
  HardwareCounts hardware;
};

class Sampler {
 public:
  virtual ~Sampler() = default;
  virtual SampleReply sample(const SampleRequest& request) = 0;
};

}  // namespace touchstone::measure
