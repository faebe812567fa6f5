// The point of a simplex that is nearest to the origin. Used by the GJK family, EPA and certified.
//
// Signed volumes decide: a feature contains the nearest point if all its barycentric weights are
// positive. Otherwise the nearest point is on one of the features whose side the origin is beyond.
// Paper:   Montanari, Petrinic, Barbieri, "Improving the GJK algorithm for faster and more reliable
//          distance queries between convex objects", ACM TOG 36(3), 2017.
// Departs: volumes are computed in space, instead of the plane or line of greatest projection, and
//          from the vertex between the two shortest edges, so that slivers and needles lose no
//          digits. The direction is the normal of the feature instead of a difference of points, so
//          it stays accurate to rounding if the distance is close to zero.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

template <class Scalar>
struct Simplex {
  int size = 0;
  std::array<DifferencePoint<Scalar>, 4> points;
  std::array<Scalar, 4> weights;      // of the nearest point; positive, with the sum 1
  std::array<CornerPair, 4> corners;  // the corners that the points are made of, if known
};

template <class Scalar>
struct NearestPoint {
  bool inside = false;  // the origin is in the tetrahedron
  // Inside: a lower bound on the origin's distance from the tetrahedron's faces. Otherwise: its
  // distance from the simplex.
  Scalar distance = 0;
  // Unit vector from the origin to the nearest point, normal to its feature. Zero if the distance
  // is zero on a feature without a normal of its own.
  Vec3<Scalar> direction = Vec3<Scalar>::Zero();
};

// Returns the point with the simplex's weights.
template <class Scalar>
DifferencePoint<Scalar> weighted_mean(const Simplex<Scalar>& simplex) {
  DifferencePoint<Scalar> mean{Vec3<Scalar>::Zero(), Vec3<Scalar>::Zero(), Vec3<Scalar>::Zero()};
  for (int i = 0; i < simplex.size; ++i) {
    mean.difference += simplex.weights[i] * simplex.points[i].difference;
    mean.a += simplex.weights[i] * simplex.points[i].a;
    mean.b += simplex.weights[i] * simplex.points[i].b;
  }
  return mean;
}

// The mean of a tetrahedron's points at the origin, which is inside: a point that both bodies have, so that `a` and
// `b` differ by rounding and by the origin's offset. If the tetrahedron is flat, any of its points.
template <class Scalar>
DifferencePoint<Scalar> mean_at_origin(Simplex<Scalar> simplex) {
  const auto& p = simplex.points;
  Scalar sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto corner = [&](std::size_t i) { return p[(k + i) % 4].difference; };
    simplex.weights[k] = std::abs(corner(1).dot(corner(2).cross(corner(3))));
    sum += simplex.weights[k];
  }
  if (!(sum > 0)) return p[0];
  for (Scalar& weight : simplex.weights) weight /= sum;
  return weighted_mean(simplex);
}

// Reduces the simplex to the vertices of the feature that contains the nearest point. If the origin
// is inside, all four remain and the weights are not set.
template <class Scalar>
NearestPoint<Scalar> reduce_to_nearest(Simplex<Scalar>& simplex);

// Heights below this are rounding, for coordinates of about 1.
template <class Scalar>
inline constexpr Scalar flat_height = 4 * std::numeric_limits<Scalar>::epsilon();

// The normal of a triangle, accurate to the last digits that its corners permit.
template <class Scalar>
struct TrianglePlane {
  int base = 0;                 // the corner opposite the longest edge; the others follow in order
  Vec3<Scalar> edge_1, edge_2;  // from the base to the next corner and to the one after
  Vec3<Scalar> longest;         // from that next corner to the one after
  Vec3<Scalar> normal;          // edge_1 x edge_2, of length twice the area
  bool flat = false;            // the points are on a line, up to rounding
};

template <class Scalar>
TrianglePlane<Scalar> triangle_plane(const std::array<Vec3<Scalar>, 3>& corners);

// Barycentric weights of the origin's projection on the plane, in the order of the corners. Some
// are negative if the projection is outside. Not valid for flat triangles.
template <class Scalar>
std::array<Scalar, 3> project_origin(const TrianglePlane<Scalar>& plane,
                                     const std::array<Vec3<Scalar>, 3>& corners);

// The factor by which rounding of the corners enters the plane's distance from the origin: 1 if the
// projection is inside, and large for a sliver that is far from it.
template <class Scalar>
Scalar lever(const std::array<Scalar, 3>& weights);

}  // namespace touchstone
