// The witness points of a separating-axis test. Used by separating_axis.cpp for sat, sat-faces,
// closed-form and clipped-faces.
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone {

template <class Scalar>
struct PlacedPolytope;

// Coordinates are in the frame and unit of the pair.
template <class Scalar>
struct WitnessPoints {
  Vec3<Scalar> a, b;
};

// Returns the closest points, seen along `normal` (unit, from a to b), of the features that support
// the bodies: the vertices of a within `tolerance` of its furthest along the normal, and those of b
// against it. If the axis is that of least penetration, the features meet when seen along it, and a
// - b is -gap * normal up to rounding. Both points then lie on their bodies up to `tolerance`.
template <class Scalar>
WitnessPoints<Scalar> witness_points(const PlacedPolytope<Scalar>& a,
                                     const PlacedPolytope<Scalar>& b, const Vec3<Scalar>& normal,
                                     Scalar gap, Scalar tolerance);

extern template WitnessPoints<float> witness_points(const PlacedPolytope<float>&,
                                                    const PlacedPolytope<float>&,
                                                    const Vec3<float>&, float, float);
extern template WitnessPoints<double> witness_points(const PlacedPolytope<double>&,
                                                     const PlacedPolytope<double>&,
                                                     const Vec3<double>&, double, double);

}  // namespace touchstone
