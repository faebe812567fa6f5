// Places along a Hilbert curve: the grid, and the choice of the instruction level.
#include "algorithms/kernels/bvh/hilbert.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>

#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

constexpr std::size_t boxes_at_once = 32;

// Doubled centres, indexed by axis and box.
using Centres = std::array<std::array<float, boxes_at_once>, 3>;

// The numbering of cells; axes with more than one cell come first.
struct Numbering {
  int axes, bits;
  std::array<float, 3> low, scale;
};

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
  codes_of(
      boxes.size(), [&](std::size_t i) -> const Aabb& { return boxes[i]; }, codes);
}

void HilbertGrid::codes(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids,
                        std::uint32_t* codes) const {
  codes_of(
      ids.size(), [&](std::size_t i) -> const Aabb& { return boxes[ids[i]]; }, codes);
}

template <class Box>
void HilbertGrid::codes_of(std::size_t total, const Box& box_of, std::uint32_t* codes) const {
  Numbering numbering{axes_, bits_, {}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    numbering.low[i] = low_[axis_[i]];
    numbering.scale[i] = scale_[axis_[i]];
  }
  const auto places = places_of_level();
  const auto [x, y, z] = axis_;
  Centres centres{};
  for (std::size_t first = 0; first < total; first += boxes_at_once) {
    const std::size_t count = std::min(boxes_at_once, total - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Aabb& box = box_of(first + i);
      centres[0][i] = box.min[x] + box.max[x];
      centres[1][i] = box.min[y] + box.max[y];
      centres[2][i] = box.min[z] + box.max[z];
    }
    std::uint32_t found[boxes_at_once];
    places(numbering, centres, count == boxes_at_once ? codes + first : found);
    if (count < boxes_at_once) std::copy_n(found, count, codes + first);
  }
}

}  // namespace touchstone
