// The plane of contact that a simplex around the origin shows. Used by the query of a pair.
//
// If the origin is on the surface of a convex set, and inside a triangle of points of the set, then
// the triangle's plane supports the set.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

template <class Scalar>
struct SimplexFace {
  std::array<std::size_t, 3> corners;  // indices into the simplex
  Vec3<Scalar> normal;                 // unit length, away from the inner point
  Scalar distance;                     // of the plane from the origin, not negative
};

// Returns the triangle of the simplex whose plane is nearest to the origin, or nothing if the
// simplex has less than three points or no area. `inner` is a point inside the difference.
template <class Scalar>
std::optional<SimplexFace<Scalar>> nearest_face(const Simplex<Scalar>& simplex,
                                                const Vec3<Scalar>& inner) {
  static constexpr std::array<std::array<std::size_t, 3>, 4> faces = {
      {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
  std::optional<SimplexFace<Scalar>> best;
  const std::size_t count = simplex.size == 4 ? 4 : simplex.size == 3 ? 1 : 0;
  for (std::size_t f = 0; f < count; ++f) {
    const Vec3<Scalar>& p = simplex.points[faces[f][0]].difference;
    const Vec3<Scalar> n = (simplex.points[faces[f][1]].difference - p)
                               .cross(simplex.points[faces[f][2]].difference - p);
    const Scalar length = n.norm();
    if (!(length > 0)) continue;
    const Scalar distance = std::abs(n.dot(p)) / length;
    if (best && !(distance < best->distance)) continue;
    const Scalar sense = n.dot(p - inner) < 0 ? Scalar{-1} : Scalar{1};
    best = {faces[f], n * (sense / length), distance};
  }
  return best;
}

}  // namespace touchstone
