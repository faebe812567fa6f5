// Part of auto: while few bodies move, when to take a look at what the dynamic BVH costs and what
// sweep and prune does, and when the other one is to take over.
// Paper:   Karlin, Manasse, Rudolph, Sleator, "Competitive Snoopy Caching", Algorithmica 3, 1988
//          (change over when as much has been lost as the change costs).
// Departs: at first a thirty-second of the cost suffices; it doubles with each change.
#pragma once

#include <cstdint>

#include "algorithms/broad_phase.h"
#include "algorithms/broad_phase/auto/endpoint_passes.h"
#include "algorithms/broad_phase/auto/frame_costs.h"

namespace touchstone {

// What was counted since the last look.
struct Tally {
  std::uint32_t listings = 0, selections = 0;  // questions for all pairs, and for those of some
  std::uint32_t churning = 0;                  // frames in which bodies came or went
  std::size_t churn = 0;                       // such bodies
};

// A look takes two frames, from one of which to the other it sees how far bodies move. Looks are
// spaced out until they take less than a hundredth of the time; a frame without one is taken to be
// like that of the next look.
class Looks {
 public:
  // Starts anew, with frequent looks; nothing has been lost yet.
  void start();
  // Counts a frame; true if it has a look.
  bool is_due() { return --until_ == 0; }
  // Returns true if the other of the two is to take over with this frame. Of its counts, bodies,
  // moved, pairs and changes are given. Clears the tally when it has used it.
  bool look(const FrameChange& change, Candidate candidate, FrameCounts counts, Tally& tally);

  std::size_t held_bytes() const { return passes_.held_bytes(); }

 private:
  static constexpr std::uint32_t looks_a_sample = 256;  // looks
  static constexpr double most_share = 1.0 / 128;       // of the time that looks take
  static constexpr double most_bodies = 100'000;        // for which the costs were measured
  static constexpr double least_gain = 0.05;            // that counts, as a share of the cost
  // Parts of a build that may be lost before a change: at first few, since a world is taken to stay
  // as it is for many times as long as it has; in the end what makes it competitive.
  static constexpr double least_patience = 1.0 / 32, most_patience = 2;

  std::uint32_t most_wait(double frame_cost) const;

  EndpointPasses passes_;
  std::uint32_t until_ = 1, wait_ = 1, most_wait_ = 64;  // frames
  std::uint32_t looks_ = 0;
  bool is_noted_ = false;  // the first half of a look has been taken
  double lost_ = 0;        // nanoseconds, since the last change
  double patience_ = least_patience;
};

}  // namespace touchstone
