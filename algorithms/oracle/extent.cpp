// Part of the oracle: separation along a direction and containment in a box. Both need one support
// value.
#include <cmath>
#include <limits>

#include "algorithms/oracle/half_space.h"
#include "algorithms/oracle/numbers/dyadic.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::oracle {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

IntegerVector to_integers(const Vec3d& n) {
  std::array<Dyadic, 3> parts;
  int exponent = Dyadic::of_zero;
  for (int k = 0; k < 3; ++k) {
    parts[k] = dyadic(n[k]);
    exponent = std::min(exponent, parts[k].exponent);
  }
  return {parts[0].over_power(exponent), parts[1].over_power(exponent),
          parts[2].over_power(exponent)};
}

// Support of the difference of the cores along n, divided by |n|.
struct Reach {
  SignedRoot low, high;
};

Reach reach(GridPair& pair, const IntegerVector& n) {
  const Filters filters;
  const Direction direction = make_direction(n);
  const int shift = pair.is_curved() ? GridPair::root_shift : 0;
  const Integer square = dot(n, n) << (2 * shift);
  const Integer high = pair.support_above(direction, shift, filters.support);
  const Integer low =
      pair.is_curved() ? pair.support_below(direction, shift, filters.support) : high;
  return {pair.in_metres(low.sign(), low * low, square),
          pair.in_metres(high.sign(), high * high, square)};
}

SignedRoot negated(SignedRoot root) {
  root.sign = -root.sign;
  return root;
}

bool same_direction(const IntegerVector& u, const IntegerVector& v) {
  return is_zero(cross(u, v)) && dot(u, v) > 0;
}

}  // namespace

Enclosure separation_along(const Body& a, const Body& b, const Vec3d& n) {
  const IntegerVector direction = to_integers(n);
  if (is_half_space(a) || is_half_space(b)) {
    // Separation is possible only along the plane's normal, and equals the pair's signed distance.
    if (is_half_space(a) && !same_direction(exact_half_space(a).normal, direction))
      return {inf, inf};
    if (is_half_space(b) && !same_direction(exact_half_space(b).normal, -direction))
      return {inf, inf};
    const Measure measure = Oracle().measure(a, b);
    return {-measure.upper, -measure.lower};
  }
  GridPair pair;
  pair.place(a, b);
  pair.place_exactly();
  const Reach found = reach(pair, direction);
  const double radius_a = a.solid->radius, radius_b = b.solid->radius;
  return {-round_less(negated(found.low), radius_a, radius_b).high,
          -round_less(negated(found.high), radius_a, radius_b).low};
}

bool holds(const Aabb& box, const Body& body) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      const double side = sign > 0 ? box.max[axis] : -static_cast<double>(box.min[axis]);
      if (std::isinf(side) && side > 0) continue;
      Vec3d n = Vec3d::Zero();
      n[axis] = sign;
      // Compares the body with the point where the box's side meets the axis.
      Pose pose;
      pose.translation[axis] = std::isinf(side) ? 0 : sign * side;
      const Solid point{Shape{}};
      const Body on_side(point, pose);
      if (std::isinf(side) || separation_along(body, on_side, n).upper > 0) return false;
    }
  }
  return true;
}

}  // namespace touchstone::oracle
