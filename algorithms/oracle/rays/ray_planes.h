// Part of the oracle: planes that part a ray from boxes and bodies, found in doubles and decided in rationals.
#pragma once

#include <functional>
#include <optional>

#include "algorithms/oracle/certificates/parts/ray_at_parts.h"
#include "algorithms/oracle/concave/group_plane.h"

namespace touchstone::oracle {

Vec3d rounded_vector(const RationalVector& v);
Integer integer(const mpz_class& x);

// The greatest length of a vector from the origin to a point of the box.
double reach_of(const RationalBox& box);

// The way from the origin to the end of the span; without an end, to where the ray is past all that reaches so far
// from the world's origin.
Vec3d way_of(const RaySpan& span, double reach);

// Whether the planes along the direction do what they have to.
using IsParted = std::function<bool(const RationalVector& n)>;

// The direction, or, if that does not do for a ray without end, the one next to it that is across the ray.
std::optional<IntegerVector> parting(const IntegerVector& direction, const RaySpan& span,
                                     const IsParted& is_parted);

// A direction from the ray, which goes `way` within the span, to the group and balls of this radius around it.
std::optional<IntegerVector> plane_off(const RaySpan& span, const Vec3d& way,
                                       const RoundedGroup& group, double radius,
                                       const IsParted& is_parted);

}  // namespace touchstone::oracle
