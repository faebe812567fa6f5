// Boxes as a structure of arrays, for vector code. Used by all our broad phases.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/executor/parallel_blocks.h"

namespace touchstone {

// The places first <= i < last of an array.
struct IndexRange {
  std::size_t first, last;
};

// Boxes with their ids, followed by a vector's width of empty boxes. Keeps its memory.
class AabbSoA {
 public:
  static constexpr std::size_t padding = 16;  // number of floats in the widest vector

  // Makes room for `count` boxes; their contents are undefined.
  void resize(std::size_t count);
  // Makes room for `count` boxes, keeps the present ones, and reserves no more than it needs.
  void grow(std::size_t count);
  std::size_t size() const { return size_; }
  std::size_t held_bytes() const { return stride_ * (6 * sizeof(float) + sizeof(std::uint32_t)); }

  float* min(int axis) { return extents_.get() + static_cast<std::size_t>(axis) * stride_; }
  float* max(int axis) { return min(axis + 3); }
  std::uint32_t* ids() { return ids_.get(); }
  const float* min(int axis) const {
    return extents_.get() + static_cast<std::size_t>(axis) * stride_;
  }
  const float* max(int axis) const { return min(axis + 3); }
  const std::uint32_t* ids() const { return ids_.get(); }

  Aabb box(std::size_t place) const {
    return {{min(0)[place], min(1)[place], min(2)[place]},
            {max(0)[place], max(1)[place], max(2)[place]}};
  }
  void set(std::size_t place, const Aabb& box, std::uint32_t id) {
    for (int axis = 0; axis < 3; ++axis) {
      min(axis)[place] = box.min[static_cast<std::size_t>(axis)];
      max(axis)[place] = box.max[static_cast<std::size_t>(axis)];
    }
    ids_[place] = id;
  }
  // Sets the places from `first` on to boxes[ids[i]].
  void set(std::size_t first, std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);
  // Sets place i to boxes[id(i)], for each i < count.
  template <class Id>
  void gather(Executor& executor, std::span<const Aabb> boxes, std::size_t count, const Id& id) {
    resize(count);
    for_each_block(executor, count, 2048, [&](std::size_t, std::size_t first, std::size_t last) {
      std::array<std::uint32_t, 2048> ids;
      for (std::size_t i = first; i < last; ++i) ids[i - first] = id(i);
      set(first, boxes, std::span(ids).first(last - first));
    });
  }

 private:
  static constexpr std::align_val_t alignment{padding * sizeof(float)};
  struct Deleter {
    void operator()(float* extents) const { operator delete[](extents, alignment); }
  };

  std::unique_ptr<float[], Deleter> extents_;  // min x, y, z, max x, y, z, `stride_` each
  std::unique_ptr<std::uint32_t[]> ids_;
  std::size_t size_ = 0;
  std::size_t stride_ = 0;  // a multiple of the padding, so that each array is aligned
};

// Writes the ids of the boxes that are not empty to `ids`, ascending.
void list_bodies(Executor& executor, std::span<const Aabb> boxes, std::vector<std::uint32_t>& ids);

}  // namespace touchstone
