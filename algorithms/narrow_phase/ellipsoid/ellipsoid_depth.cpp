// The proof of least depth by inner ellipsoids, and the branch and bound over normals.
#include "algorithms/narrow_phase/ellipsoid/ellipsoid_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace touchstone {
namespace {

template <class Scalar>
constexpr Scalar rounding = EllipsoidPair<Scalar>::rounding;

// Ellipsoids E inside the sum of both cores that touch it along a plane's normal: one for each
// rotation S around the normal, or reflection.
template <class Scalar>
class InnerEllipsoids {
 public:
  InnerEllipsoids(const EllipsoidPair<Scalar>& pair, const EllipsoidPlane<Scalar>& plane)
      : is_ball_(pair.is_ball), along_(plane.a - plane.b) {
    if (is_ball_) {
      a1_ = pair.q.col(0);
      a2_ = pair.q.col(1);
      along_ = pair.q.col(2);
      return;
    }
    const Vec3<Scalar> u = plane.per_reach_a * (pair.p.transpose() * plane.normal);
    const Vec3<Scalar> v = plane.per_reach_b * (pair.q.transpose() * plane.normal);
    const Vec3<Scalar> u1 = u.unitOrthogonal(), u2 = u.cross(u1);
    const Vec3<Scalar> v1 = v.unitOrthogonal(), v2 = v.cross(v1);
    a1_.noalias() = pair.p * u1;
    a2_.noalias() = pair.p * u2;
    b1_.noalias() = pair.q * v1;
    b2_.noalias() = pair.q * v2;
  }

  // Returns E E^T for the rotation's cosine and sine; `mirror` is -1 for a reflection, else 1.
  Mat3<Scalar> turned(Scalar cosine, Scalar sine, Scalar mirror) const {
    if (is_ball_) return squares(a1_, a2_);
    return squares(a1_ + cosine * b1_ + sine * b2_, a2_ + mirror * (cosine * b2_ - sine * b1_));
  }
  // Returns the E E^T with the greatest sum of squares.
  Mat3<Scalar> greatest() const {
    if (is_ball_) return squares(a1_, a2_);
    const Scalar a1b1 = a1_.dot(b1_), a1b2 = a1_.dot(b2_);
    const Scalar a2b1 = a2_.dot(b1_), a2b2 = a2_.dot(b2_);
    const Scalar plain = std::hypot(a1b1 + a2b2, a1b2 - a2b1);
    const Scalar mirrored = std::hypot(a1b1 - a2b2, a1b2 + a2b1);
    if (!(std::max(plain, mirrored) > 0)) return turned(1, 0, 1);
    if (plain >= mirrored) return turned((a1b1 + a2b2) / plain, (a1b2 - a2b1) / plain, 1);
    return turned((a1b1 - a2b2) / mirrored, (a1b2 + a2b1) / mirrored, -1);
  }
  bool is_one() const { return is_ball_; }

 private:
  Mat3<Scalar> squares(const Vec3<Scalar>& first, const Vec3<Scalar>& second) const {
    return along_ * along_.transpose() + first * first.transpose() + second * second.transpose();
  }

