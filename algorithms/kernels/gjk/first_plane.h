// The first step of GJK between two bodies with corners, before anything is prepared for more: the
// plane across the line of centres. Used by gjk_query for yes or no.
//
// Most pairs that are apart are parted by it. Each body is asked how far it reaches along the line;
// the corner that does is kept for the next step, and its place in the world is not needed.
// Paper:   Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4(2), 1988 (the first support
//          plane is a bound on the distance).
// Cost:    21 products, and a scan of the hulls' vertices.
#pragma once

#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

struct FirstPlane {
  bool parts = false;  // proven
  CornerPair corners;  // those that are furthest along the line of centres
};

// Whether it is worth while: the second core is a hull whose vertices are scanned, the first is one or
// a box, and their centres are so far apart that the bodies probably are. It may be asked whether or
// not.
template <class Scalar>
bool may_be_parted(const CentreOffset& offset, const SupportShape<Scalar>& a,
                   const SupportShape<Scalar>& b) {
  constexpr double share = 0.7;
  const auto is_scanned = [](const SupportShape<Scalar>& shape) {
    return shape.core == SupportCore::hull && shape.cells.empty();
  };
  const double near = share * (a.size + b.size);
  return (is_scanned(a) || a.core == SupportCore::box) && is_scanned(b) &&
         offset.vector.squaredNorm() > near * near;
}

// `offset` is that of the centres of two such bodies without radius.
template <class Scalar>
FirstPlane first_plane(const CentreOffset& offset, const SupportShape<Scalar>& a,
                       const Pose& pose_a, const SupportShape<Scalar>& b, const Pose& pose_b);

extern template FirstPlane first_plane(const CentreOffset&, const SupportShape<float>&, const Pose&,
                                       const SupportShape<float>&, const Pose&);
extern template FirstPlane first_plane(const CentreOffset&, const SupportShape<double>&,
                                       const Pose&, const SupportShape<double>&, const Pose&);

}  // namespace touchstone
