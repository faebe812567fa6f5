// An order of boxes in which neighbours are near one another and of about one size.
// Paper: Kamel, Faloutsos, "On Packing R-trees", CIKM 1993 (Hilbert order of the centres).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {

// Classes of boxes by size, the smallest first: none is much larger than the space that 16 of its
// class take up, so that their bounds stay small; within a class
// the order of a Hilbert curve through the boxes' centres. Each class begins at a multiple of 256
// places. Where many boxes are in one cell of the curve, it is drawn anew through that cell, so
// that a few boxes far away, or dense clusters, do not spoil it.
class HilbertSort {
 public:
  static constexpr std::size_t most_classes = 16;

  // Empty boxes are left out.
  void make(Executor& executor, std::span<const Aabb> boxes);
  bool empty() const { return used_ == 0; }

  // Bodies, in their order.
  std::size_t size() const { return used_ == 0 ? 0 : begins_[used_]; }
  std::uint32_t id(std::size_t i) const {
    return static_cast<std::uint32_t>(order_[i] & ((std::uint64_t{1} << id_bits_) - 1));
  }
  // Class above, place on the curve below; ascending. Smaller than 2^key_bits.
  static constexpr int key_bits = 35;
  std::uint64_t key(std::size_t i) const { return order_[i] >> id_bits_; }

  // The boxes, with their ids, at their places; empty ones, with id 0, at those that are left free.
  void gather(Executor& executor, std::span<const Aabb> boxes, AabbSoA& arrays) const;

  std::size_t held_bytes() const;

 private:
  void refine(std::span<const Aabb> boxes, std::size_t first, std::size_t last, int depth);
  void refine_runs(Executor& executor, std::span<const Aabb> boxes);

  std::vector<std::uint64_t> order_;  // class and place on the curve above, id below
  int id_bits_ = 0;
  RadixSort<std::uint64_t> radix_sort_;
  std::vector<IndexRange> runs_;                        // of boxes in one cell
  std::size_t used_ = 0;                                // classes
  std::array<std::size_t, most_classes + 1> begins_{};  // of the classes, in the order
};

}  // namespace touchstone
