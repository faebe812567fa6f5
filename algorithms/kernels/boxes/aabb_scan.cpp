// Scans and sweeps of boxes: the choice of the instruction level, and their work.
#include "algorithms/kernels/boxes/aabb_scan.h"

#include <algorithm>

#include "algorithms/kernels/boxes/aabb_simd.h"

namespace touchstone {
namespace {

using aabb_simd::Columns;
using aabb_simd::columns_of;

struct Marks {
  const std::uint32_t* marks;
  const std::uint32_t* wants;
};

#define TOUCHSTONE_TARGET_NAMESPACE aabb_simd
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/boxes/aabb_scan.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

void scan_boxes(const AabbSoA& boxes, IndexRange rows, std::span<const IndexRange> columns,
                PairBuffer& out) {
  switch (isa()) {
    case Isa::avx512: return avx512::scan(columns_of(boxes), rows, columns, out);
    case Isa::avx2: return avx2::scan(columns_of(boxes), rows, columns, out);
    case Isa::baseline: return baseline::scan(columns_of(boxes), rows, columns, out);
  }
}

void scan_marked_boxes(const AabbSoA& boxes, std::span<const std::uint32_t> marks,
                       std::span<const std::uint32_t> wants, IndexRange rows, IndexRange columns,
                       PairBuffer& out) {
  const Marks m{marks.data(), wants.data()};
  switch (isa()) {
    case Isa::avx512: return avx512::scan_marked(columns_of(boxes), m, rows, columns, out);
    case Isa::avx2: return avx2::scan_marked(columns_of(boxes), m, rows, columns, out);
    case Isa::baseline: return baseline::scan_marked(columns_of(boxes), m, rows, columns, out);
  }
}

void sweep_boxes(const AabbSoA& boxes, int axis, IndexRange rows, PairBuffer& out) {
  switch (isa()) {
    case Isa::avx512: return avx512::sweep(columns_of(boxes), axis, rows, out);
    case Isa::avx2: return avx2::sweep(columns_of(boxes), axis, rows, out);
    case Isa::baseline: return baseline::sweep(columns_of(boxes), axis, rows, out);
  }
}

void sweep_marked_boxes(const AabbSoA& boxes, std::span<const std::uint32_t> marks,
                        std::span<const std::uint32_t> wants, int axis, IndexRange rows,
                        std::size_t end, PairBuffer& out) {
  const Marks m{marks.data(), wants.data()};
  switch (isa()) {
    case Isa::avx512: return avx512::sweep_marked(columns_of(boxes), m, axis, rows, end, out);
    case Isa::avx2: return avx2::sweep_marked(columns_of(boxes), m, axis, rows, end, out);
    case Isa::baseline: return baseline::sweep_marked(columns_of(boxes), m, axis, rows, end, out);
  }
}

std::size_t pairs_of_scan(IndexRange rows, IndexRange columns) {
  const std::size_t first = std::max(rows.first, columns.first);
  const std::size_t last = std::max(first, std::min(rows.last, columns.last));
  const std::size_t within = last - first;  // number of rows inside the range of columns
  const std::size_t outside = rows.last - rows.first - within;
  // Row i within is tested against columns.last - 1 - i.
  const std::size_t behind = within * (columns.last - 1 - first) - within * (within - 1) / 2;
  return outside * (columns.last - columns.first) + behind;
}

BroadPhaseWork work_of_sweep(const AabbSoA& boxes, int axis, IndexRange rows, std::size_t last) {
  const std::span min(boxes.min(axis), last);
  std::size_t candidates = 0;
  std::size_t ended = 0;
  for (std::size_t row = rows.first; row < rows.last; ++row) {
    const auto behind = min.subspan(row + 1);
    const auto end = std::ranges::upper_bound(behind, boxes.max(axis)[row]);
    candidates += static_cast<std::size_t>(end - behind.begin());
    ended += end != behind.end() ? 1 : 0;
  }
  return {.box_tests = static_cast<std::int64_t>(candidates + ended),
          .node_visits = 0,
          .candidates = static_cast<std::int64_t>(candidates)};
}

}  // namespace touchstone
