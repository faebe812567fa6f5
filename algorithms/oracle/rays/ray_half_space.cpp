// The height of the ray's points above the plane is linear in t: a sum of integers times powers of two.
#include "algorithms/oracle/rays/ray_half_space.h"

#include <algorithm>

#include "algorithms/oracle/half_space.h"
#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle {
namespace {

// value * 2^exponent
struct Term {
  Integer value;
  long exponent;
};

// The product of vectors; the second is a plain one.
Term product(const IntegerVector& normal, const Vec3d& v) {
  Term sum{0, 0};
  int least = Dyadic::of_zero;
  for (int k = 0; k < 3; ++k) least = std::min(least, dyadic(v[k]).exponent);
  for (int k = 0; k < 3; ++k) {
    sum.value += normal[static_cast<std::size_t>(k)] * dyadic(v[k]).over_power(least);
  }
  sum.exponent = sum.value.is_zero() ? 0 : least;
  return sum;
}

Term difference(Term a, Term b) {
  const long least = std::min(a.exponent, b.exponent);
  a.value <<= a.exponent - least;
  b.value <<= b.exponent - least;
  return {a.value - b.value, least};
}

}  // namespace

bool has_plane(const Body& half_space) { return !is_zero(exact_half_space(half_space).normal); }

std::optional<RayPoint> first_point_below(const Vec3d& origin, const Vec3d& direction,
                                          const Body& half_space) {
  const ExactHalfSpace plane = exact_half_space(half_space);
  Term height =
      difference(product(plane.normal, origin), product(plane.normal, half_space.translation));
  height.value *= plane.denominator;
  height = difference(height, {plane.offset, plane.exponent});
  if (height.value <= 0) return RayPoint{0, 1, 0, 0};
  Term fall = product(plane.normal, direction);
  fall.value *= -plane.denominator;
  if (fall.value <= 0) return {};
  const long least = std::min(height.exponent, fall.exponent);
  return RayPoint{height.value << (height.exponent - least), fall.value << (fall.exponent - least),
                  0, 0};
}

}  // namespace touchstone::oracle
