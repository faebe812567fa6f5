#include "algorithms/kernels/ellipsoid_depth.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace touchstone {
namespace {

template <class Scalar>
constexpr Scalar rounding = EllipsoidPair<Scalar>::rounding;

// E E^T of an ellipsoid inside of the sum of both cores that touches it along the plane's normal.
template <class Scalar>
Mat3<Scalar> inner_ellipsoid(const EllipsoidPair<Scalar>& pair,
                             const EllipsoidPlane<Scalar>& plane) {
  if (pair.is_ball) return pair.qq;
  if (!(plane.reach_a > 0 && plane.reach_b > 0)) return Mat3<Scalar>::Zero();
  const Vec3<Scalar> u1 = plane.u.unitOrthogonal(), u2 = plane.u.cross(u1);
  const Vec3<Scalar> v1 = plane.v.unitOrthogonal(), v2 = plane.v.cross(v1);
  const Vec3<Scalar> a1 = pair.p * u1, a2 = pair.p * u2, b1 = pair.q * v1, b2 = pair.q * v2;
  // S is free to turn, or to mirror, across u: as the sum of the squares is greatest.
  const Scalar a1b1 = a1.dot(b1), a1b2 = a1.dot(b2), a2b1 = a2.dot(b1), a2b2 = a2.dot(b2);
  Scalar cosine = a1b1 + a2b2, sine = a1b2 - a2b1, mirror = 1;
  const Scalar other_cosine = a1b1 - a2b2, other_sine = a1b2 + a2b1;
  if (other_cosine * other_cosine + other_sine * other_sine > cosine * cosine + sine * sine) {
    cosine = other_cosine;
    sine = other_sine;
    mirror = -1;
  }
  const Scalar length = std::sqrt(cosine * cosine + sine * sine);
  cosine = length > 0 ? cosine / length : Scalar{1};
  sine = length > 0 ? sine / length : Scalar{0};
  const Vec3<Scalar> first = a1 + cosine * b1 + sine * b2;
  const Vec3<Scalar> second = a2 + mirror * (cosine * b2 - sine * b1);
  const Vec3<Scalar> along = plane.a - plane.b;
  return along * along.transpose() + first * first.transpose() + second * second.transpose();
}

// Whether a symmetric matrix has no negative eigenvalue.
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

// A lower bound of the overlap along every normal, where the inner ellipsoid proves one that is
// near the plane's own; else 0.
template <class Scalar>
Scalar proven(const EllipsoidPlane<Scalar>& plane, const Mat3<Scalar>& inner) {
  const Scalar depth = -plane.gap, reach = plane.reach_a + plane.reach_b;
  // Were b moved by the slide, the plane would be stationary.
  const Scalar least = depth - plane.slide.norm();
  if (!(depth > 0)) return least;
  Mat3<Scalar> rest = inner;
  rest.diagonal().array() -= depth * reach;
  if (has_none_negative(rest)) return least;
  // Circles of minima, as of equal bodies, have an eigenvalue that is zero.
  const Scalar slack = rounding<Scalar> * reach;
  rest.diagonal().array() += slack;
  return has_none_negative(rest) ? least - 2 * rounding<Scalar> : Scalar{0};
}

// Normals around that of a minimum along which no overlap is less than `enough`.
template <class Scalar>
struct Cap {
  Vec3<Scalar> normal;
  Scalar angle;
};

template <class Scalar>
Cap<Scalar> cap_around(const EllipsoidPlane<Scalar>& plane, const Mat3<Scalar>& inner,
                       Scalar enough) {
  const Vec3<Scalar>& n = plane.normal;
  const Scalar reach = plane.reach_a + plane.reach_b;
  const Vec3<Scalar> touch = plane.a - plane.b;
  const Scalar askew = (touch - n.dot(touch) * n).norm();
  const Mat3<Scalar> across = inner - touch * touch.transpose();
  const Scalar trace = across.trace();
  const Scalar minors = across(0, 0) * across(1, 1) - across(0, 1) * across(0, 1) +
                        across(0, 0) * across(2, 2) - across(0, 2) * across(0, 2) +
                        across(1, 1) * across(2, 2) - across(1, 2) * across(1, 2);
  const Scalar least =
      (trace - std::sqrt(std::max(trace * trace - 4 * minors, Scalar{0}))) / 2 - rounding<Scalar>;
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
  Scalar lower;                         // what is known of the overlap in it
  int level;
};

template <class Scalar>
class Search {
 public:
  Search(const EllipsoidPair<Scalar>& pair, const EllipsoidPlane<Scalar>& plane, Scalar tolerance,
         const ClimbGoal& goal)
      : pair_(pair), goal_(goal), tolerance_(tolerance) {
    best_.plane = plane;
    const Mat3<Scalar> inner = inner_ellipsoid(pair, plane);
    best_.lower = proven(plane, inner);
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
      open[count++] = {{axis(0), axis(1), axis(2)}, 0, 0};
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

  bool is_proven() const {
    return best_.lower > 0 && best_.lower >= -best_.plane.gap - 4 * tolerance_;
  }

  void keep(const EllipsoidPlane<Scalar>& plane, const Mat3<Scalar>& inner) {
    // The slide is as much as another place of b.
    const Scalar slide = plane.slide.norm();
    if (caps_ == static_cast<int>(kept_.size()) || slide > tolerance_) return;
    kept_[caps_++] = cap_around(plane, inner, -best_.plane.gap - tolerance_ + slide);
  }

  // Of the overlap along the normals of a triangle. A better minimum that is met on the way is
  // kept.
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
    const Scalar lower = depth * cosine - plane.slide.norm() * sine;
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
    const Mat3<Scalar> inner = inner_ellipsoid(pair_, found.plane);
    if (found.plane.gap > best_.plane.gap) {
      best_.plane = found.plane;
      best_.lower = proven(found.plane, inner);
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
