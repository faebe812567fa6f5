// Two boxes: the 15 axes in closed form. Used by sat, closed-form and clipped-faces.
#pragma once

#include "algorithms/kernels/sat/separating_axis.h"

namespace touchstone {

// Returns the axis with the greatest gap among the 6 face normals and 9 edge pairs, or the first
// that separates. Both bodies of the pair must be boxes. Adds the number of axes to `tested`.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996, section 5.
// Departs: the products hold for any matrices instead of rotations only. If two edges are not
//          nearly perpendicular and their axis matters, it is measured again along a vector made
//          orthogonal to one of them.
template <class Scalar>
Axis<Scalar> box_axis(const PolytopePair<Scalar>& pair, int& tested);

// Like PolytopePair::axis_along, for two boxes.
template <class Scalar>
Axis<Scalar> box_axis_along(const PolytopePair<Scalar>& pair, const Vec3<Scalar>& normal);

extern template Axis<float> box_axis_along(const PolytopePair<float>&, const Vec3<float>&);
extern template Axis<double> box_axis_along(const PolytopePair<double>&, const Vec3<double>&);
extern template Axis<float> box_axis(const PolytopePair<float>&, int&);
extern template Axis<double> box_axis(const PolytopePair<double>&, int&);

}  // namespace touchstone
