#include "algorithms/kernels/boxes/aabb_stack.h"

#include <algorithm>
#include <limits>

#include "algorithms/kernels/boxes/aabb_lanes.h"

namespace touchstone {
namespace {

using box_lanes::Columns;
using box_lanes::columns_of;

struct Places {
  float* min[3];
  float* max[3];
  std::uint32_t* ids;
};

Columns columns_of_list(const AabbStack& list) {
  return {
      {list.min(0), list.min(1), list.min(2)}, {list.max(0), list.max(1), list.max(2)}, list.ids()};
}
Places places_of(AabbStack& list) {
  return {
      {list.min(0), list.min(1), list.min(2)}, {list.max(0), list.max(1), list.max(2)}, list.ids()};
}

#define TOUCHSTONE_LOOPS "algorithms/kernels/boxes/aabb_stack.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

std::size_t append_to(AabbStack& list, const Aabb& bound, const Columns& from, IndexRange range) {
  switch (isa()) {
    case Isa::avx512: return avx512::append(bound, from, range, places_of(list), list.end());
    case Isa::avx2: return avx2::append(bound, from, range, places_of(list), list.end());
    case Isa::baseline: return baseline::append(bound, from, range, places_of(list), list.end());
  }
  return list.end();
}

}  // namespace

void AabbStack::reserve(std::size_t more) {
  // Whole vectors are written, and one more behind them is closed.
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

// One axis keeps a box from overlapping.
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
  end_ = append_to(*this, bound, columns_of_list(*this), range);
  close();
}

void pair_rows(const AabbSoA& boxes, IndexRange rows, std::size_t end, const AabbStack& list,
               IndexRange columns, PairBuffer& out) {
  const Columns own = columns_of(boxes);
  const Columns others = columns_of_list(list);
  switch (isa()) {
    case Isa::avx512: return avx512::pair(own, rows, end, others, columns, out);
    case Isa::avx2: return avx2::pair(own, rows, end, others, columns, out);
    case Isa::baseline: return baseline::pair(own, rows, end, others, columns, out);
  }
}

}  // namespace touchstone
