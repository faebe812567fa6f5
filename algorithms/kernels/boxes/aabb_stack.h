// Lists of boxes that are picked out of others by a bound, one list behind the other, for searches
// that go down a tree and hand on at each step what can still matter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/aabb_soa.h"

namespace touchstone {

// A stack of lists. Behind each list, to a multiple of 16, lie boxes that overlap nothing, so that
// whole vectors can be tested. Keeps its memory.
class AabbStack {
 public:
  static constexpr std::size_t padding = AabbSoA::padding;

  // Starts a list on top of the others and gives the place where it begins; it ends at end(), and
  // grows by what is appended.
  std::size_t start();
  // Forgets the list that begins here, and those above it.
  void drop(std::size_t first) { end_ = first; }
  std::size_t end() const { return end_; }

  // Appends those of a range that overlap the bound, in their order. The second takes them from a
  // list of this stack.
  void append(const Aabb& bound, const AabbSoA& from, IndexRange range);
  void append(const Aabb& bound, IndexRange range);

  // For whoever writes boxes behind the last one: room for `more` and a vector's width; how many it
  // was. What lies behind is then undefined.
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
// behind the row and before `end`. By row; a row's partners in the order of the list and the rows.
void pair_rows(const AabbSoA& boxes, IndexRange rows, std::size_t end, const AabbStack& list,
               IndexRange columns, PairBuffer& out);

}  // namespace touchstone
