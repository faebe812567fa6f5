// The point of a simplex that is nearest to the origin.
//
// By signed volumes: a feature holds the nearest point where all its barycentric weights are
// positive; otherwise the nearest point lies on one of the features beyond whose side the origin
// is. Paper:   Montanari, Petrinic, Barbieri, "Improving the GJK algorithm for faster and more
// reliable distance queries between convex objects", ACM TOG 36(3), 2017. Departs: volumes are
// taken in space, not in the plane or line of greatest projection, and from the vertex between the
// two shortest edges, so that slivers and needles lose no digits. The direction is the normal of
// the feature and not the difference of points: it stays good to rounding when the distance is
// nearly nothing.
#pragma once

#include <array>
#include <limits>

#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

template <class Scalar>
struct Simplex {
  int size = 0;
  std::array<DifferencePoint<Scalar>, 4> points;
  std::array<Scalar, 4> weights;      // of the nearest point; positive, their sum is 1
  std::array<CornerPair, 4> corners;  // that the points are of, where that is known
};

template <class Scalar>
struct NearestPoint {
  bool inside = false;  // the origin is in the tetrahedron
  // Inside: how far the origin is from the tetrahedron's faces, at least. Otherwise: from the
  // simplex.
  Scalar distance = 0;
  // Unit vector from the origin to the nearest point, normal to its feature. Zero where the
  // distance is zero on a feature that has no normal of its own.
  Vec3<Scalar> direction = Vec3<Scalar>::Zero();
};

// Reduces the simplex to the vertices of the feature that holds the nearest point. Inside, all
// four remain and weights are not set.
template <class Scalar>
NearestPoint<Scalar> reduce_to_nearest(Simplex<Scalar>& simplex);

// Heights below this are rounding, for coordinates of about 1.
template <class Scalar>
inline constexpr Scalar flat_height = 4 * std::numeric_limits<Scalar>::epsilon();

// The normal of a triangle, to the last digits that its corners allow.
template <class Scalar>
struct TrianglePlane {
  int base = 0;                 // the corner opposite the longest edge; the others follow in turn
  Vec3<Scalar> edge_1, edge_2;  // from the base to the next corner and to the one after
  Vec3<Scalar> longest;         // from that next corner to the one after
  Vec3<Scalar> normal;          // edge_1 x edge_2: twice the area long
  bool flat = false;            // three points on a line, up to rounding
};

template <class Scalar>
TrianglePlane<Scalar> triangle_plane(const std::array<Vec3<Scalar>, 3>& corners);

// Barycentric weights, of the corners in their order, of the origin's projection on the plane. Some
// are negative where it falls outside; not for flat triangles.
template <class Scalar>
std::array<Scalar, 3> project_origin(const TrianglePlane<Scalar>& plane,
                                     const std::array<Vec3<Scalar>, 3>& corners);

// What rounding of the corners is multiplied by in the plane's distance from the origin: 1 where
// the projection falls inside, and much for a sliver that is far from it.
template <class Scalar>
Scalar lever(const std::array<Scalar, 3>& weights);

}  // namespace touchstone
