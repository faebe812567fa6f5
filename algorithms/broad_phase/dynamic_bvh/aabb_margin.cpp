// Part of dynamic-bvh: the margin's estimates, from samples of the moved bodies.
#include "algorithms/broad_phase/dynamic_bvh/aabb_margin.h"

#include <algorithm>
#include <array>
#include <limits>

namespace touchstone {
namespace {

constexpr float most_margin = 0.1f;  // share of a body's longest side
constexpr float frames_ahead = 8;
constexpr std::size_t sample_size = 256;

float longest_side(const Aabb& box) {
  return std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
}

// Returns the greatest distance by which `inner` protrudes from `outer`, on any side.
float excess(const Aabb& outer, const Aabb& inner) {
  float most = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    most = std::max({most, outer.min[axis] - inner.min[axis], inner.max[axis] - outer.max[axis]});
  }
  return most;
}

// Values of a few bodies, taken evenly.
struct Sample {
  std::array<float, sample_size> values{};
  std::size_t count = 0;

  // Returns the value that this share of them does not exceed; there is at least one.
  float quantile(std::size_t tenths) {
    const auto begin = values.begin();
    const auto at = begin + static_cast<std::ptrdiff_t>((count - 1) * tenths / 10);
    std::nth_element(begin, at, begin + static_cast<std::ptrdiff_t>(count));
    return *at;
  }
};

template <class Take>
void sample(std::span<const std::uint32_t> ids, const Take& take) {
  const std::size_t count = std::min(ids.size(), sample_size);
  for (std::size_t i = 0; i < count; ++i) take(ids[i * ids.size() / count]);
}

}  // namespace

Aabb AabbMargin::around(const Aabb& box) const {
  constexpr float most = std::numeric_limits<float>::max();
  const float margin = std::min(margin_, most_margin * longest_side(box));
  Aabb grown;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grown.min[axis] = std::max(box.min[axis] - margin, -most);
    grown.max[axis] = std::min(box.max[axis] + margin, most);
  }
  return grown;
}

std::size_t AabbMargin::measure(std::span<const Aabb> boxes, std::span<const std::uint32_t> moved,
                                const Bvh16& before) {
  margin_ = 0;
  Sample slow;
  std::size_t fast = 0;
  sample(moved, [&](std::uint32_t id) {
    const Aabb then = before.box_at(before.place_of(id));
    const float way = std::max(excess(then, boxes[id]), excess(boxes[id], then));
    // The comparison counts a NaN as fast.
    if (way <= 0.25f * most_margin * longest_side(boxes[id])) {
      slow.values[slow.count++] = way;
    } else {
      ++fast;
    }
  });
  if (slow.count > 0) margin_ = frames_ahead * slow.quantile(9);
  return fast == 0 ? 0 : fast * moved.size() / (slow.count + fast);
}

void AabbMargin::adapt(std::size_t frames) {
  margin_ *= std::clamp(frames_ahead / static_cast<float>(frames + 1), 0.5f, 2.0f);
}

// The distance by which a leaver protrudes is at most the distance that it moved.
void AabbMargin::widen(std::span<const Aabb> boxes, std::size_t moved,
                       std::span<const std::uint32_t> leavers, const Bvh16& tree) {
  if (leavers.empty() || 4 * leavers.size() < moved) return;
  Sample ways;
  sample(leavers, [&](std::uint32_t id) {
    ways.values[ways.count++] = excess(tree.box_at(tree.place_of(id)), boxes[id]);
  });
  margin_ = std::max(margin_, frames_ahead * ways.quantile(5));
}

}  // namespace touchstone
