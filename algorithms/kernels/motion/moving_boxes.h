// Whether two moving boxes meet: the exact test behind a search on swept boxes. Used by
// moving_pairs.
//
// Steps: 1. On each axis, the times at which the intervals overlap are an interval: two quotients of
//           differences of the boxes' numbers. The boxes meet if these intervals and [0, 1] have a time
//           in common.
//        2. Vectors of floats calculate them for several pairs at once, with a bound on the rounding.
//        3. What that leaves open is calculated in doubles, and then in expansions.
// Fails: never; the decision is exact.
#pragma once

#include <cstdint>
#include <span>

#include "algorithms/core/moving_box.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone {

// True where the closed boxes share a point at some time in [0, 1]. False when either is empty.
bool moving_boxes_meet(const MovingBox& a, const MovingBox& b);

// Appends those of the pairs whose boxes meet, in their order.
void keep_meeting(std::span<const MovingBox> bodies, std::span<const IndexPair> pairs,
                  PairBuffer& kept);

}  // namespace touchstone
