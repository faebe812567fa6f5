// Places along a Hilbert curve: the grid, and the choice of the instruction level.
#include "algorithms/kernels/bvh/hilbert.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>

#include "algorithms/kernels/boxes/aabb_simd.h"

namespace touchstone {
namespace {

constexpr std::size_t boxes_at_once = 64;

// The numbering of cells; axes with more than one cell come first.
struct Numbering {
  int axes, bits;
  std::array<std::size_t, 3> axis;
  std::array<float, 3> low, scale;
};

#define TOUCHSTONE_TARGET_NAMESPACE aabb_simd
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/bvh/hilbert.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

auto places_of_level() {
  switch (isa()) {
    case Isa::avx512: return avx512::places;
    case Isa::avx2: return avx2::places;
    default: return baseline::places;
  }
}

}  // namespace

HilbertGrid::HilbertGrid(const std::array<float, 3>& low, const std::array<float, 3>& high,
                         int code_bits)
    : low_(low), scale_{}, axis_{0, 1, 2} {
  std::array<double, 3> extent{};
  for (std::size_t i = 0; i < 3; ++i) extent[i] = double{high[i]} - low[i];
  std::ranges::stable_sort(axis_, std::greater(), [&](std::size_t i) { return extent[i]; });
  // Cells are cubes of the longest axis: an axis shorter than one of them has no bits.
  const double longest = extent[axis_[0]];
  for (axes_ = 3; axes_ > 1; --axes_) {
    const double cells = static_cast<double>(1u << (code_bits / axes_));
    if (extent[axis_[static_cast<std::size_t>(axes_) - 1]] * cells > 4 * longest) break;
  }
  // A float distinguishes no more cells than this.
  bits_ = std::min(code_bits / axes_, 23);
  const auto cells = static_cast<double>(1u << bits_);
  for (float& scale : scale_) {
    scale = longest > 0 ? static_cast<float>(std::min(cells / longest, 1e38)) : 0;
  }
}

void HilbertGrid::codes(std::span<const Aabb> boxes, std::uint32_t* codes) const {
  Numbering numbering{axes_, bits_, axis_, {}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    numbering.low[i] = low_[axis_[i]];
    numbering.scale[i] = scale_[axis_[i]];
  }
  const auto places = places_of_level();
  const std::size_t whole = boxes.size() / boxes_at_once * boxes_at_once;
  for (std::size_t i = 0; i < whole; i += boxes_at_once) {
    places(numbering, &boxes[i], codes + i);
  }
  if (whole == boxes.size()) return;
  std::array<Aabb, boxes_at_once> last{};
  std::ranges::copy(boxes.subspan(whole), last.begin());
  std::array<std::uint32_t, boxes_at_once> found;
  places(numbering, last.data(), found.data());
  std::copy_n(found.begin(), boxes.size() - whole, codes + whole);
}

}  // namespace touchstone
