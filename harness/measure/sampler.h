// The contract of everything that is measured: a sampler takes a request for a sample, and replies.
// Only its own calls to its algorithm are inside the clock.
#pragma once

#include <cstdint>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/outcome.h"
#include "harness/measure/durations.h"
#include "harness/measure/hardware_counters.h"

namespace touchstone::measure {

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
