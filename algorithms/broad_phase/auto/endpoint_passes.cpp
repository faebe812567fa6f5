// Part of auto: estimates passes of end points from samples. See endpoint_passes.h.
#include "algorithms/broad_phase/auto/endpoint_passes.h"

#include <algorithm>
#include <cmath>

#include "algorithms/core/memory_usage.h"

namespace touchstone {
namespace {

// Returns the share of all pairs of intervals that overlap; `begins` and `ends` ascend.
double overlapping_share(std::span<const float> begins, std::span<const float> ends) {
  // Those that end before another begins do not overlap it.
  double apart = 0;
  std::size_t ended = 0;
  for (const float begin : begins) {
    while (ended < ends.size() && ends[ended] < begin) ++ended;
    apart += static_cast<double>(ended);
  }
  const auto count = static_cast<double>(begins.size());
  return 1 - apart / std::max(count * (count - 1) / 2, 1.0);
}

}  // namespace

void EndpointPasses::sample(std::span<const Aabb> boxes) {
  const std::size_t stride = boxes.size() / most_sampled + 1;
  overlapping_ = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    points_.clear();
    for (std::size_t id = 0; id < boxes.size(); id += stride) {
      if (!boxes[id].is_empty()) points_.push_back(boxes[id].min[axis]);
    }
    const std::size_t count = points_.size();
    if (count == 0) return quantiles_.fill({});
    for (std::size_t id = 0; id < boxes.size(); id += stride) {
      if (!boxes[id].is_empty()) points_.push_back(boxes[id].max[axis]);
    }
    const std::span<float> begins = std::span(points_).first(count);
    const std::span<float> ends = std::span(points_).subspan(count);
    std::ranges::sort(begins);
    std::ranges::sort(ends);
    overlapping_ = std::min(overlapping_, overlapping_share(begins, ends));
    std::ranges::inplace_merge(points_, points_.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i <= pieces; ++i) {
      quantiles_[axis][i] = points_[i * (points_.size() - 1) / pieces];
    }
  }
}

// Returns the share of the end points that are below, interpolated between the quantiles.
double EndpointPasses::share_below(std::size_t axis, float x) const {
  const auto& quantiles = quantiles_[axis];
  if (x <= quantiles.front()) return 0;
  if (x >= quantiles.back()) return 1;
  const auto above = std::ranges::upper_bound(quantiles, x);
  const float from = *(above - 1);
  // Differences of finite floats can overflow, those of their doubles cannot.
  const double part = (double{x} - double{from}) / (double{*above} - double{from});
  return (static_cast<double>(above - quantiles.begin() - 1) + part) / double{pieces};
}

void EndpointPasses::note(std::span<const Aabb> boxes, std::span<const std::uint32_t> moved) {
  noted_.clear();
  const std::size_t stride = moved.size() / most_noted + 1;
  for (std::size_t i = 0; i < moved.size(); i += stride) {
    noted_.push_back({moved[i], boxes[moved[i]]});
  }
}

std::optional<MoverMotion> EndpointPasses::motion(std::span<const Aabb> boxes,
                                                  std::size_t bodies) const {
  MoverMotion sum;
  double movers = 0;
  for (const auto& [id, then] : noted_) {
    const Aabb& now = boxes[id];
    if (now.is_empty() || now == then) continue;
    ++movers;
    double way = 0, side = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = std::abs(double{now.min[axis]} - double{then.min[axis]});
      const double high = std::abs(double{now.max[axis]} - double{then.max[axis]});
      way = std::max({way, low, high});
      side = std::max(side, double{now.max[axis]} - double{now.min[axis]});
      sum.axes += low > 0 || high > 0 ? 1 : 0;
      sum.passes += std::abs(share_below(axis, now.min[axis]) - share_below(axis, then.min[axis])) +
                    std::abs(share_below(axis, now.max[axis]) - share_below(axis, then.max[axis]));
    }
    // A point leaves in each frame.
    sum.leaving += side > 0 ? std::clamp(10 * way / side, 0.125, 1.0) : 1;
  }
  if (movers == 0) return std::nullopt;
  return MoverMotion{.axes = sum.axes / movers,
                     .passes = sum.passes / movers * 2 * static_cast<double>(bodies),
                     .leaving = sum.leaving / movers};
}

std::size_t EndpointPasses::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(points_, noted_));
}

}  // namespace touchstone
