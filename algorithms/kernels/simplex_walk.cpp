#include "algorithms/kernels/simplex_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/kernels/simplex_walk_levels.inl"

namespace touchstone {
// The determinants of its corners by threes, each with the origin, keep their signs. With corners
// no longer than m that are off by r = 107 u (proven_rounding says why; u is half of epsilon) they
// are off by 3 r m^2 + 3 r^2 m + r^3, and by 50 u m^3 of their own rounding; none exceeds m^3. So
// 512 u m^2 (1 + m) is enough.
template <class Scalar>
bool is_surely_inside(const Simplex<Scalar>& simplex) {
  constexpr Scalar factor = 256 * std::numeric_limits<Scalar>::epsilon();
  const auto w = [&](int i) -> const Vec3<Scalar>& { return simplex.points[i].difference; };
  Scalar longest = 0;
  for (int i = 0; i < 4; ++i) longest = std::max(longest, w(i).squaredNorm());
  const Scalar enough = factor * longest * (1 + std::sqrt(longest));
  const auto determinant = [&](int i, int j, int k) {
    return w(i).dot((w(j) - w(i)).cross(w(k) - w(i)));
  };
  const std::array<Scalar, 4> parts = {determinant(1, 2, 3), -determinant(0, 2, 3),
                                       determinant(0, 1, 3), -determinant(0, 1, 2)};
  const auto [least, most] = std::ranges::minmax(parts);
  return least > enough || most < -enough;
}

template <class Scalar>
Walk<Scalar> walk(SupportPair<Scalar>& pair, const WalkGoal& goal, Scalar tolerance,
                  const WalkStart<Scalar>& start) {
  return goal.numbered ? walk_here<true, AnyCore, AnyCore>(pair, goal, tolerance, start)
                       : walk_here<false, AnyCore, AnyCore>(pair, goal, tolerance, start);
}

template bool is_surely_inside(const Simplex<float>&);
template bool is_surely_inside(const Simplex<double>&);
template Walk<float> walk(SupportPair<float>&, const WalkGoal&, float, const WalkStart<float>&);
template Walk<double> walk(SupportPair<double>&, const WalkGoal&, double, const WalkStart<double>&);

}  // namespace touchstone
