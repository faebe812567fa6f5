// Part of gjk-ray-cast-lanes: what a lane found of a pair that moves without turning.
#pragma once

#include <cstdint>

#include "algorithms/core/vec.h"

namespace touchstone {

// What loading a pair into a lane told.
enum class LaneLoad : std::uint8_t {
  loaded,
  miss,     // balls around the bodies stay apart
  refused,  // the numbers are beyond the proof of the lanes
};

// The pair is undecided unless `is_miss` or `is_hit` is set. A hit has a bracket; at time 0 it is one whether or not
// the bodies approach.
struct LaneTimes {
  bool is_miss = false, is_hit = false;
  double lower = 0, upper = 0;
  Vec3d normal = Vec3d::Zero();  // from a to b, of any length; zero if it is not known
  Vec3d on_a = Vec3d::Zero();    // from a's centre to where they touch; NaN if it is not known
  int iterations = 0;
};

}  // namespace touchstone
