// Part of kd-tree: the bodies in the order of the nodes, and the split of a node.
// Paper:   Serpa, Rodrigues, "Flexible Use of Temporal and Spatial Reasoning for Fast and Scalable
//          CPU Broad-Phase Collision Detection Using KD-Trees", Computer Graphics Forum 2019.
// Departs: bodies are split by their centres, and only those that are large for a node stay at it.
//          The plane is the middle of the cell, on its longest axis relative to the bodies' mean
//          size. If that is far from halving the bodies, it is the middle of their tight cell; if
//          that is too, their median.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"

namespace touchstone {

struct alignas(16) KdBody {
  std::array<float, 3> min;
  std::uint32_t id;
  std::array<float, 3> max;
  std::uint32_t unused = 0;

  float centre(std::size_t axis) const { return 0.5f * min[axis] + 0.5f * max[axis]; }
  float size(std::size_t axis) const { return max[axis] - min[axis]; }
};

// Bounds of the centres of some bodies, and of their sizes; both may be too large.
struct KdRange {
  static constexpr float inf = std::numeric_limits<float>::infinity();
  std::array<float, 3> low{inf, inf, inf}, high{-inf, -inf, -inf}, size{};
  std::array<double, 3> sum_of_sizes{};

  void add(const KdBody& b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], b.centre(axis));
      high[axis] = std::max(high[axis], b.centre(axis));
      size[axis] = std::max(size[axis], b.size(axis));
    }
  }
  double extent(std::size_t axis) const { return double{high[axis]} - low[axis]; }
};

// A range of bodies that are yet to be split, by their places.
struct KdPart {
  std::uint32_t first = 0, last = 0;
  KdRange range;
};

// A split node: its own bodies come first, then those of the children.
struct KdSplit {
  std::uint32_t own_end = 0;
  std::array<KdPart, 2> children;  // empty in a leaf
  bool is_leaf() const { return children[1].last == 0; }
};

class KdBodies {
 public:
  // Takes the boxes of these bodies and returns them as one part.
  KdPart start(Executor& executor, std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);
  // Sorts the bodies of a part into its halves. Disjoint parts may be split concurrently.
  KdSplit split(const KdPart& part);
  // Replaces the boxes of the same bodies.
  void update(Executor& executor, std::span<const Aabb> boxes);

  std::size_t size() const { return bodies_.size(); }
  const KdBody& operator[](std::size_t place) const { return bodies_[place]; }
  std::size_t held_bytes() const;

 private:
  static constexpr std::size_t block_size = 8192;
  static constexpr std::uint32_t leaf_size = 32;
  static constexpr std::uint32_t least_members = 4;  // least number of bodies in a node

  static KdBody body(std::span<const Aabb> boxes, std::uint32_t id) {
    return {boxes[id].min, id, boxes[id].max};
  }
  std::size_t longest(const KdRange& range) const;
  std::uint32_t keep(std::uint32_t first, std::uint32_t last, std::size_t axis, double limit,
                     KdRange& range);
  template <class Condition>
  std::uint32_t divide(std::uint32_t first, std::uint32_t last, const Condition& holds);

  std::vector<KdBody> bodies_;
  std::vector<KdRange> ranges_;     // one for each block
  std::array<double, 3> weight_{};  // factor of an extent on each axis
};

}  // namespace touchstone
