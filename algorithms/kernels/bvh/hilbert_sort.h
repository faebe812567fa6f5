// Hilbert sort: an order of boxes in which neighbours are near each other and of similar size. Used
// by linear-bvh, packed-rtree, verlet-list and dynamic-bvh.
// Paper: Kamel, Faloutsos, "On Packing R-trees", CIKM 1993 (Hilbert order of the centres).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/bvh/size_classes.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {

// Boxes are sorted by size class, the smallest first, and within a class along a Hilbert curve
// through their centres. No box of a class is much larger than the space of 16 boxes of the class,
// so that the bounds of 16 stay small. In gather() each class begins at a multiple of 256 places.
// If many boxes are in one cell of the curve, a curve of their own orders them, so that a few boxes
// far away, or dense clusters, do not spoil the order.
class HilbertSort {
 public:
  // Sorts the boxes that are not empty.
  void make(Executor& executor, std::span<const Aabb> boxes);
  bool empty() const { return used_ == 0; }

  // Bodies, by their place in the order.
  std::size_t size() const { return used_ == 0 ? 0 : begins_[used_]; }
  std::uint32_t id(std::size_t i) const {
    return static_cast<std::uint32_t>(order_[i] & ((std::uint64_t{1} << id_bits_) - 1));
  }
  // The key: the class above the place on the curve; ascending, and smaller than 2^key_bits.
  static constexpr int key_bits = 35;
  std::uint64_t key(std::size_t i) const { return order_[i] >> id_bits_; }

  // The number of places that gather() fills.
  std::size_t places() const;
  // Writes the boxes and ids of the places first <= i < last; a free place gets an empty box with id
  // 0. `first` is a multiple of 256.
  void gather(std::span<const Aabb> boxes, std::size_t first, std::size_t last,
              AabbSoA& arrays) const;

  std::size_t held_bytes() const;

 private:
  void refine(std::span<const Aabb> boxes, std::size_t first, std::size_t last, int depth);
  void refine_runs(Executor& executor, std::span<const Aabb> boxes);

  std::vector<std::uint64_t> order_;  // class and place on the curve above, id below
  std::vector<std::uint64_t> spare_;  // scratch of refine, if a cell needs it
  int id_bits_ = 0;
  RadixSort<std::uint64_t> radix_sort_;
  std::vector<IndexRange> runs_;                             // ranges of boxes in one cell
  std::size_t used_ = 0;                                     // number of classes
  std::array<std::size_t, SizeClasses::most + 1> begins_{};  // first box of each class
};

}  // namespace touchstone
