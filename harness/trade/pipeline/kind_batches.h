// Pairs of parts, sorted into batches of one kind of shapes, each with the pair of bodies that it
// is for.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/narrow_phase.h"

namespace touchstone {

// Keeps its memory from frame to frame.
class KindBatches {
 public:
  struct Batch {
    ShapeKind kind_a = ShapeKind::sphere, kind_b = ShapeKind::sphere;
    std::vector<std::uint32_t> first, second;  // parts; first[i] has kind_a
    std::vector<std::uint32_t> owner;          // the pair of bodies
    std::size_t size() const { return first.size(); }
  };

  void clear() {
    for (Batch& batch : batches_) {
      batch.first.clear();
      batch.second.clear();
      batch.owner.clear();
    }
  }
  void add(std::uint32_t part_a, ShapeKind kind_a, std::uint32_t part_b, ShapeKind kind_b,
           std::uint32_t owner) {
    if (kind_a > kind_b) {
      std::swap(part_a, part_b);
      std::swap(kind_a, kind_b);
    }
    Batch& batch = batches_[index(kind_a, kind_b)];
    batch.kind_a = kind_a;
    batch.kind_b = kind_b;
    batch.first.push_back(part_a);
    batch.second.push_back(part_b);
    batch.owner.push_back(owner);
  }
  static constexpr std::size_t kinds = all_shape_kinds.size();
  static std::size_t index(ShapeKind a, ShapeKind b) {
    return static_cast<std::size_t>(a) * kinds + static_cast<std::size_t>(b);
  }
  // By `index`; many are empty.
  std::span<const Batch> batches() const { return batches_; }

 private:
  std::array<Batch, kinds * kinds> batches_;
};

}  // namespace touchstone
