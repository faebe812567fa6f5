// The search of ellipsoid_contact.h: bracketed Newton steps on the weight.
#include "algorithms/narrow_phase/ellipsoid/ellipsoid_contact.h"

#include <algorithm>
#include <cmath>

#include "algorithms/narrow_phase/ellipsoid/cofactors.h"

namespace touchstone {
template <class Scalar>
EllipsoidContact<Scalar> contact(const EllipsoidPair<Scalar>& pair, int most_iterations) {
  constexpr Scalar rounding = EllipsoidPair<Scalar>::rounding;
  // Rounding loses the lighter matrix if its weight is below this.
  constexpr Scalar lightest = std::numeric_limits<Scalar>::epsilon();
  const Vec3<Scalar>& c = pair.centre;
  EllipsoidContact<Scalar> found;
  Mat3<Scalar> aa = pair.pp;
  if (pair.is_ball) aa = pair.radius * pair.radius * Mat3<Scalar>::Identity();
  const auto turned_a = [&](const Vec3<Scalar>& n) -> Vec3<Scalar> {
    return pair.is_ball ? Vec3<Scalar>(pair.radius * n) : Vec3<Scalar>(pair.p.transpose() * n);
  };
  const auto a_times = [&](const Vec3<Scalar>& x) -> Vec3<Scalar> {
    return pair.is_ball ? Vec3<Scalar>(pair.radius * x) : Vec3<Scalar>(pair.p * x);
  };
  // Lower bound on the semi-axes of both bodies together; computed when first needed.
  Scalar shortest = -1;

  Vec3<Scalar> n = c;
  Scalar low = 0, high = 1;  // of the weight b
  Scalar a = 0, b = 0;
  for (;;) {
    const Vec3<Scalar> pn = turned_a(n), qn = pair.q.transpose() * n;
    const Scalar reach_a = pn.norm(), reach_b = qn.norm();
    if (n.dot(c) - reach_a - reach_b > rounding * n.norm()) {
      found.answer = Answer::separated;
      break;
    }
    if (found.iterations == most_iterations) break;
    if (found.iterations == 0) {
      const Scalar sum = reach_a + reach_b;
      b = sum > 0 ? std::clamp(reach_a / sum, Scalar{1e-3f}, Scalar{1 - 1e-3f}) : Scalar{0.5f};
      a = 1 - b;
    } else {
      const Scalar scale_a = a * reach_a, scale_b = b * reach_b;
      const Vec3<Scalar> in_a = a_times(pn), in_b = pair.q * qn;
      const Scalar room = 1 - std::max(scale_a, scale_b);
      if (room > 0) {
        // The bodies, scaled about the point to the remaining room, have a difference that contains
        // a ball of this radius.
        if (shortest < 0) {
          const Mat3<Scalar> both = aa + pair.qq;
          shortest = std::sqrt(Cofactors<Scalar>(both).least(both.trace()));
        }
        const Scalar off = (a * in_a + b * in_b - c).norm();
        if (room * shortest > off + rounding * (1 + n.norm())) {
          found.answer = Answer::overlapping;
          break;
        }
      }
      // A Newton step on the slope of the concave function, kept inside the bracket of its root.
      const Scalar slope = (scale_a - scale_b) * (scale_a + scale_b);
      (slope > 0 ? low : high) = b;
      const Vec3<Scalar> turn = Cofactors<Scalar>(a * aa + b * pair.qq).solve(in_a - in_b);
      const Scalar bend = -2 * (a * reach_a * reach_a + b * reach_b * reach_b) +
                          2 * (a * a * in_a - b * b * in_b).dot(turn);
      const Scalar before = b;
      b -= slope / bend;
      if (!(b > low && b < high)) b = (low + high) / 2;
      if (!(std::abs(b - before) > lightest * std::min(a, before))) break;
      a = 1 - b;
    }
    ++found.iterations;
    const Cofactors<Scalar> sum(a * aa + b * pair.qq);
    if (!(sum.determinant > 0)) break;
    n = sum.solve(c);
  }
  const Scalar length = n.norm();
  found.normal = length > 0 ? Vec3<Scalar>(n / length) : Vec3<Scalar>::UnitX();
  return found;
}

template EllipsoidContact<float> contact(const EllipsoidPair<float>&, int);
template EllipsoidContact<double> contact(const EllipsoidPair<double>&, int);

}  // namespace touchstone
