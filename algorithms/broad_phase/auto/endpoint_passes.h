// Part of auto: an estimate of how many end points pass each other in a frame, which is what
// sweep and prune pays for, and of how bodies move otherwise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/broad_phase/auto/frame_costs.h"
#include "algorithms/core/aabb.h"

namespace touchstone {

// The end points are those of a sample of the boxes, and the motion is that of a few of the bodies
// that move. Neither depends on how many there are.
class EndpointPasses {
 public:
  // Takes the places of end points from these boxes; those of before are forgotten.
  void sample(std::span<const Aabb> boxes);
  // The pairs of boxes that overlap on the axis where the fewest do, as a share of all pairs.
  double overlapping() const { return overlapping_; }

  // Notes the boxes of some of the bodies that move.
  void note(std::span<const Aabb> boxes, std::span<const std::uint32_t> moved);
  std::size_t noted() const { return noted_.size(); }
  // Returns how the noted bodies have moved since then among `bodies` bodies; nothing if none has.
  std::optional<MoverMotion> motion(std::span<const Aabb> boxes, std::size_t bodies) const;

  std::size_t held_bytes() const;

 private:
  static constexpr std::size_t most_sampled = 128, most_noted = 16;
  static constexpr std::size_t pieces = 32;  // of the distribution on an axis, with equal shares
  struct Noted {
    std::uint32_t id;
    Aabb box;
  };

  double share_below(std::size_t axis, float x) const;

  std::array<std::array<float, pieces + 1>, 3> quantiles_{};
  double overlapping_ = 1;
  std::vector<float> points_;  // scratch
  std::vector<Noted> noted_;
};

}  // namespace touchstone
