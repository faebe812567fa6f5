// Part of verlet-list: how far boxes move in a frame, and boxes grown by their motion.
#pragma once

#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/kernels/boxes/aabb_soa.h"

namespace touchstone {

struct MeanMotion {
  float step = 0;    // mean displacement of a body on an axis, metres a frame
  double share = 0;  // mean of step / (side + step)
};

// Returns the mean motion from the boxes of `age` frames ago to those of now, both indexed by body,
// estimated from a sample.
MeanMotion mean_motion(std::span<const Aabb> then, std::span<const Aabb> now, int age);
// The same from the boxes of one frame ago, in any order with their bodies' ids.
MeanMotion mean_motion(const AabbSoA& then, std::span<const Aabb> now);

// Turns `reference`, the boxes of `age` frames ago, into the boxes of now grown by their motion in
// this many frames. Each grows by at least half of the mean displacement in these frames, or half of
// the mean share of its longest side, whichever is less; and by no more if its own motion would be
// beyond that side.
void grow_boxes(Executor& executor, std::span<const Aabb> now, std::vector<Aabb>& reference,
                int age, double frames, const MeanMotion& mean);

}  // namespace touchstone
