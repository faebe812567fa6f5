// Boxes of parts of a placed body, as mid-phases compare them.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/mesh/common_frame.h"

namespace touchstone {

// The greatest magnitude of a coordinate of the boxes (metres), apart from infinite ones.
inline double reach_of(std::span<const Aabb> boxes) {
  float reach = 0;
  for (const Aabb& box : boxes) {
    if (box.is_empty()) continue;
    for (const auto& corner : {box.min, box.max}) {
      for (const float x : corner) {
        if (std::isfinite(x)) reach = std::max(reach, std::abs(x));
      }
    }
  }
  return reach;
}

// The boxes of a body's parts in its own frame, as they are.
struct PartBoxes {
  std::vector<Aabb> boxes;
  double reach = 0;  // that of the boxes (metres)

  explicit PartBoxes(std::span<const Aabb> parts) { refit(parts); }
  void refit(std::span<const Aabb> parts) {
    boxes.assign(parts.begin(), parts.end());
    reach = reach_of(parts);
  }
};

// The box along the frame's axes around a turned box. That of a boundless box is not finite.
struct PlacedBox {
  Vec3d centre, half;

  PlacedBox() = default;
  PlacedBox(const Aabb& box, const Pose& pose) {
    const Vec3d low(box.min[0], box.min[1], box.min[2]), high(box.max[0], box.max[1], box.max[2]);
    centre = pose((low + high) / 2);
    half = pose.rotation.cwiseAbs() * ((high - low) / 2);
  }
};

// False unless a gap of more than `slack` metres is along some axis. NaN, of boundless boxes, is no
// gap.
inline bool are_apart(const PlacedBox& a, const PlacedBox& b, double slack) {
  const Vec3d gap = (a.centre - b.centre).cwiseAbs() - a.half - b.half;
  return gap[0] > slack || gap[1] > slack || gap[2] > slack;
}

// A slack that covers the rounding of are_apart: centres and half extents are off as mapped points
// are, and their sums by little more.
inline double box_slack(const CommonFrame& frame, double reach_a, double reach_b) {
  return 8 * frame.error + 0x1p-50 * (reach_a + reach_b);
}

}  // namespace touchstone
