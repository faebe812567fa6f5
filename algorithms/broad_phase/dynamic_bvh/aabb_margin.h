// Part of dynamic-bvh: the AABB margin, by which a fat box exceeds its body's box, so that a body
// can move for a few frames before anything changes.
// Papers:  Catto, "Dynamic Bounding Volume Hierarchies", GDC 2019 (a margin); Presson's btDbvt in
//          Bullet, 2008 (a few frames of motion ahead).
// Departs: one margin serves all bodies, but it is at most a tenth of a body's longest side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "algorithms/broad_phase/dynamic_bvh/bvh16.h"
#include "algorithms/core/aabb.h"

namespace touchstone {

class AabbMargin {
 public:
  // Returns the box with the margin on all sides.
  Aabb around(const Aabb& box) const;

  // Sets the margin to several frames of motion of nine in ten of the moved bodies that a margin
  // can serve. Returns the number of moved bodies that it cannot serve, because they would leave it
  // within four frames. `before` holds the boxes of the last frame. Both numbers are estimates from
  // a sample.
  std::size_t measure(std::span<const Aabb> boxes, std::span<const std::uint32_t> moved,
                      const Bvh16& before);
  // Adapts the margin after it has lasted this many frames for nearly all bodies.
  void adapt(std::size_t frames);
  // Widens the margin if many of the moved bodies have left their fat boxes, which are in the tree.
  void widen(std::span<const Aabb> boxes, std::size_t moved, std::span<const std::uint32_t> leavers,
             const Bvh16& tree);

 private:
  float margin_ = 0;  // metres
};

}  // namespace touchstone
