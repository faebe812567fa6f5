// The hull of coplanar points by Andrew's monotone chain, in long double.
#include "algorithms/kernels/sat/planar_hull.h"

#include <algorithm>
#include <numeric>

namespace touchstone {
namespace {

using Vec = Vec3<long double>;

// Returns the boundary as indices, anticlockwise about `normal`, by Andrew's monotone chain in the
// coordinate plane that is most nearly perpendicular to the normal.
std::vector<std::uint32_t> boundary_loop(std::span<const Vec> points, const Vec& normal) {
  Eigen::Index drop = 0;
  normal.cwiseAbs().maxCoeff(&drop);
  Eigen::Index u = (drop + 1) % 3, v = (drop + 2) % 3;
  if (normal[drop] < 0) std::swap(u, v);
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    if (points[a][u] != points[b][u]) return points[a][u] < points[b][u];
    return points[a][v] < points[b][v];
  };
  std::sort(order.begin(), order.end(), before);
  const auto turns_left = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return (points[b][u] - points[a][u]) * (points[c][v] - points[a][v]) >
           (points[b][v] - points[a][v]) * (points[c][u] - points[a][u]);
  };
  std::vector<std::uint32_t> loop;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t start = loop.size();
    for (auto at = first; at != last; ++at) {
      while (loop.size() >= start + 2 && !turns_left(loop[loop.size() - 2], loop.back(), *at)) {
        loop.pop_back();
      }
      loop.push_back(*at);
    }
    loop.pop_back();  // it is the first point of the other chain
  };
  add_chain(order.begin(), order.end());
  add_chain(order.rbegin(), order.rend());
  return loop;
}

}  // namespace

std::size_t farthest_from(std::span<const Vec> points, const Vec& from) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if ((points[k] - from).squaredNorm() > (points[best] - from).squaredNorm()) best = k;
  }
  return best;
}

PlanarHull planar_hull(std::span<const Vec> points) {
  const std::size_t p = farthest_from(points, points[0]);
  const std::size_t q = farthest_from(points, points[p]);
  PlanarHull outline;
  for (const Vec& r : points) {
    const Vec cross = (points[q] - points[p]).cross(r - points[p]);
    if (cross.squaredNorm() > outline.normal.squaredNorm()) outline.normal = cross;
  }
  const long double length = outline.normal.norm();
  if (length > 0) {
    outline.normal /= length;
    outline.loop = boundary_loop(points, outline.normal);
  } else {
    outline.loop = {static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(q)};
  }
  return outline;
}

}  // namespace touchstone
