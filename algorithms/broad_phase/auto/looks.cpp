// Part of auto: looks at the costs of the two broad phases for worlds that nearly rest. See looks.h.
#include "algorithms/broad_phase/auto/looks.h"

#include <algorithm>

namespace touchstone {

void Looks::start() {
  until_ = wait_ = 1;
  looks_ = 0;
  is_noted_ = false;
  lost_ = 0;
}

bool Looks::look(const FrameChange& change, Candidate candidate, FrameCounts counts) {
  until_ = 1;
  is_noted_ = !is_noted_;
  if (is_noted_) {
    if (looks_++ % looks_a_sample == 0) passes_.sample(change.boxes);
    passes_.note(change.boxes, change.moved);
    return false;
  }
  const double frames = wait_ + 1;
  wait_ = std::min(2 * wait_, most_wait);
  until_ = wait_;
  const bool is_bvh = candidate == Candidate::dynamic_bvh;
  if (is_bvh && counts.bodies > most_bodies) return false;
  const auto motion = passes_.motion(change.boxes, static_cast<std::size_t>(counts.bodies));
  if (!motion) return false;
  counts.motion = *motion;

  const double bvh = dynamic_bvh_cost(counts);
  const double sap = incremental_sweep_and_prune_cost(counts);
  const double gain = is_bvh ? (1 - least_gain) * bvh - sap : (1 - least_gain) * sap - bvh;
  lost_ = std::max(lost_ + frames * gain, 0.0);
  const double build = is_bvh
                           ? incremental_sweep_and_prune_build_cost(counts, passes_.overlapping())
                           : dynamic_bvh_build_cost(counts);
  if (lost_ <= patience_ * build) return false;
  start();
  patience_ = std::min(2 * patience_, most_patience);
  return true;
}

}  // namespace touchstone
