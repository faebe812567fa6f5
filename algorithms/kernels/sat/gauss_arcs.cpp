// Selects the instruction level for the arc test in gauss_arcs.inl.
#include "algorithms/kernels/sat/gauss_arcs.h"

#include <bit>
#include <cstring>
#include <limits>
#include <span>

#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

// Products of vectors with a few roundings each, under matrices that stretch by less than 4: a
// product below this may have either sign.
constexpr float uncertain = 256 * std::numeric_limits<float>::epsilon();

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/sat/gauss_arcs.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

void GaussArcs::add(const GaussArc& arc) {
  const std::size_t place = size_ % GaussBlock::size;
  if (place == 0) blocks_.emplace_back();
  const std::array<const Vec3<float>*, 3> vectors = {&arc.direction, &arc.left, &arc.right};
  for (std::size_t row = 0; row < 9; ++row) {
    blocks_.back().rows[row][place] = (*vectors[row / 3])[static_cast<int>(row % 3)];
  }
  ++size_;
}

void GaussArcs::list_crossing(const GaussArc& arc, std::vector<std::uint32_t>& crossing) const {
  switch (isa()) {
    case Isa::avx512: return avx512::list_crossing(blocks_, size_, arc, crossing);
    case Isa::avx2: return avx2::list_crossing(blocks_, size_, arc, crossing);
    case Isa::baseline: return baseline::list_crossing(blocks_, size_, arc, crossing);
  }
}

}  // namespace touchstone
