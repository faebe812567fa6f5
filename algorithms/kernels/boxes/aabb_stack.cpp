// The memory of an AabbStack, and the choice of the instruction level for its tests.
#include "algorithms/kernels/boxes/aabb_stack.h"

#include <algorithm>
#include <limits>

#include "algorithms/kernels/boxes/aabb_simd.h"

namespace touchstone {
namespace {

using aabb_simd::Columns;
using aabb_simd::columns_of;
using aabb_simd::first_lanes;
using aabb_simd::mutable_columns_of;
using aabb_simd::MutableColumns;

#define TOUCHSTONE_TARGET_NAMESPACE aabb_simd
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/boxes/aabb_stack.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

std::size_t append_to(AabbStack& list, const Aabb& bound, const Columns& from, IndexRange range) {
  const MutableColumns to = mutable_columns_of(list);
  switch (isa()) {
    case Isa::avx512: return avx512::append(bound, from, range, to, list.end());
    case Isa::avx2: return avx2::append(bound, from, range, to, list.end());
    default: return baseline::append(bound, from, range, to, list.end());
  }
}

}  // namespace

void AabbStack::reserve(std::size_t more) {
  // Vectors are written whole, and one more is cleared after them.
  const std::size_t needed = end_ + more + 2 * padding;
  if (ids_.size() >= needed) return;
  const std::size_t size = std::max(needed, 2 * ids_.size());
  for (std::vector<float>& side : sides_) side.resize(size);
  ids_.resize(size);
}

std::size_t AabbStack::start() {
  end_ = (end_ + padding - 1) / padding * padding;
  reserve(0);
  close();
  return end_;
}

// Fills the padding with boxes that overlap nothing; one axis suffices for that.
void AabbStack::close() {
  std::fill_n(sides_[0].begin() + static_cast<std::ptrdiff_t>(end_), padding,
              std::numeric_limits<float>::infinity());
}

void AabbStack::append(const Aabb& bound, const AabbSoA& from, IndexRange range) {
  reserve(range.last - range.first);
  end_ = append_to(*this, bound, columns_of(from), range);
  close();
}

void AabbStack::append(const Aabb& bound, IndexRange range) {
  reserve(range.last - range.first);
  end_ = append_to(*this, bound, columns_of(*this), range);
  close();
}

void pair_rows(const AabbSoA& boxes, IndexRange rows, std::size_t end, const AabbStack& list,
               IndexRange columns, PairBuffer& out) {
  const Columns own = columns_of(boxes);
  const Columns others = columns_of(list);
  switch (isa()) {
    case Isa::avx512: return avx512::pair(own, rows, end, others, columns, out);
    case Isa::avx2: return avx2::pair(own, rows, end, others, columns, out);
    case Isa::baseline: return baseline::pair(own, rows, end, others, columns, out);
  }
}

}  // namespace touchstone
