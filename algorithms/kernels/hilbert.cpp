#include "algorithms/kernels/hilbert.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>

#include "algorithms/core/isa.h"

namespace touchstone {
namespace {

constexpr std::size_t lanes = 16;
// The compiler splits it where the machine's vectors are narrower.
using Integers = std::uint32_t __attribute__((vector_size(4 * lanes)));

// Numbers of cells: [axis][lane].
using Cells = std::array<std::array<std::uint32_t, lanes>, 3>;

namespace baseline {
#define TOUCHSTONE_TARGET
#include "algorithms/kernels/hilbert.inl"
#undef TOUCHSTONE_TARGET
}  // namespace baseline

#if defined(__x86_64__)
namespace avx2 {
#define TOUCHSTONE_TARGET __attribute__((target("avx2")))
#include "algorithms/kernels/hilbert.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx2

namespace avx512 {
#define TOUCHSTONE_TARGET __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl")))
#include "algorithms/kernels/hilbert.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx512
#else
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif

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
  // Cells are cubes of the longest axis: an axis that is shorter than one of them has no bits.
  const double longest = extent[axis_[0]];
  for (axes_ = 3; axes_ > 1; --axes_) {
    const double cells = static_cast<double>(1u << (code_bits / axes_));
    if (extent[axis_[static_cast<std::size_t>(axes_) - 1]] * cells > 4 * longest) break;
  }
  bits_ = code_bits / axes_;
  const auto cells = static_cast<double>(1u << bits_);
  for (float& scale : scale_) {
    scale = longest > 0 ? static_cast<float>(std::min(cells / longest, 1e38)) : 0;
  }
}

void HilbertGrid::codes(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids,
                        std::uint32_t* codes) const {
  const auto last = static_cast<float>((1u << bits_) - 1);
  const auto places = places_of_level();
  Cells cells{};
  for (std::size_t first = 0; first < ids.size(); first += lanes) {
    const std::size_t count = std::min(lanes, ids.size() - first);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Aabb& box = boxes[ids[first + lane]];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t axis = axis_[i];
        const float cell = (box.min[axis] + box.max[axis] - low_[axis]) * scale_[axis];
        // Sums that overflow are at the end of the curve; a NaN of theirs at its beginning.
        cells[i][lane] = static_cast<std::uint32_t>(cell > 0 ? std::min(cell, last) : 0.0f);
      }
    }
    std::uint32_t found[lanes];
    places(axes_, cells, bits_, found);
    std::copy_n(found, count, codes + first);
  }
}

}  // namespace touchstone
