// Part of verlet-list: how far boxes move in a frame, and boxes grown by their motion.
#pragma once

#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"

namespace touchstone {

struct MeanMotion {
  float step = 0;    // mean displacement of a body on an axis, metres a frame
  double share = 0;  // mean of step / (side + step)
};

// Returns the mean motion from the boxes of `age` frames ago to those of now, both indexed by body,
// estimated from a sample.
MeanMotion mean_motion(std::span<const Aabb> then, std::span<const Aabb> now, int age);

// Turns `reference`, the boxes of `age` frames ago, into the boxes of now grown by their motion in
// this many frames. Each grows by at least half of the mean displacement `mean_step` a frame.
void grow_boxes(Executor& executor, std::span<const Aabb> now, std::vector<Aabb>& reference,
                int age, double frames, float mean_step);

}  // namespace touchstone
