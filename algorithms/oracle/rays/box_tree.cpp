// What a ray or a point cannot meet, by comparisons and by doubles with a bound on their rounding.
//
// Steps: 1. Halve the boxes at the median along their longest axis, down to one.
//        2. A ray misses a box that lies behind its origin on an axis, or beside its line as seen along
//           an axis: on the far side by more than all roundings.
//        3. A ray misses a triangle if it passes two of its edges on different sides, for certain.
//        4. The nearest triangle is not farther than the nearest vertex that is seen on the way down.
#include "algorithms/oracle/rays/box_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace touchstone::oracle {
namespace {

constexpr std::uint32_t no_item = std::numeric_limits<std::uint32_t>::max();
// Sums of a few products of differences are off by less than 16 roundings of their magnitudes. What
// underflows is less than the last.
constexpr double rounding = 0x1p-48, underflow = 1e-290;
constexpr std::array<std::pair<int, int>, 3> planes = {{{0, 1}, {1, 2}, {2, 0}}};

// 1 or -1 if the number that was calculated is certain of its sign, else 0; also of NaN.
int certain_sign(double value, double magnitude) {
  const double bound = rounding * magnitude + underflow;
  return value > bound ? 1 : (value < -bound ? -1 : 0);
}

bool is_behind(const Vec3d& origin, const Vec3d& direction, const Vec3d& low, const Vec3d& high) {
  for (int k = 0; k < 3; ++k) {
    if (direction[k] >= 0 && high[k] < origin[k]) return true;
    if (direction[k] <= 0 && low[k] > origin[k]) return true;
  }
  return false;
}

// True if the box is on one side of the ray's line, as seen along an axis.
bool is_beside(const Vec3d& origin, const Vec3d& direction, const Vec3d& low, const Vec3d& high) {
  const Vec3d from = low - origin, to = high - origin;
  for (const auto& [i, j] : planes) {
    int seen = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const double a = direction[i] * (corner % 2 == 0 ? from : to)[j];
      const double b = direction[j] * (corner < 2 ? from : to)[i];
      seen += certain_sign(a - b, std::abs(a) + std::abs(b));
    }
    if (seen == 4 || seen == -4) return true;
  }
  return false;
}

bool passes_by(const Vec3d& origin, const Vec3d& direction, const std::array<Vec3d, 3>& corners) {
  int plus = 0, minus = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d a = corners[k] - origin, b = corners[(k + 1) % 3] - origin;
    double volume = 0, magnitude = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, l = (i + 2) % 3;
      const double first = a[j] * b[l], second = a[l] * b[j];
      volume += direction[i] * (first - second);
      magnitude += std::abs(direction[i]) * (std::abs(first) + std::abs(second));
    }
    // A product that underflows within is multiplied by the direction.
    magnitude += direction.cwiseAbs().sum() * (underflow / rounding);
    const int sign = certain_sign(volume, magnitude);
    plus += sign > 0 ? 1 : 0;
    minus += sign < 0 ? 1 : 0;
  }
  return plus > 0 && minus > 0;
}

double square_to(const Vec3d& point, const Vec3d& low, const Vec3d& high) {
  return (low - point).cwiseMax(point - high).cwiseMax(0.0).squaredNorm();
}

}  // namespace

void BoxTree::build(std::span<const Vec3d> vertices, Triangles triangles) {
  vertices_ = vertices;
  triangles_ = triangles;
  std::vector<Box> boxes(triangles.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const auto [a, b, c] = corners(i);
    boxes[i] = {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
  }
  build_of(boxes);
}

void BoxTree::build(std::span<const Box> boxes) {
  vertices_ = {};
  triangles_ = {};
  build_of(boxes);
}

void BoxTree::build_of(std::span<const Box> boxes) {
  leaves_ = std::bit_ceil(std::max<std::size_t>(boxes.size(), 1));
  nodes_.resize(2 * leaves_ - 1);
  of_leaf_.assign(leaves_, no_item);
  std::vector<std::uint32_t> numbers(boxes.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint32_t>(i);
  fill(0, boxes, numbers);
}

std::array<Vec3d, 3> BoxTree::corners(std::uint32_t triangle) const {
  const auto& [a, b, c] = triangles_[triangle];
  return {vertices_[a], vertices_[b], vertices_[c]};
}

void BoxTree::fill(std::size_t node, std::span<const Box> boxes, std::span<std::uint32_t> part) {
  constexpr double most = std::numeric_limits<double>::infinity();
  Box& box = nodes_[node];
  box = {Vec3d::Constant(most), Vec3d::Constant(-most)};
  for (const std::uint32_t item : part) {
    box.low = box.low.cwiseMin(boxes[item].low);
    box.high = box.high.cwiseMax(boxes[item].high);
  }
  if (node >= leaves_ - 1) {
    if (!part.empty()) of_leaf_[node - (leaves_ - 1)] = part.front();
    return;
  }
  const std::size_t half = (part.size() + 1) / 2;
  if (part.size() > 1) {
    Eigen::Index axis = 0;
    (box.high - box.low).maxCoeff(&axis);
    const auto middle = [&](std::uint32_t item) {
      return boxes[item].low[axis] / 2 + boxes[item].high[axis] / 2;
    };
    std::ranges::nth_element(part, part.begin() + static_cast<std::ptrdiff_t>(half), {}, middle);
  }
  fill(2 * node + 1, boxes, part.first(half));
  fill(2 * node + 2, boxes, part.subspan(half));
}

template <class Enter, class Take>
void BoxTree::walk(Enter&& enters, Take&& take) const {
  std::vector<std::size_t> open = {0};
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    if (!enters(nodes_[node])) continue;
    if (node < leaves_ - 1) {
      open.push_back(2 * node + 2);
      open.push_back(2 * node + 1);
    } else if (of_leaf_[node - (leaves_ - 1)] != no_item) {
      take(of_leaf_[node - (leaves_ - 1)]);
    }
  }
}

void BoxTree::meet_ray(const Vec3d& origin, const Vec3d& direction,
                       std::vector<std::uint32_t>& found) const {
  found.clear();
  walk(
      [&](const Box& box) {
        return !is_behind(origin, direction, box.low, box.high) &&
               !is_beside(origin, direction, box.low, box.high);
      },
      [&](std::uint32_t item) {
        if (triangles_.empty() || !passes_by(origin, direction, corners(item))) {
          found.push_back(item);
        }
      });
  std::ranges::sort(found);
}

void BoxTree::may_be_nearest(const Vec3d& point, std::vector<std::uint32_t>& found) const {
  double limit = std::numeric_limits<double>::infinity();
  const auto is_near = [&](const Box& box) {
    return !(square_to(point, box.low, box.high) > limit);
  };
  walk(is_near, [&](std::uint32_t triangle) {
    for (const Vec3d& corner : corners(triangle)) {
      const double square = (corner - point).squaredNorm();
      limit = std::min(limit, square + square * rounding + underflow);
    }
  });
  found.clear();
  walk(is_near, [&](std::uint32_t triangle) { found.push_back(triangle); });
  std::ranges::sort(found);
}

}  // namespace touchstone::oracle
