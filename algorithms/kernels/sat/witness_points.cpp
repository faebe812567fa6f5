// The witness points of a separating-axis test, from the supporting features seen along the axis.
#include "algorithms/kernels/sat/witness_points.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "algorithms/kernels/sat/segment.h"
#include "algorithms/kernels/sat/separating_axis.h"

namespace touchstone {
namespace {

// A vertex and its projection along the normal: two coordinates, and zero.
template <class Scalar>
struct Corner {
  Vec3<Scalar> point, seen;
};

template <class Scalar>
Scalar turn(const Vec3<Scalar>& p, const Vec3<Scalar>& q, const Vec3<Scalar>& r) {
  return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
}

// Returns the feature that supports the body in a direction, as a convex polygon projected along
// the normal, anticlockwise. It may have one or two corners.
template <class Scalar>
std::vector<Corner<Scalar>> feature(const PlacedPolytope<Scalar>& body,
                                    const Vec3<Scalar>& direction, const Vec3<Scalar>& u,
                                    const Vec3<Scalar>& v, Scalar tolerance) {
  const Vec3<Scalar> local = body.matrix.transpose() * direction;
  const Scalar least = body.shape->support(local) - tolerance / body.scale;
  std::vector<Corner<Scalar>> corners;
  for (std::size_t k = 0; k < body.shape->count; ++k) {
    const Vec3<Scalar> vertex = body.shape->vertex(k);
    if (!(local.dot(vertex) >= least)) continue;
    const Vec3<Scalar> point = body(vertex);
    corners.push_back({point, {u.dot(point), v.dot(point), 0}});
  }
  std::sort(corners.begin(), corners.end(), [](const auto& p, const auto& q) {
    return p.seen.x() != q.seen.x() ? p.seen.x() < q.seen.x() : p.seen.y() < q.seen.y();
  });
  if (corners.size() < 2) return corners;
  std::vector<Corner<Scalar>> polygon;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t start = polygon.size();
    for (auto at = first; at != last; ++at) {
      while (polygon.size() >= start + 2 &&
             !(turn(polygon[polygon.size() - 2].seen, polygon.back().seen, at->seen) > 0)) {
        polygon.pop_back();
      }
      polygon.push_back(*at);
    }
    polygon.pop_back();  // it is the first point of the other chain
  };
  add_chain(corners.begin(), corners.end());
  add_chain(corners.rbegin(), corners.rend());
  return polygon;
}

template <class Scalar>
bool inside(const Vec3<Scalar>& seen, const std::vector<Corner<Scalar>>& polygon) {
  if (polygon.size() < 3) return false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = k + 1 < polygon.size() ? k + 1 : 0;
    if (!(turn(polygon[k].seen, polygon[next].seen, seen) >= 0)) return false;
  }
  return true;
}

}  // namespace

template <class Scalar>
WitnessPoints<Scalar> witness_points(const PlacedPolytope<Scalar>& a,
                                     const PlacedPolytope<Scalar>& b, const Vec3<Scalar>& normal,
                                     Scalar gap, Scalar tolerance) {
  const Vec3<Scalar> u = normal.unitOrthogonal(), v = normal.cross(u);
  const auto of_a = feature<Scalar>(a, normal, u, v, tolerance);
  const auto of_b = feature<Scalar>(b, -normal, u, v, tolerance);
  for (const auto& corner : of_a) {
    if (inside(corner.seen, of_b)) return {corner.point, corner.point + gap * normal};
  }
  for (const auto& corner : of_b) {
    if (inside(corner.seen, of_a)) return {corner.point - gap * normal, corner.point};
  }
  WitnessPoints<Scalar> best{of_a[0].point, of_b[0].point};
  Scalar least = (of_a[0].seen - of_b[0].seen).squaredNorm();
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const auto &a0 = of_a[i], &a1 = of_a[i + 1 < of_a.size() ? i + 1 : 0];
    for (std::size_t j = 0; j < of_b.size(); ++j) {
      const auto &b0 = of_b[j], &b1 = of_b[j + 1 < of_b.size() ? j + 1 : 0];
      const auto seen =
          closest_points<Scalar>({a0.seen, a1.seen - a0.seen}, {b0.seen, b1.seen - b0.seen});
      if (!(seen.square < least)) continue;
      least = seen.square;
      best = {a0.point + seen.s * (a1.point - a0.point), b0.point + seen.t * (b1.point - b0.point)};
    }
  }
  return best;
}

template WitnessPoints<float> witness_points(const PlacedPolytope<float>&,
                                             const PlacedPolytope<float>&, const Vec3<float>&,
                                             float, float);
template WitnessPoints<double> witness_points(const PlacedPolytope<double>&,
                                              const PlacedPolytope<double>&, const Vec3<double>&,
                                              double, double);

}  // namespace touchstone
