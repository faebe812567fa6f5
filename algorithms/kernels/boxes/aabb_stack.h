// A stack of lists of boxes, for searches that descend a tree and pass on, at each step, the boxes
// that overlap a bound. Used by kd-tree, loose-octree, sweep-and-prune and bvh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/aabb_soa.h"

namespace touchstone {

// Each list is padded to a multiple of 16 with boxes that overlap nothing, so that whole vectors
// can be tested. The stack keeps its memory.
class AabbStack {
 public:
  static constexpr std::size_t padding = AabbSoA::padding;

  // Starts a list on top of the others and returns its first place. The list ends at end() and
  // grows with each append.
  std::size_t start();
  // Removes the list that begins here, and those above it.
  void drop(std::size_t first) { end_ = first; }
  std::size_t end() const { return end_; }

  // Appends the boxes of a range that overlap the bound, in their order, from an array or from a
  // list of this stack.
  void append(const Aabb& bound, const AabbSoA& from, IndexRange range);
  void append(const Aabb& bound, IndexRange range);

  // Lets a caller write boxes itself: `reserve` makes room for `more` and a vector's width,
  // `advance` adds those written. The padding is then undefined.
  void reserve(std::size_t more);
  void advance(std::size_t written) { end_ += written; }

  const float* min(int axis) const { return sides_[static_cast<std::size_t>(axis)].data(); }
  const float* max(int axis) const { return sides_[static_cast<std::size_t>(axis) + 3].data(); }
  float* min(int axis) { return sides_[static_cast<std::size_t>(axis)].data(); }
  float* max(int axis) { return sides_[static_cast<std::size_t>(axis) + 3].data(); }
  const std::uint32_t* ids() const { return ids_.data(); }
  std::uint32_t* ids() { return ids_.data(); }

 private:
  void close();

  std::array<std::vector<float>, 6> sides_;
  std::vector<std::uint32_t> ids_;
  std::size_t end_ = 0;
};

// Writes the ids of each pair of boxes that overlap, one of them a row, the other in the list or
// after the row and before `end`. Pairs are sorted by row; a row's partners follow the order of the
// list and then of the rows.
void pair_rows(const AabbSoA& boxes, IndexRange rows, std::size_t end, const AabbStack& list,
               IndexRange columns, PairBuffer& out);

}  // namespace touchstone
