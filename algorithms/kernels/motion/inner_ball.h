// Balls inside of cores, which prove that a point between such a ball and a point of the core is in the
// core too, however the core's faces meet there. Used by gjk-ray-cast and by the loop of conservative
// advancement (advancement.h).
#pragma once

#include "algorithms/kernels/minkowski/support_shape.h"

namespace touchstone {

// The radius (metres) of a ball about the centre of a core, as support shapes have it, that the core
// holds; rounded down, and 0 for cores without volume or if it is not known.
double inner_radius(const Shape& shape, const SupportShape<double>& support);

// The same for each shape.
std::vector<double> inner_radii(std::span<const Shape> shapes,
                                std::span<const SupportShape<double>> support_shapes);

// Returns true if the origin is surely in the ball, or between it and the point: the ray from the point
// through the origin meets the ball, also if point and centre are off by `rounding`.
bool is_in_front_of_ball(const Vec3d& point, const Vec3d& centre, double radius, double rounding);

}  // namespace touchstone
