// Part of auto: costs by counts. The factors of frames were fitted to times of six scenes of 1,000 to
// 30,000 boxes of which 0.1 to 3 % move, where they are off by a fifth in the mean, and those of
// listing pairs up to 100,000. Those of frames in which many move are of 1,000 and 10,000 boxes of
// which a tenth moves. Those of builds and of bodies that come and go are rough. The bodies that are
// asked about are taken to be those that moved.
#include "algorithms/broad_phase/auto/frame_costs.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

// Returns what each of these pairs costs. From some 25,000 on they are less and less in the cache,
// and in the end memory alone counts.
double pair_cost(double in_cache, double in_memory, double pairs) {
  return std::lerp(in_cache, in_memory,
                   std::clamp(std::log2(std::max(pairs, 1.0) / 25'000) / 3.3, 0.0, 1.0));
}

}  // namespace

// Each mover has its pairs tested, and leavers are put in and searched for anew.
double dynamic_bvh_cost(const FrameCounts& frame) {
  const double pairs_a_body = frame.pairs / std::max(frame.bodies, 1.0);
  const double update = 20 + frame.moved * (19 * pairs_a_body + 100 * frame.motion.leaving) +
                        80 * frame.changes + 300 * frame.churn;
  return update + frame.pairs * frame.listings * pair_cost(0.11, 0.2, frame.pairs) +
         frame.selections * frame.moved * (10 + 10 * pairs_a_body);
}

double sweep_and_prune_cost(const FrameCounts& frame) {
  const double moves = frame.moved * frame.motion.axes;
  // The more end points move, the less does the processor foresee how far each goes.
  const double unforeseen = std::log2(std::max(moves / 90, 1.0));
  double cost = 75 + moves * (8.6 + 8.4 * unforeseen) + 2.15 * frame.moved * frame.motion.passes;
  // Where bodies come or go, all end points and pairs are gone through, and all boxes for each.
  cost += frame.churning * (12 * frame.bodies + 3 * frame.pairs);
  cost += frame.churn / 16 * frame.bodies;
  // It goes through all pairs for those of some bodies.
  return cost + frame.pairs * (frame.listings * pair_cost(0.067, 0.2, frame.pairs) +
                               frame.selections * pair_cost(0.65, 1.5, frame.pairs));
}

double moving_cost(double pairs_a_body) { return 17 + 37 * pairs_a_body; }

double searching_cost(double pairs_a_body) { return 6.5 + 0.9 * pairs_a_body; }

double dynamic_bvh_build_cost(const FrameCounts& frame) {
  return 60 * frame.bodies + 25 * frame.pairs;
}

double sweep_and_prune_build_cost(const FrameCounts& frame, double overlapping) {
  return (100 + 0.1 * overlapping * frame.bodies) * frame.bodies;
}

}  // namespace touchstone
