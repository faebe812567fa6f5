// The pair, its planes, and the derivatives that the ascent uses.
#include "algorithms/narrow_phase/ellipsoid/ellipsoid_pair.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/kernels/minkowski/support_shape.h"
#include "algorithms/kernels/simd/vector.h"
#include "algorithms/narrow_phase/ellipsoid/cofactors.h"

namespace touchstone {
namespace {

// Returns at least half the extent of the rotated body, in metres.
double reach(const Shape& shape, const Pose& pose) {
  if (shape.kind == ShapeKind::sphere) return shape.radius;
  return shape.radii.maxCoeff() * pose.rotation.cwiseAbs().maxCoeff();
}

// The support of the core that m makes of the unit ball: its extent along n, the inverse of that,
// and the point. An extent whose square has lost its digits becomes zero.
template <class Scalar>
void support(const Mat3<Scalar>& m, const Vec3<Scalar>& n, Scalar& reach, Scalar& per_reach,
             Vec3<Scalar>& point) {
  constexpr Scalar shortest = sizeof(Scalar) == 8 ? static_cast<Scalar>(1e-200) : Scalar{1e-24f};
  const Vec3<Scalar> turned = m.transpose() * n;
  const Scalar squared = turned.squaredNorm();
  const bool vanishes = !(squared > shortest);
  reach = vanishes ? Scalar{0} : std::sqrt(squared);
  per_reach = vanishes ? Scalar{0} : 1 / reach;
  point.noalias() = m * (per_reach * turned);
}

template <class Scalar>
Vec3<Scalar> unit_vector(const Vec3<Scalar>& v) {
  return (1 / std::sqrt(v.squaredNorm())) * v;
}

// The curvature radii of the difference at a plane: a symmetric matrix that is zero along n.
template <class Scalar>
class Curvature {
 public:
  Curvature(const EllipsoidPair<Scalar>& pair, const EllipsoidPlane<Scalar>& at) {
    const auto entry = [&](int i, int j) {
      return at.per_reach_a * (pair.pp(i, j) - at.a[i] * at.a[j]) +
             at.per_reach_b * (pair.qq(i, j) - at.b[i] * at.b[j]);
    };
    xx_ = entry(0, 0);
    xy_ = entry(0, 1);
    xz_ = entry(0, 2);
    yy_ = entry(1, 1);
    yz_ = entry(1, 2);
    zz_ = entry(2, 2);
    trace_ = xx_ + yy_ + zz_;
    const Scalar minors =
        (xx_ * yy_ - xy_ * xy_) + (xx_ * zz_ - xz_ * xz_) + (yy_ * zz_ - yz_ * yz_);
    determinant_ = std::max(minors, Scalar{0});
  }

  Scalar trace() const { return trace_; }
  Scalar least() const {
    return (trace_ - std::sqrt(std::max(trace_ * trace_ - 4 * determinant_, Scalar{0}))) / 2;
  }
  // Determinant of the matrix plus `shift` times the identity, across n.
  Scalar determinant(Scalar shift) const { return determinant_ + shift * (trace_ + shift); }
  // Returns (matrix + shift)^-1 times a vector across n. The inverse of a 2x2 matrix is its trace
  // minus itself, divided by its determinant.
  Vec3<Scalar> solve(const Vec3<Scalar>& across, Scalar shift) const {
    const Scalar x = across.x(), y = across.y(), z = across.z(), own = trace_ + shift;
    return Vec3<Scalar>{own * x - (xx_ * x + xy_ * y + xz_ * z),
                        own * y - (xy_ * x + yy_ * y + yz_ * z),
                        own * z - (xz_ * x + yz_ * y + zz_ * z)} *
           (1 / determinant(shift));
  }

 private:
  Scalar xx_, xy_, xz_, yy_, yz_, zz_;
  Scalar trace_, determinant_;  // of the 2x2 matrix across n
};

// The best plane for the squares of the reaches, weighted to equal the reaches here. Unlike
// Newton's step it does not overshoot the edge of a nearly flat body.
template <class Scalar>
Vec3<Scalar> reweighted(const EllipsoidPair<Scalar>& pair, const EllipsoidPlane<Scalar>& at) {
  Mat3<Scalar> sum = at.gap * Mat3<Scalar>::Identity();
  sum += at.per_reach_a * pair.pp + at.per_reach_b * pair.qq;
  const Cofactors<Scalar> cofactors(sum);
  // The normal stays as it is if there is no centre or no inverse.
  const Vec3<Scalar> next = cofactors.solve(pair.centre);
  return next.squaredNorm() > 0 ? next : at.normal;
}

}  // namespace

template <class Scalar>
EllipsoidPair<Scalar>::EllipsoidPair(const Shape& a, const Pose& pose_a, const Shape& b,
                                     const Pose& pose_b)
    : is_ball(a.kind == ShapeKind::sphere) {
  const Vec3d offset = pose_b.translation - pose_a.translation;
  unit = power_of_two_above(
      std::max({offset.cwiseAbs().maxCoeff(), reach(a, pose_a), reach(b, pose_b)}));
  const double per_unit = 1 / unit;
  centre = (offset * per_unit).template cast<Scalar>();
  radius = is_ball ? static_cast<Scalar>(a.radius * per_unit) : Scalar{0};
  if (is_ball) {
    p.setZero();
    pp.setZero();
  } else {
    p = (pose_a.rotation * (a.radii * per_unit).asDiagonal()).template cast<Scalar>();
    pp = p * p.transpose();
  }
  q = (pose_b.rotation * (b.radii * per_unit).asDiagonal()).template cast<Scalar>();
  qq = q * q.transpose();
}

template <class Scalar>
EllipsoidPlane<Scalar>::EllipsoidPlane(const EllipsoidPair<Scalar>& pair, const Vec3<Scalar>& n)
    : normal(n) {
  support(pair.q, n, reach_b, per_reach_b, b);
  b = -b;
  if (pair.is_ball) {
    a.setZero();
    reach_a = per_reach_a = 0;
  } else {
    support(pair.p, n, reach_a, per_reach_a, a);
  }
  between = pair.centre + b - a;
  gap = n.dot(pair.centre) - reach_a - reach_b;
  slide = between - n.dot(between) * n;
  slide_squared = slide.squaredNorm();
}

namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/narrow_phase/ellipsoid/newton_ascent.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

template <class Scalar>
Climb<Scalar> climb(const EllipsoidPair<Scalar>& pair, const Vec3<Scalar>& start,
                    const ClimbGoal& goal, Scalar tolerance) {
  switch (isa()) {
    case Isa::avx512: return avx512::climb_at(pair, start, goal, tolerance);
    case Isa::avx2: return avx2::climb_at(pair, start, goal, tolerance);
    default: return baseline::climb_at(pair, start, goal, tolerance);
  }
}

template struct EllipsoidPair<float>;
template struct EllipsoidPair<double>;
template struct EllipsoidPlane<float>;
template struct EllipsoidPlane<double>;
template Climb<float> climb(const EllipsoidPair<float>&, const Vec3<float>&, const ClimbGoal&,
                            float);
template Climb<double> climb(const EllipsoidPair<double>&, const Vec3<double>&, const ClimbGoal&,
                             double);

}  // namespace touchstone
