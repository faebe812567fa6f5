#include "algorithms/kernels/cell_space.h"

namespace touchstone {
namespace {

constexpr std::size_t sample_size = 256;

}  // namespace

double BoxSample::extent() const {
  return std::max(
      {(high[0] - low[0]) / side[0], (high[1] - low[1]) / side[1], (high[2] - low[2]) / side[2]});
}

BoxSample sample_boxes(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids) {
  BoxSample sample;
  if (ids.empty()) return sample;
  const std::size_t count = std::min(ids.size(), sample_size);
  std::array<Aabb, sample_size> taken;
  for (std::size_t i = 0; i < count; ++i) taken[i] = boxes[ids[i * ids.size() / count]];

  std::array<double, sample_size> values;
  const auto quantile = [&](std::size_t percent, const auto& value) {
    std::transform(taken.begin(), taken.begin() + count, values.begin(), value);
    const auto at = values.begin() + (count - 1) * percent / 100;
    std::nth_element(values.begin(), at, values.begin() + count);
    return *at;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto min = [=](const Aabb& box) { return double{box.min[axis]}; };
    const auto max = [=](const Aabb& box) { return double{box.max[axis]}; };
    const double low = quantile(2, min);
    const double high = quantile(98, max);
    sample.low[axis] = std::max(quantile(0, min), low - 0.5 * (high - low));
    sample.high[axis] = std::min(quantile(100, max), high + 0.5 * (high - low));
    sample.side[axis] = quantile(90, [&](const Aabb& box) { return max(box) - min(box); });
  }
  double instead = std::ranges::max(sample.side);
  for (std::size_t axis = 0; axis < 3 && instead == 0; ++axis) {
    instead = sample.high[axis] - sample.low[axis];
  }
  std::ranges::replace(sample.side, 0.0, instead > 0 ? instead : 1);

  const CellSpace unit{
      .inverse_side = {1 / sample.side[0], 1 / sample.side[1], 1 / sample.side[2]}};
  const auto size = [&](const Aabb& box) { return unit.size(box); };
  sample.usual = quantile(90, size);
  sample.smallest = quantile(0, size);
  return sample;
}

}  // namespace touchstone
