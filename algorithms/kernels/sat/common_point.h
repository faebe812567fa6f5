// Where two polytopes meet across an axis: the witness points of a separating-axis test.
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone {

template <class Scalar>
struct PlacedPolytope;

// In the frame and unit of the pair.
template <class Scalar>
struct CommonPoint {
  Vec3<Scalar> a, b;
};

// The closest points, seen along `normal` (unit, from a to b), of the features that support the
// bodies there: the vertices of a within `tolerance` of its furthest along the normal, and of b
// against it. Where the axis is that of least penetration the two features meet as seen along it,
// and a - b is -gap * normal up to rounding. Both points then lie on their bodies up to
// `tolerance`.
template <class Scalar>
CommonPoint<Scalar> common_point(const PlacedPolytope<Scalar>& a, const PlacedPolytope<Scalar>& b,
                                 const Vec3<Scalar>& normal, Scalar gap, Scalar tolerance);

extern template CommonPoint<float> common_point(const PlacedPolytope<float>&,
                                                const PlacedPolytope<float>&, const Vec3<float>&,
                                                float, float);
extern template CommonPoint<double> common_point(const PlacedPolytope<double>&,
                                                 const PlacedPolytope<double>&, const Vec3<double>&,
                                                 double, double);

}  // namespace touchstone
