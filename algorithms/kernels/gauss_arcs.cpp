#include "algorithms/kernels/gauss_arcs.h"

#include <bit>
#include <cstring>
#include <limits>

#include "algorithms/kernels/real_lanes.h"

namespace touchstone {
namespace {

// Products of vectors that are off by a few roundings each, and whose matrices stretch by less than
// 4: those below may have either sign.
constexpr float uncertain = 256 * std::numeric_limits<float>::epsilon();

using Rows = std::array<std::array<float, 16>, 9>;

#define TOUCHSTONE_LANES real_lanes
#define TOUCHSTONE_LOOPS "algorithms/kernels/gauss_arcs.inl"
#include "algorithms/kernels/every_level.inl"

unsigned crossing(const Rows& rows, const GaussArc& arc) {
  switch (isa()) {
    case Isa::avx512: return avx512::crossing(rows, arc);
    case Isa::avx2: return avx2::crossing(rows, arc);
    default: return baseline::crossing(rows, arc);
  }
}

}  // namespace

void GaussArcs::add(const GaussArc& arc) {
  if (size_ % block == 0) blocks_.emplace_back();
  const std::array<const Vec3<float>*, 3> vectors = {&arc.direction, &arc.left, &arc.right};
  for (std::size_t row = 0; row < 9; ++row) {
    blocks_.back().rows[row][size_ % block] = (*vectors[row / 3])[static_cast<int>(row % 3)];
  }
  ++size_;
}

void GaussArcs::list_crossing(const GaussArc& arc,
                              std::vector<std::uint32_t>& crossing_arcs) const {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    unsigned open = crossing(blocks_[i].rows, arc);
    const std::size_t left = size_ - i * block;
    if (left < block) open &= (1u << left) - 1;
    for (; open != 0; open &= open - 1) {
      const std::size_t k = i * block + static_cast<std::size_t>(std::countr_zero(open));
      crossing_arcs.push_back(static_cast<std::uint32_t>(k));
    }
  }
}

}  // namespace touchstone
