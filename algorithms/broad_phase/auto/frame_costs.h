// Part of auto: the broad phases that it takes, and what a frame costs the two that suit worlds in
// which few bodies move.
#pragma once

#include <cstdint>

namespace touchstone {

enum class Candidate : std::uint8_t { verlet_list, dynamic_bvh, sweep_and_prune };

// How a body moves in a frame, in the mean over those that do.
struct MoverMotion {
  double axes = 0;    // on which it moves, of three
  double passes = 0;  // end points that its own pass, on all axes
  // The share of frames in which it leaves a box that exceeds its own by a tenth of the longest
  // side, at least that of a box which serves for eight frames.
  double leaving = 0;
};

struct FrameCounts {
  double bodies = 0;
  double moved = 0;
  double pairs = 0;    // of all bodies, or an estimate
  double changes = 0;  // pairs that began and ended, if these are asked for
  // In the mean over some frames: how often all pairs are asked for, and those of some bodies; how
  // many bodies come or go, and the share of the frames in which any does.
  double listings = 0, selections = 0;
  double churn = 0, churning = 0;
  MoverMotion motion;
};

// Returns what a frame costs, and what a build does, in nanoseconds of the machine on which they
// were measured: elsewhere ratios and differences have a meaning, the numbers have none.
double dynamic_bvh_cost(const FrameCounts& frame);
double sweep_and_prune_cost(const FrameCounts& frame);
// What a body that moves costs the dynamic BVH where many do and all pairs are asked for, and what
// each body costs the packed R-tree, in nanoseconds of the same machine.
double moving_cost(double pairs_a_body);
double searching_cost(double pairs_a_body);
double dynamic_bvh_build_cost(const FrameCounts& frame);
// `overlapping` is the share of all pairs of boxes that overlap on the axis of the sweep.
double sweep_and_prune_build_cost(const FrameCounts& frame, double overlapping);

}  // namespace touchstone
