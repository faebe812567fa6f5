// Part of link-pairs: balls in sixteen configurations against boxes that stand still, and against other balls.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace touchstone {

// The number of configurations that are asked together.
inline constexpr std::size_t pose_lanes = 16;

// Where a ball is: a lane a configuration (metres).
struct LaneBall {
  alignas(64) std::array<float, pose_lanes> x, y, z;
};

// A box in the world.
struct LaneBox {
  std::array<float, 3> centre, half;
  std::array<float, 9> axes;  // of the box, one behind the other
  bool is_level;              // along the axes of the world
};

// A ball, and what it may meet.
struct LaneRow {
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  std::uint32_t ball, other;  // the other is a ball, or a box
  bool is_box;
  // Within the first distance they may meet, and within the second one they surely do (metres); the second is negative
  // if that is not known.
  float may, sure;
};

struct LaneHit {
  std::uint32_t row;
  std::uint32_t may, sure;  // a bit a lane
};

// Appends a hit for each row that may meet in some lane of `alive`. Lanes in which a row surely meets are not asked for
// further rows. Returns the lanes that are left.
std::uint32_t scan_rows(std::span<const LaneRow> rows, std::span<const LaneBall> balls,
                        std::span<const LaneBox> boxes, std::uint32_t alive,
                        std::vector<LaneHit>& hits);

}  // namespace touchstone
