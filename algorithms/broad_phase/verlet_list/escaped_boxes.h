// Part of verlet-list: the boxes that have escaped from their grown ones since the list was made, and
// those that are new. The list does not tell their pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/bvh/implicit_rtree.h"

namespace touchstone {

class EscapedBoxes {
 public:
  // Forgets all, for a list of this many bodies that begins.
  void start(std::size_t bodies);
  // Adds those of this frame. `grown` has the list's boxes, indexed by body, and is lengthened for new
  // bodies. Returns false if there are so many, now or in the frames of the list, that a new list is
  // cheaper; then what is here is of no use until start().
  bool add(Executor& executor, const FrameChange& change, std::vector<Aabb>& grown);

  std::size_t size() const { return ids_.size(); }
  bool has(std::size_t body) const { return is_escaped_[body] != 0; }
  bool has_either(IndexPair pair) const { return (is_escaped_[pair.a] | is_escaped_[pair.b]) != 0; }
  // Writes pairs of the escaped boxes first <= i < last with boxes that have not escaped, which are
  // found in the tree over grown boxes, and with escaped boxes after them. `boxes` are this frame's.
  void search(const ImplicitRTree& tree, std::span<const Aabb> boxes, std::size_t first,
              std::size_t last, RTreeScratch& scratch, PairBuffer& out) const;

  std::size_t held_bytes() const;

 private:
  std::vector<std::uint8_t> is_escaped_;  // 1 for an escaped box; indexed by body
  std::vector<std::uint32_t> ids_;
  AabbSoA boxes_;                    // in the order of ids_
  std::size_t searched_ = 0;         // number of escaped boxes, summed over the frames of this list
  std::vector<std::size_t> counts_;  // one for each block
};

}  // namespace touchstone