  bool is_ball_;
  Vec3<Scalar> along_, a1_, a2_, b1_, b2_;
};

// Returns true if a symmetric matrix has no negative eigenvalue.
template <class Scalar>
bool has_none_negative(const Mat3<Scalar>& m) {
  const Scalar d0 = m(0, 0);
  if (!(d0 > 0)) return false;
  const Scalar l1 = m(1, 0) / d0, l2 = m(2, 0) / d0;
  const Scalar d1 = m(1, 1) - l1 * m(1, 0);
  if (!(d1 > 0)) return false;
  const Scalar off = m(2, 1) - l1 * m(2, 0);
  return m(2, 2) - l2 * m(2, 0) - off * off / d1 >= 0;
}

// A bound without proof: the cores are no further apart than two of their points.
template <class Scalar>
Scalar nothing_known(const EllipsoidPlane<Scalar>& plane) {
  return -plane.between.norm() - rounding<Scalar>;
}

// A lower bound on the overlap along every normal, if the inner ellipsoid proves one near the
// plane's own; otherwise `nothing_known`.
template <class Scalar>
Scalar proven(const EllipsoidPlane<Scalar>& plane, const Mat3<Scalar>& inner) {
  const Scalar depth = -plane.gap, reach = plane.reach_a + plane.reach_b;
  // If b moved by the slide, the plane would be stationary.
  const Scalar least = depth - plane.slide.norm();
  if (!(depth > 0)) return least;
  // Bound on the error of the eigenvalues.
  const Scalar slack = rounding<Scalar> / 4 * inner.trace();
  Mat3<Scalar> rest = inner;
  rest.diagonal().array() -= depth * reach + slack;
  if (has_none_negative(rest)) return least;
  // A circle of minima, as between equal bodies, has an eigenvalue of zero.
  rest.diagonal().array() += 2 * slack;
  return reach > 0 && has_none_negative(rest) ? least - 2 * slack / reach : nothing_known(plane);
}

// Normals around a minimum's along which no overlap is less than `enough`.
template <class Scalar>
struct Cap {
  Vec3<Scalar> normal;
  Scalar angle;
};

// The lesser nonzero eigenvalue of a symmetric matrix whose third eigenvalue is zero.
template <class Scalar>
Scalar least_across(const Mat3<Scalar>& across) {
  const Scalar trace = across.trace();
  const Scalar minors = across(0, 0) * across(1, 1) - across(0, 1) * across(0, 1) +
                        across(0, 0) * across(2, 2) - across(0, 2) * across(0, 2) +
                        across(1, 1) * across(2, 2) - across(1, 2) * across(1, 2);
  return (trace - std::sqrt(std::max(trace * trace - 4 * minors, Scalar{0}))) / 2;
}

template <class Scalar>
Cap<Scalar> cap_around(const EllipsoidPlane<Scalar>& plane, const Mat3<Scalar>& inner,
                       Scalar enough) {
  const Vec3<Scalar>& n = plane.normal;
  const Scalar reach = plane.reach_a + plane.reach_b;
  const Vec3<Scalar> touch = plane.a - plane.b;
  const Scalar askew = (touch - n.dot(touch) * n).norm();
  const Mat3<Scalar> across = inner - touch * touch.transpose();
  const Scalar least = least_across<Scalar>(across) - rounding<Scalar>;
  Scalar angle = 1;
  for (; angle > Scalar{1e-3f}; angle *= Scalar{0.8f}) {
    const Scalar sine = std::sin(angle), fall = 1 - std::cos(angle);
    const Scalar missing = enough + plane.gap * (1 - fall);
    if (!(missing > 0)) break;
    if (missing * (missing + 2 * (reach + sine * askew)) <= sine * sine * least) break;
  }
  return {n, angle > Scalar{1e-3f} ? angle : Scalar{0}};
}

template <class Scalar>
struct Triangle {
  std::array<Vec3<Scalar>, 3> corners;  // unit vectors
  Scalar lower;                         // lower bound on the overlap in it
  int level;
};

template <class Scalar>
class Search {
 public:
  Search(const EllipsoidPair<Scalar>& pair, const EllipsoidPlane<Scalar>& plane, Scalar tolerance,
         const ClimbGoal& goal)
      : pair_(pair), goal_(goal), tolerance_(tolerance) {
    best_.plane = plane;
    const InnerEllipsoids<Scalar> inner(pair, plane);
    best_.lower = proven(plane, inner.greatest());
    if (!is_proven()) keep(plane, inner);
  }

  EllipsoidDepth<Scalar> run(int most_caps) {
    if (is_proven() || most_caps <= 0) return best_;
    std::array<Triangle<Scalar>, 8 + 3 * deepest> open;
    int count = 0;
    for (int octant = 0; octant < 8; ++octant) {
      const auto axis = [&](int k) -> Vec3<Scalar> {
        return (octant >> k & 1) != 0 ? Vec3<Scalar>(-Vec3<Scalar>::Unit(k))
                                      : Vec3<Scalar>(Vec3<Scalar>::Unit(k));
      };
      open[count++] = {{axis(0), axis(1), axis(2)}, best_.lower, 0};
    }
    Scalar unresolved = std::numeric_limits<Scalar>::infinity();
    while (count > 0) {
      const Triangle<Scalar> triangle = open[--count];
      if (most_caps-- <= 0 || triangle.level == deepest) {
        unresolved = std::min(unresolved, triangle.lower);
        continue;
      }
      ++best_.iterations;
      const Scalar lower = std::max(triangle.lower, bound(triangle));
      if (is_proven()) return best_;
      if (lower >= -best_.plane.gap - tolerance_) continue;
      const auto& [x, y, z] = triangle.corners;
      const Vec3<Scalar> xy = (x + y).normalized(), yz = (y + z).normalized(),
                         zx = (z + x).normalized();
      const int level = triangle.level + 1;
      open[count++] = {{x, xy, zx}, lower, level};
      open[count++] = {{y, yz, xy}, lower, level};
      open[count++] = {{z, zx, yz}, lower, level};
      open[count++] = {{xy, yz, zx}, lower, level};
    }
    best_.lower = std::max(best_.lower, std::min(unresolved, -best_.plane.gap - 2 * tolerance_));
    return best_;
  }

