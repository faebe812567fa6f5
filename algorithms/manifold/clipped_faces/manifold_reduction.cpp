// Part of clipped-faces: the search for the four corners of greatest area.
#include "algorithms/manifold/clipped_faces/manifold_reduction.h"

#include <algorithm>

namespace touchstone {
namespace {

constexpr std::uint32_t most_tried = 16;

template <class Scalar>
struct Choice {
  Scalar area = -1;
  std::array<std::uint32_t, 4> corners{};
};

// Offers the quadrilateral of greatest area that has corner `first` among the `count` corners from
// `first` on: for each opposite corner it takes the furthest corner on either side of the diagonal.
template <class Scalar>
void offer_with(const std::vector<PolygonCorner<Scalar>>& corners, std::uint32_t first,
                std::uint32_t count, Choice<Scalar>& best) {
  const auto all = static_cast<std::uint32_t>(corners.size());
  const auto at = [&](std::uint32_t step) {
    return first + step < all ? first + step : first + step - all;
  };
  const PolygonCorner<Scalar>& origin = corners[first];
  for (std::uint32_t opposite = 2; opposite + 1 < count; ++opposite) {
    const PolygonCorner<Scalar>& end = corners[at(opposite)];
    const Scalar x = end.x - origin.x, y = end.y - origin.y;
    // Twice the area of the triangle, positive on the right of the diagonal.
    const auto area = [&](std::uint32_t step) {
      const PolygonCorner<Scalar>& p = corners[at(step)];
      return (p.x - origin.x) * y - (p.y - origin.y) * x;
    };
    Scalar right = 0, left = 0;
    std::uint32_t on_right = 1, on_left = opposite + 1;
    for (std::uint32_t step = 1; step < opposite; ++step) {
      const Scalar value = area(step);
      if (value > right) right = value, on_right = step;
    }
    for (std::uint32_t step = opposite + 1; step < count; ++step) {
      const Scalar value = -area(step);
      if (value > left) left = value, on_left = step;
    }
    if (right + left > best.area) {
      best = {right + left, {first, at(on_right), at(opposite), at(on_left)}};
    }
  }
}

}  // namespace

template <class Scalar>
std::array<std::uint32_t, 4> choose_four(const std::vector<PolygonCorner<Scalar>>& corners,
                                         Scalar rounding) {
  const auto count = static_cast<std::uint32_t>(corners.size());
  Scalar greatest = corners[0].depth;
  for (const PolygonCorner<Scalar>& corner : corners) greatest = std::max(greatest, corner.depth);
  const auto is_deepest = [&](const auto& corner) { return corner.depth >= greatest - rounding; };
  const auto deepest =
      static_cast<std::uint32_t>(std::count_if(corners.begin(), corners.end(), is_deepest));
  Choice<Scalar> best;
  if (deepest == count && count <= most_tried) {
    // Any four corners qualify; each set is tried once, from its first corner on.
    for (std::uint32_t k = 0; k + 3 < count; ++k) offer_with(corners, k, count - k, best);
    return best.corners;
  }
  const std::uint32_t tried = std::min(deepest, most_tried);
  std::uint32_t met = 0, done = 0;  // counts of deepest corners
  for (std::uint32_t k = 0; k < count && done < tried; ++k) {
    if (!is_deepest(corners[k])) continue;
    if (met++ * tried / deepest < done) continue;
    ++done;
    offer_with(corners, k, count, best);
  }
  std::sort(best.corners.begin(), best.corners.end());
  return best.corners;
}

template std::array<std::uint32_t, 4> choose_four(const std::vector<PolygonCorner<float>>&, float);
template std::array<std::uint32_t, 4> choose_four(const std::vector<PolygonCorner<double>>&,
                                                  double);

}  // namespace touchstone
