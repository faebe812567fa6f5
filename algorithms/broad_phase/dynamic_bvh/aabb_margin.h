// How much larger than a body the box is that stands for it, so that it can move a few frames
// before anything has to be changed.
// Papers:  Catto, "Dynamic Bounding Volume Hierarchies", GDC 2019 (a margin); Presson's btDbvt in
//          Bullet, 2008 (a few frames of motion ahead).
// Departs: one margin for all, but at most a tenth of a body's longest side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "algorithms/broad_phase/dynamic_bvh/bvh16.h"
#include "algorithms/core/aabb.h"

namespace touchstone {

class AabbMargin {
 public:
  // The box with the margin on all sides.
  Aabb around(const Aabb& box) const;
  // False where a body has left its fat box.
  static bool holds(const Aabb& fat, const Aabb& box);

  // Sets the margin to several frames of what nine in ten of those that moved did, of those that a
  // margin can serve; how many it cannot, since they would leave it within four frames. The tree is
  // of the boxes before. From a sample.
  std::size_t measure(std::span<const Aabb> boxes, std::span<const std::uint32_t> moved,
                      const Bvh16& before);
  // After a margin has lasted this many frames for nearly all.
  void adapt(std::size_t frames);
  // Widens it where many of those that moved have left their fat boxes, which are in the tree.
  void widen(std::span<const Aabb> boxes, std::size_t moved, std::span<const std::uint32_t> leavers,
             const Bvh16& tree);

 private:
  float margin_ = 0;  // metres
};

}  // namespace touchstone