 private:
  static constexpr int deepest = 10;

  bool is_proven() const { return best_.lower >= -best_.plane.gap - 4 * tolerance_; }

  void keep(const EllipsoidPlane<Scalar>& plane, const InnerEllipsoids<Scalar>& inner) {
    // A slide amounts to another position of b.
    const Scalar slide = plane.slide.norm();
    if (caps_ == static_cast<int>(kept_.size()) || slide > tolerance_) return;
    const Vec3<Scalar> touch = plane.a - plane.b;
    Mat3<Scalar> best = inner.greatest();
    Scalar least = least_across<Scalar>(best - touch * touch.transpose());
    constexpr int turns = 12;
    for (int k = 0; k < 2 * turns && !inner.is_one(); ++k) {
      const Scalar angle = static_cast<Scalar>(k / 2 * (2 * std::numbers::pi / turns));
      const Mat3<Scalar> other =
          inner.turned(std::cos(angle), std::sin(angle), k % 2 == 0 ? Scalar{1} : Scalar{-1});
      const Scalar of_other = least_across<Scalar>(other - touch * touch.transpose());
      if (!(of_other > least)) continue;
      least = of_other;
      best = other;
    }
    kept_[caps_++] = cap_around(plane, best, -best_.plane.gap - tolerance_ + slide);
  }

  // Lower bound on the overlap over all normals in the triangle. Updates the best minimum if it
  // finds a better one.
  Scalar bound(const Triangle<Scalar>& triangle) {
    const auto& [x, y, z] = triangle.corners;
    const Vec3<Scalar> middle = (x + y + z).normalized();
    const Scalar cosine = std::min({middle.dot(x), middle.dot(y), middle.dot(z)});
    const Scalar sine = std::sqrt(std::max(1 - cosine * cosine, Scalar{0}));
    const Scalar angle = std::atan2(sine, cosine);
    const auto in_a_cap = [&] {
      for (int k = 0; k < caps_; ++k) {
        const Scalar away =
            2 * std::asin(std::min((middle - kept_[k].normal).norm() / 2, Scalar{1}));
        if (away + angle <= kept_[k].angle) return true;
      }
      return false;
    };
    if (in_a_cap()) return -best_.plane.gap - tolerance_;
    const EllipsoidPlane<Scalar> plane(pair_, middle);
    const Scalar depth = -plane.gap;
    const Scalar lower = depth * (depth > 0 ? cosine : Scalar{1}) - plane.slide.norm() * sine;
    const bool better = plane.gap > best_.plane.gap + tolerance_;
    if (better || (triangle.level >= 2 && lower < -best_.plane.gap - tolerance_ &&
                   caps_ < static_cast<int>(kept_.size()))) {
      meet(middle);
      if (is_proven() || in_a_cap()) return -best_.plane.gap - tolerance_;
    }
    return lower;
  }

  void meet(const Vec3<Scalar>& start) {
    const Climb<Scalar> found = climb(pair_, start, goal_, tolerance_);
    best_.iterations += found.iterations;
    for (int k = 0; k < caps_; ++k) {
      if ((kept_[k].normal - found.plane.normal).squaredNorm() < Scalar{1e-6f}) return;
    }
    const InnerEllipsoids<Scalar> inner(pair_, found.plane);
    if (found.plane.gap > best_.plane.gap) {
      best_.plane = found.plane;
      best_.lower = proven(found.plane, inner.greatest());
    }
    if (!is_proven()) keep(found.plane, inner);
  }

  const EllipsoidPair<Scalar>& pair_;
  ClimbGoal goal_;
  Scalar tolerance_;
  EllipsoidDepth<Scalar> best_;
  std::array<Cap<Scalar>, 12> kept_;
  int caps_ = 0;
};

}  // namespace

template <class Scalar>
EllipsoidDepth<Scalar> ellipsoid_depth(const EllipsoidPair<Scalar>& pair,
                                       const EllipsoidPlane<Scalar>& plane, Scalar tolerance,
                                       const ClimbGoal& goal, int most_caps) {
  return Search<Scalar>(pair, plane, tolerance, goal).run(most_caps);
}

template EllipsoidDepth<float> ellipsoid_depth(const EllipsoidPair<float>&,
                                               const EllipsoidPlane<float>&, float,
                                               const ClimbGoal&, int);
template EllipsoidDepth<double> ellipsoid_depth(const EllipsoidPair<double>&,
                                                const EllipsoidPlane<double>&, double,
                                                const ClimbGoal&, int);

}  // namespace touchstone
