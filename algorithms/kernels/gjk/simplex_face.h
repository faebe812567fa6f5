// The plane of contact that a simplex around the origin shows. Used by the query of a pair.
//
// If the origin is on the surface of a convex set, and inside a triangle of points of the set, then
// the triangle's plane supports the set.
#pragma once

#include <algorithm>
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

// A triangle of points of the difference that is near the origin, and the plane that supports the
// difference along its normal; lengths are in the pair's unit.
template <class Scalar>
struct FaceContact {
  Simplex<Scalar> triangle;     // reduced to its nearest feature, with weights
  Vec3<Scalar> normal;          // unit length, from a to b
  Scalar lower = 0, upper = 0;  // bounds on the signed distance, but for rounding
};

// Returns the contact of cores without radius if a triangle of the simplex is within `near` of the
// origin, and the difference reaches no further than `beyond` outside of it.
template <class Scalar>
std::optional<FaceContact<Scalar>> find_face_contact(SupportPair<Scalar>& pair,
                                                     const Simplex<Scalar>& simplex, Scalar near,
                                                     Scalar beyond) {
  const auto face = nearest_face(simplex, Vec3<Scalar>(-pair.centre_b()));
  if (!face || !(face->distance <= near)) return {};
  FaceContact<Scalar> contact;
  contact.normal = face->normal;
  Simplex<Scalar>& triangle = contact.triangle;
  triangle.size = 3;
  const auto w = [&](std::size_t k) -> const Vec3<Scalar>& {
    return triangle.points[k % 3].difference;
  };
  Scalar sum = 0, least = std::numeric_limits<Scalar>::infinity();
  for (std::size_t k = 0; k < 3; ++k) triangle.points[k] = simplex.points[face->corners[k]];
  const Vec3<Scalar> area = (w(1) - w(0)).cross(w(2) - w(0));
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.weights[k] = area.dot(w(k + 1).cross(w(k + 2)));
    sum += triangle.weights[k];
    least = std::min(least, triangle.weights[k]);
  }
  if (least > 0) {
    for (std::size_t k = 0; k < 3; ++k) triangle.weights[k] /= sum;
    contact.upper = weighted_mean(triangle).difference.norm();
  }
  // Beside the triangle, or where it is too narrow for that, a more careful search decides.
  if (!(least > 0 && contact.upper <= near)) contact.upper = reduce_to_nearest(triangle).distance;
  if (!(contact.upper <= near)) return {};
  const Scalar height = face->normal.dot(pair.support(face->normal).difference);
  if (!(height <= beyond)) return {};
  contact.lower = std::min(-height, Scalar{0});
  return contact;
}

}  // namespace touchstone
