#include "algorithms/kernels/cell_space.h"

#include <algorithm>

namespace touchstone {
namespace {

constexpr std::size_t sample_size = 256;

}  // namespace

double BoxSample::extent() const {
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

BoxSample sample_boxes(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids) {
  BoxSample sample;
  if (ids.empty()) return sample;
  const std::size_t count = std::min(ids.size(), sample_size);
  std::array<double, sample_size> values;
  const auto quantile = [&](std::size_t percent) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>((count - 1) * percent / 100);
    std::nth_element(values.begin(), at, values.begin() + static_cast<std::ptrdiff_t>(count));
    return *at;
  };
  const auto box = [&](std::size_t i) -> const Aabb& { return boxes[ids[i * ids.size() / count]]; };

  for (std::size_t axis = 0; axis < 3; ++axis) {
    double least = box(0).min[axis];
    double greatest = box(0).max[axis];
    for (std::size_t i = 0; i < count; ++i) {
      values[i] = 0.5 * (double{box(i).min[axis]} + box(i).max[axis]);
      least = std::min(least, double{box(i).min[axis]});
      greatest = std::max(greatest, double{box(i).max[axis]});
    }
    const double low = quantile(2);
    const double high = quantile(98);
    sample.low[axis] = std::max(least, low - 0.5 * (high - low));
    sample.high[axis] = std::min(greatest, high + 0.5 * (high - low));
  }

  for (std::size_t i = 0; i < count; ++i) values[i] = longest_side(box(i));
  sample.usual_side = quantile(90);
  sample.smallest_side = quantile(0);
  return sample;
}

}  // namespace touchstone
