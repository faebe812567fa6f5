// The memory and the filling of an AabbSoA, and the choice of the instruction level for that.
#include "algorithms/kernels/boxes/aabb_soa.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "algorithms/kernels/boxes/aabb_simd.h"

namespace touchstone {
namespace {

using aabb_simd::MutableColumns;

#define TOUCHSTONE_TARGET_NAMESPACE aabb_simd
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/boxes/aabb_soa.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

void AabbSoA::set(std::size_t first, std::span<const Aabb> boxes,
                  std::span<const std::uint32_t> ids) {
  const MutableColumns to = aabb_simd::mutable_columns_of(*this);
  switch (isa()) {
    case Isa::avx512: return avx512::set_boxes(to, first, boxes, ids);
    case Isa::avx2: return avx2::set_boxes(to, first, boxes, ids);
    case Isa::baseline: return baseline::set_boxes(to, first, boxes, ids);
  }
}

void AabbSoA::resize(std::size_t count) {
  if (count + padding > stride_) {
    // The first size is exact; later ones leave room to grow.
    const std::size_t room = stride_ == 0 ? count : count + count / 2;
    stride_ = room / padding * padding + 2 * padding;
    extents_.reset(new (alignment) float[6 * stride_]);
    ids_ = std::make_unique_for_overwrite<std::uint32_t[]>(stride_);
  }
  size_ = count;
  for (std::size_t place = count; place < count + padding; ++place) set(place, Aabb::empty(), 0);
}

void AabbSoA::grow(std::size_t count) {
  if (count + padding > stride_) {
    AabbSoA more;
    more.resize(count);
    for (int axis = 0; axis < 3; ++axis) {
      std::copy_n(min(axis), size_, more.min(axis));
      std::copy_n(max(axis), size_, more.max(axis));
    }
    std::copy_n(ids(), size_, more.ids());
    *this = std::move(more);
  } else {
    resize(count);
  }
}

void list_bodies(Executor& executor, std::span<const Aabb> boxes, std::vector<std::uint32_t>& ids) {
  constexpr std::size_t block_size = 8192;
  const std::size_t count = boxes.size();
  const std::size_t blocks = block_count(count, block_size);
  // Each block lists its boxes from its own first place on, and stores their number after all of
  // them. The gaps are closed afterwards; mostly there are none.
  ids.resize(count + blocks);
  for_each_block(executor, count, block_size,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   std::size_t end = first;
                   for (std::size_t i = first; i < last; ++i) {
                     ids[end] = static_cast<std::uint32_t>(i);
                     end += boxes[i].is_empty() ? 0 : 1;
                   }
                   ids[count + block] = static_cast<std::uint32_t>(end - first);
                 });
  std::size_t end = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t first = block * block_size;
    const std::size_t listed = ids[count + block];
    if (first != end) std::copy_n(ids.begin() + first, listed, ids.begin() + end);
    end += listed;
  }
  ids.resize(end);
}

}  // namespace touchstone
