// Part of auto: looks at the costs of the two broad phases for worlds that nearly rest. See looks.h.
#include "algorithms/broad_phase/auto/looks.h"

#include <algorithm>

namespace touchstone {

// Returns the frames between looks with which these take little of the time.
std::uint32_t Looks::most_wait(double frame_cost) const {
  const double cost = 100 + 60 * static_cast<double>(passes_.noted());  // measured, nanoseconds
  return static_cast<std::uint32_t>(std::clamp(cost / (most_share * frame_cost), 16.0, 512.0));
}

void Looks::start() {
  until_ = wait_ = 1;
  looks_ = 0;
  is_noted_ = false;
  lost_ = 0;
}

bool Looks::look(const FrameChange& change, Candidate candidate, FrameCounts counts, Tally& tally) {
  until_ = 1;
  is_noted_ = !is_noted_;
  if (is_noted_) {
    if (looks_++ % looks_a_sample == 0) passes_.sample(change.boxes);
    passes_.note(change.boxes, change.moved);
    return false;
  }
  const double frames = wait_ + 1;
  until_ = wait_ = std::min(2 * wait_, most_wait_);
  counts.listings = tally.listings / frames;
  counts.selections = tally.selections / frames;
  counts.churning = tally.churning / frames;
  counts.churn = static_cast<double>(tally.churn) / frames;
  tally = {};
  const bool is_bvh = candidate == Candidate::dynamic_bvh;
  if (is_bvh && counts.bodies > most_bodies) return false;
  const auto motion = passes_.motion(change.boxes, static_cast<std::size_t>(counts.bodies));
  if (!motion) return false;
  counts.motion = *motion;

  const double bvh = dynamic_bvh_cost(counts);
  const double sap = sweep_and_prune_cost(counts);
  most_wait_ = most_wait(is_bvh ? bvh : sap);
  const double gain = is_bvh ? (1 - least_gain) * bvh - sap : (1 - least_gain) * sap - bvh;
  lost_ = std::max(lost_ + frames * gain, 0.0);
  const double build = is_bvh ? sweep_and_prune_build_cost(counts, passes_.overlapping())
                              : dynamic_bvh_build_cost(counts);
  if (lost_ <= patience_ * build) return false;
  start();
  patience_ = std::min(2 * patience_, most_patience);
  return true;
}

}  // namespace touchstone
