// GJK's fast iteration for any cores, and its test that a tetrahedron contains the origin.
#include "algorithms/kernels/gjk/gjk_iteration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/kernels/gjk/gjk_iteration_levels.inl"

namespace touchstone {

// The determinants of the corners by threes, each with the origin, keep their signs. Let corners p,
// q, s be no longer than m and off by r = 107 u (proven in certified/proven_rounding.h; u is half
// of epsilon). Their determinant changes by no more than r (|p x q| + |q x s| + |s x p|) + 3 r^2 m
// + r^3, which is less than 3 r m^2 + 3 r^2 m + r^3. It is off by 50 u m^3 of its own rounding; no
// determinant exceeds m^3. So 512 u m^2 (1 + m) suffices. If the origin is near a face that bound
// is far too large. Then the products themselves are taken, which are off by 16 u m^2 of their own
// rounding, all three.
template <class Scalar>
bool is_surely_inside(const Simplex<Scalar>& simplex) {
  constexpr Scalar u = std::numeric_limits<Scalar>::epsilon() / 2;
  const auto w = [&](int i) -> const Vec3<Scalar>& { return simplex.points[i].difference; };
  std::array<Scalar, 4> squares;
  for (int i = 0; i < 4; ++i) squares[i] = w(i).squaredNorm();
  const Scalar greatest = std::ranges::max(squares);
  const Scalar longest = std::sqrt(greatest);
  const auto determinant = [&](int i, int j, int k) {
    return w(i).dot((w(j) - w(i)).cross(w(k) - w(i)));
  };
  // Determinants of the faces opposite each corner.
  const std::array<Scalar, 4> parts = {determinant(1, 2, 3), -determinant(0, 2, 3),
                                       determinant(0, 1, 3), -determinant(0, 1, 2)};
  const auto [least, most] = std::ranges::minmax(parts);
  // Longer vectors belong to bodies beyond the range of the pair's unit, for which this bound on
  // the rounding does not hold.
  constexpr Scalar longest_in_range = 16;
  if (!(longest <= longest_in_range) || !(least > 0 || most < 0)) return false;
  const Scalar quickly = 512 * u * greatest * (1 + longest);
  if (least > quickly || most < -quickly) return true;
  // The face that is most in doubt comes first.
  const auto doubt = [&](int i, int j) { return std::abs(parts[i]) < std::abs(parts[j]) ? i : j; };
  const int first = doubt(doubt(0, 1), doubt(2, 3));
  constexpr Scalar r = corner_rounding<Scalar>;
  // Less than the first of the areas below.
  const Scalar base = r * r * w((first + 1) % 4).cross(w((first + 2) % 4)).squaredNorm();
  if (parts[first] * parts[first] < Scalar(0.99) * base) return false;
  for (int k = 0; k < 4; ++k) {
    const int i = (first + k) % 4, p = (i + 1) % 4, q = (i + 2) % 4, s = (i + 3) % 4;
    const auto area = [&](int j, int l) { return w(j).cross(w(l)).norm(); };
    const Scalar areas = area(p, q) + area(q, s) + area(p, s);
    // Of the face's own corners, since one may be far from the others.
    const Scalar square = std::max({squares[p], squares[q], squares[s]});
    const Scalar length = std::sqrt(square);
    const Scalar rest = r * (16 * u * square + 3 * r * length + r * r) + 64 * u * square * length;
    if (!(std::abs(parts[i]) > r * areas + rest)) return false;
  }
  return true;
}

template <class Scalar>
bool find_enclosing_tetrahedron(Simplex<Scalar>& simplex, const DifferencePoint<Scalar>& behind) {
  for (std::size_t k = 0; k < 3; ++k) {
    Simplex<Scalar> other = simplex;
    other.points[k] = behind;
    if (!is_surely_inside(other)) continue;
    simplex = other;
    return true;
  }
  return false;
}

template <class Scalar>
FastGjkResult<Scalar> fast_gjk(SupportPair<Scalar>& pair, const FastGjkGoal& goal, Scalar tolerance,
                               const FastGjkStart<Scalar>& start) {
  return goal.numbered
             ? fast_gjk_at_level<true, GenericCore, GenericCore>(pair, goal, tolerance, start)
             : fast_gjk_at_level<false, GenericCore, GenericCore>(pair, goal, tolerance, start);
}

template bool is_surely_inside(const Simplex<float>&);
template bool is_surely_inside(const Simplex<double>&);
template bool find_enclosing_tetrahedron(Simplex<float>&, const DifferencePoint<float>&);
template bool find_enclosing_tetrahedron(Simplex<double>&, const DifferencePoint<double>&);
template FastGjkResult<float> fast_gjk(SupportPair<float>&, const FastGjkGoal&, float,
                                       const FastGjkStart<float>&);
template FastGjkResult<double> fast_gjk(SupportPair<double>&, const FastGjkGoal&, double,
                                        const FastGjkStart<double>&);

}  // namespace touchstone
