// Bodies by size class, and within a class along a Hilbert curve: runs of them have small bounds.
// Papers: Kamel, Faloutsos, "On Packing R-trees", CIKM 1993 (Hilbert order); Vinkler, Bittner,
//         Havran, "Extended Morton Codes for High Performance Bounding Volume Hierarchy
//         Construction", HPG 2017 (the size is part of the code).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor.h"
#include "algorithms/kernels/box_arrays.h"
#include "algorithms/kernels/radix_sort.h"

namespace touchstone {

// Keeps its memory.
class CurveKeys {
 public:
  // Keys are smaller than 2^key_bits.
  static constexpr int key_bits = 34;

  // `ids`: of boxes that are not empty. Where many have one key, as in dense clusters and far away,
  // another curve is drawn through these alone.
  void sort(Executor& executor, std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);

  std::size_t size() const { return items_.size(); }
  std::uint32_t id(std::size_t place) const {
    return static_cast<std::uint32_t>(items_[place] & ((std::uint64_t{1} << id_bits_) - 1));
  }
  // Size class above, place on the curve below.
  std::uint64_t key(std::size_t place) const { return items_[place] >> id_bits_; }

  std::size_t held_bytes() const;

 private:
  // Powers of four that a float can have.
  static constexpr std::size_t magnitudes = 128;
  // A class of fewer goes into the next larger one, so that no run is of many sizes.
  static constexpr std::size_t least_members = 64;
  static constexpr std::size_t most_classes = 16;
  using ClassOf = std::array<std::uint8_t, magnitudes>;

  using Members = std::array<std::uint32_t, magnitudes>;  // how many bodies

  static std::size_t magnitude(const Aabb& box);
  static ClassOf make_classes(const Members& of_magnitude);
  Members count_members(Executor& executor, std::span<const Aabb> boxes,
                        std::span<const std::uint32_t> ids);
  void refine_crowds(std::span<const Aabb> boxes);
  void refine(std::span<const Aabb> boxes, std::size_t first, std::size_t last);

  std::vector<std::uint64_t> items_;  // key above, id below
  int id_bits_ = 0;
  RadixSort<std::uint64_t> radix_sort_;
  std::vector<Members> counts_;  // of the blocks
  std::vector<IndexRange> crowds_;
  std::vector<std::uint64_t> places_;  // of a crowd on its curve, with the ids
};

}  // namespace touchstone
