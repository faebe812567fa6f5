// Gaps of triangles along a direction, rounded down.
//
// With u half an epsilon, a sum of three products and a fourth term is off by at most 4 u of the sum of
// the magnitudes, to first order; the bounds below take 8. Directions and coordinates whose products
// could leave the range of normal doubles prove nothing.
#include "algorithms/oracle/concave/triangle_gap.h"

#include <algorithm>
#include <limits>

namespace touchstone::oracle {
namespace {

constexpr double eight_units = 4 * std::numeric_limits<double>::epsilon();
constexpr double least_direction = 1e-100, greatest_coordinate = 1e100;
constexpr double rounded_down = 1 - 0x1p-40;

double greatest_of(const RoundedTriangle& t) {
  double greatest = 0;
  for (const Vec3d& corner : t.corners) {
    greatest = std::max(greatest, corner.lpNorm<Eigen::Infinity>());
  }
  return greatest;
}

}  // namespace

RoundedTriangle rounded_triangle(const Body& body) {
  RoundedTriangle rounded{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d& vertex = body.solid->vertices[k];
    rounded.corners[k] = body.matrix * vertex + body.translation;
    const Vec3d most =
        body.matrix.cwiseAbs() * vertex.cwiseAbs() + Vec3d(body.translation.cwiseAbs());
    rounded.error = std::max(rounded.error, eight_units * most.maxCoeff());
  }
  return rounded;
}

double gap_along(const Vec3d& direction, const RoundedTriangle& a, const RoundedTriangle& b) {
  const double reach = std::max(greatest_of(a), greatest_of(b));
  const double length = direction.norm(), most = direction.cwiseAbs().sum();
  if (!(length > least_direction && most < greatest_coordinate && reach < greatest_coordinate)) {
    return 0;
  }
  const auto along = [&](const Vec3d& corner) { return direction.dot(corner); };
  const double end = std::max({along(a.corners[0]), along(a.corners[1]), along(a.corners[2])});
  const double begin = std::min({along(b.corners[0]), along(b.corners[1]), along(b.corners[2])});
  const double slack = most * (a.error + b.error + 2 * eight_units * reach);
  return std::max(0.0, (begin - end - slack) / length * rounded_down);
}

double proven_distance(const RoundedTriangle& a, const RoundedTriangle& b, double enough) {
  double bound = 0;
  const auto suffices = [&](const Vec3d& direction) {
    bound = std::max({bound, gap_along(direction, a, b), gap_along(-direction, a, b)});
    return bound > enough;
  };
  const auto edge = [](const RoundedTriangle& t, std::size_t k) {
    return Vec3d(t.corners[(k + 1) % 3] - t.corners[k]);
  };
  const auto across = [](const Vec3d& way, const Vec3d& along) {
    const double square = along.squaredNorm();
    return square > 0 ? Vec3d(way - along * (along.dot(way) / square)) : way;
  };
  if (suffices(b.corners[0] + b.corners[1] + b.corners[2] - a.corners[0] - a.corners[1] -
               a.corners[2])) {
    return bound;
  }
  // Corners over faces.
  for (const RoundedTriangle* t : {&a, &b}) {
    if (suffices(edge(*t, 0).cross(edge(*t, 1)))) return bound;
  }
  // Two corners, two edges, and a corner and an edge.
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3d way = b.corners[j] - a.corners[i];
      if (suffices(way) || suffices(edge(a, i).cross(edge(b, j))) ||
          suffices(across(way, edge(a, i))) || suffices(across(way, edge(b, j)))) {
        return bound;
      }
    }
  }
  return bound;
}

}  // namespace touchstone::oracle
