// Two boxes: the 15 axes in closed form.
#pragma once

#include "algorithms/kernels/sat/separating_axis.h"

namespace touchstone {

// The axis of the greatest gap among the 6 face normals and 9 edge pairs, or the first that
// separates. Both bodies of the pair are boxes; `tested` is raised by the number of axes.
// Paper: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996, section 5. Departs: the products hold
// for any matrices, not just for rotations, and the axes of edges that are not nearly square to
// each other are measured again along a vector made orthogonal to one of them, where they matter.
template <class Scalar>
Axis<Scalar> box_axis(const PolytopePair<Scalar>& pair, int& tested);

// PolytopePair::axis_along for two boxes.
template <class Scalar>
Axis<Scalar> box_axis_along(const PolytopePair<Scalar>& pair, const Vec3<Scalar>& normal);

extern template Axis<float> box_axis_along(const PolytopePair<float>&, const Vec3<float>&);
extern template Axis<double> box_axis_along(const PolytopePair<double>&, const Vec3<double>&);
extern template Axis<float> box_axis(const PolytopePair<float>&, int&);
extern template Axis<double> box_axis(const PolytopePair<double>&, int&);

}  // namespace touchstone
