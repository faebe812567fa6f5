// Part of link-pairs: balls in sixteen configurations against boxes that stand still, and against other balls.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/pose.h"

namespace touchstone {

// The number of configurations that are asked together.
inline constexpr std::size_t pose_lanes = 16;

// A lane a configuration.
using LaneNumbers = std::array<float, pose_lanes>;

// Where a ball is (metres).
struct LaneBall {
  alignas(64) LaneNumbers x, y, z;
};

// Where a link is: the rows of its rotation, each with the translation behind it.
struct LanePose {
  alignas(64) std::array<LaneNumbers, 12> rows;
};

// A box in the world.
struct LaneBox {
  std::array<float, 3> centre, half;
  std::array<float, 9> axes;  // of the box, one behind the other
  bool is_level;              // along the axes of the world
};

// A ball, and what it may meet.
struct LaneRow {
  std::uint32_t ball, other;  // the other is a ball, or a box
  // The rows to be asked where this one may meet; none if it is a pair of parts.
  std::uint32_t first = 0, last = 0;
  // The distance of the centre within which they meet (metres).
  float reach;
  bool is_box;
  // Whether they meet within it for certain, but for rounding.
  bool decides;
};

struct LaneHit {
  std::uint32_t row;
  std::uint32_t lanes;  // a bit a lane
};

// Of poses: the greatest orthonormal error, and the greatest absolute coordinate of a translation (metres).
struct PoseReach {
  double error, furthest;
};

// Writes poses[0], poses[stride], ..., of which there are `count`, 1 to 16, into a lane each; lanes behind them repeat the
// last. Numbers are finite; beyond the range of floats they become infinite.
PoseReach spread_poses(const Pose* poses, std::size_t stride, std::size_t count, LanePose& lanes);

// Where points of a link are: `centres` in its frame.
void place_balls(const LanePose& link, std::span<const std::array<float, 3>> centres,
                 std::span<LaneBall> balls);

// Appends a hit for each row from `first` to before `last` that may meet in some of the lanes, which it does within
// `slack` (metres) of its reach. Lanes in which a row surely meets are put into `sure`, and not asked for further rows.
// Returns the lanes that are left.
std::uint32_t scan_rows(std::span<const LaneRow> rows, std::uint32_t first, std::uint32_t last,
                        std::span<const LaneBall> balls, std::span<const LaneBox> boxes,
                        float slack, std::uint32_t lanes, std::vector<LaneHit>& hits,
                        std::vector<LaneHit>& sure);

}  // namespace touchstone
