// The start of GJK between a box and a hull, which may rest on it. Used by the query of a pair and the distance loop.
//
// The search starts towards the place of the box that is nearest to the hull's centre. If the hull rests on a face,
// that is the face's normal, and the first plane is within rounding of contact. A corner of the hull on the face then
// proves that they touch. Without this start GJK takes five to eight steps to find that plane.
// Paper:   Ericson, "Real-Time Collision Detection", 2005, section 5.1.3 (point and box).
// Cost:    21 products; 36 more and a support call if the first plane is within rounding of contact.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "algorithms/kernels/gjk/simplex_face.h"

namespace touchstone {

// Whether a is a box and b a hull, both without radius; not if the box is nearly a point beside the hull.
template <class Scalar>
bool is_box_with_hull(const SupportShape<Scalar>& a, const SupportShape<Scalar>& b) {
  return a.core == SupportCore::box && b.core == SupportCore::hull && a.radius + b.radius == 0 &&
         a.unit > 1e-6 * b.unit;
}

// The axes of the box that is body a. Its extents are in its own unit, and points of the pair in that of the pair.
template <class Scalar>
struct BoxAxes {
  const Mat3<Scalar>& edges;  // each as long as the box's unit, if the matrix is a rotation
  const Vec3<Scalar>& half;
  Scalar unit;     // that of the box in that of the pair; a power of two
  Scalar inverse;  // of its square

  explicit BoxAxes(SupportPair<Scalar>& pair)
      : edges(pair.a().matrix()),
        half(pair.a().shape().extents),
        unit(static_cast<Scalar>(pair.a().shape().unit / pair.unit())),
        inverse(1 / (unit * unit)) {}

  // A point of the pair in the axes and the unit of the box; about so, if its matrix is no rotation.
  Vec3<Scalar> operator()(const Vec3<Scalar>& point) const {
    return inverse * (edges.transpose() * point);
  }
  // The place of the box that is nearest to a point, both in its axes and unit.
  Vec3<Scalar> nearest(const Vec3<Scalar>& local) const {
    return local.cwiseMax(-half).cwiseMin(half);
  }
};

// The direction in which the search starts, of any length: from the origin towards the difference. It is that of the
// centres, but between a box and a hull that of the box's place that is nearest to the hull's centre. If that centre is
// in the box, it is that of the centres too.
template <class Scalar>
Vec3<Scalar> start_direction(SupportPair<Scalar>& pair) {
  if (!is_box_with_hull(pair.a().shape(), pair.b().shape())) return -pair.centre_b();
  const BoxAxes<Scalar> box(pair);
  const Vec3<Scalar> centre = box(pair.centre_b());
  const Vec3<Scalar> way = box.nearest(centre) - centre;
  return way.isZero(0) ? Vec3<Scalar>(-pair.centre_b()) : Vec3<Scalar>(box.edges * way);
}

// Returns the contact, if the corner of b in a point of the difference is on a face of the box, and b reaches no further
// there, both within rounding.
template <class Scalar>
std::optional<FaceContact<Scalar>> find_box_face_contact(SupportPair<Scalar>& pair,
                                                         const DifferencePoint<Scalar>& point) {
  constexpr Scalar rounding = SupportPair<Scalar>::rounding;
  const BoxAxes<Scalar> box(pair);
  Vec3<Scalar> local = box(point.b);
  int face = 0;
  (local.cwiseAbs() - box.half).maxCoeff(&face);
  // A flat box has both sides of this face at the corner: that of the hull's centre is meant.
  const Scalar towards =
      box.half[face] > 0 ? local[face] : box.edges.col(face).dot(pair.centre_b());
  local = box.nearest(local);
  local[face] = std::copysign(box.half[face], towards);
  FaceContact<Scalar> contact;
  const Vec3<Scalar> on_box = box.edges * local;
  contact.triangle.size = 1;
  contact.triangle.points[0] = {on_box - point.b, on_box, point.b};
  contact.triangle.weights[0] = 1;
  contact.upper = contact.triangle.points[0].difference.norm();
  const Scalar length = box.edges.col(face).norm();
  if (!(contact.upper <= rounding && length > box.unit / 2)) return {};
  contact.normal = box.edges.col(face) * std::copysign(1 / length, towards);
  const Scalar height = contact.normal.dot(pair.support(contact.normal).difference);
  if (!(height <= rounding)) return {};
  contact.lower = std::min(-height, Scalar{0});
  return contact;
}

}  // namespace touchstone
