#include "algorithms/kernels/ellipsoid_pair.h"

#include <algorithm>
#include <cmath>

#include "algorithms/kernels/cofactors.h"
#include "algorithms/kernels/support_shape.h"

namespace touchstone {
namespace {

// Metres, at least half of how far the turned body reaches.
double reach(const Shape& shape, const Pose& pose) {
  if (shape.kind == ShapeKind::sphere) return shape.radius;
  return shape.radii.maxCoeff() * pose.rotation.cwiseAbs().maxCoeff();
}

// The length that it had; one whose square has lost its digits is made zero.
template <class Scalar>
Scalar make_unit(Vec3<Scalar>& v) {
  constexpr Scalar shortest = sizeof(Scalar) == 8 ? Scalar{1e-200} : Scalar{1e-24f};
  const Scalar squared = v.squaredNorm();
  if (!(squared > shortest)) {
    v.setZero();
    return 0;
  }
  const Scalar length = std::sqrt(squared);
  v /= length;
  return length;
}

// The curvature radii of the difference at a plane: a symmetric matrix that vanishes along n.
template <class Scalar>
class Curvature {
 public:
  Curvature(const EllipsoidPair<Scalar>& pair, const EllipsoidPlane<Scalar>& at) {
    matrix_.setZero();
    if (at.reach_a > 0) matrix_ += (pair.pp - at.a * at.a.transpose()) / at.reach_a;
    if (at.reach_b > 0) matrix_ += (pair.qq - at.b * at.b.transpose()) / at.reach_b;
    const Mat3<Scalar>& m = matrix_;
    trace_ = m.trace();
    const Scalar minors = m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1) + m(0, 0) * m(2, 2) -
                          m(0, 2) * m(0, 2) + m(1, 1) * m(2, 2) - m(1, 2) * m(1, 2);
    determinant_ = std::max(minors, Scalar{0});
  }

  Scalar trace() const { return trace_; }
  Scalar least() const {
    return (trace_ - std::sqrt(std::max(trace_ * trace_ - 4 * determinant_, Scalar{0}))) / 2;
  }
  // Of the matrix plus `shift` times the identity, across n.
  Scalar determinant(Scalar shift) const { return determinant_ + shift * (trace_ + shift); }
  // (matrix + shift)^-1 times a vector across n: the inverse of a matrix of two rows is its trace
  // less itself, over its determinant.
  Vec3<Scalar> solve(const Vec3<Scalar>& across, Scalar shift) const {
    return ((trace_ + shift) * across - matrix_ * across) / determinant(shift);
  }

 private:
  Mat3<Scalar> matrix_;
  Scalar trace_, determinant_;  // of two rows, across n
};

// The best plane for the squares of the reaches, each weighed so that it is the reach here. It
// overshoots no edge of a body that is nearly flat, as Newton's does.
template <class Scalar>
Vec3<Scalar> reweighted(const EllipsoidPair<Scalar>& pair, const EllipsoidPlane<Scalar>& at) {
  Mat3<Scalar> sum = at.gap * Mat3<Scalar>::Identity();
  if (at.reach_a > 0) sum += pair.pp / at.reach_a;
  if (at.reach_b > 0) sum += pair.qq / at.reach_b;
  const Cofactors<Scalar> cofactors(sum);
  // No centre, or no inverse: the normal as it is.
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
  v.noalias() = pair.q.transpose() * n;
  reach_b = make_unit(v);
  b.noalias() = pair.q * -v;
  if (pair.is_ball) {
    u.setZero();
    a.setZero();
    reach_a = 0;
  } else {
    u.noalias() = pair.p.transpose() * n;
    reach_a = make_unit(u);
    a.noalias() = pair.p * u;
  }
  between = pair.centre + b - a;
  gap = n.dot(pair.centre) - reach_a - reach_b;
  slide = between - n.dot(between) * n;
}

template <class Scalar>
Climb<Scalar> climb(const EllipsoidPair<Scalar>& pair, const Vec3<Scalar>& start,
                    const ClimbGoal& goal, Scalar tolerance) {
  constexpr Scalar rounding = EllipsoidPair<Scalar>::rounding;
  constexpr Scalar noise = rounding / 4;
  // Beyond it witness points that are within the tolerance would still lie askew.
  const Scalar askew = std::max(tolerance, sizeof(Scalar) == 8 ? Scalar{1e-10} : rounding);
  Climb<Scalar> found;
  EllipsoidPlane<Scalar>& at = found.plane;
  at = EllipsoidPlane<Scalar>(pair, start);
  Scalar slide = at.slide.squaredNorm();
  Scalar damping = 0;
  while (found.iterations < goal.most_iterations) {
    ++found.iterations;
    const bool apart = at.gap - pair.radius > rounding;
    if (goal.only_apart && apart) {
      found.end = ClimbEnd::apart;
      return found;
    }
    // How far the distance of the two points is above the gap.
    const Scalar distance = at.between.norm();
    if (goal.only_verdict && distance < pair.radius - rounding) {
      found.end = ClimbEnd::inside;
      return found;
    }
    const bool near = at.gap > 0 && slide <= tolerance * (distance + at.gap);
    if (slide <= tolerance * tolerance || (near && slide <= askew * askew)) {
      found.end = apart ? ClimbEnd::apart : ClimbEnd::stationary;
      return found;
    }
    const Curvature<Scalar> curvature(pair, at);
    Scalar shift = at.gap;
    // Where the function is not concave, the curvature alone still leads uphill.
    if (shift < 0 && !(curvature.determinant(shift) > 0 && curvature.trace() + 2 * shift > 0)) {
      shift = -curvature.least() / 2;
    }
    for (bool newton = true;; newton = !newton) {
      const Vec3<Scalar> step = curvature.solve(at.slide, shift + damping);
      const Vec3<Scalar> ahead =
          newton ? (at.normal + step).normalized() : reweighted(pair, at).normalized();
      const EllipsoidPlane<Scalar> next(pair, ahead);
      const Scalar next_slide = next.slide.squaredNorm();
      // So written that NaN is no step.
      const bool uphill = next.gap > at.gap + noise;
      if (uphill || (next.gap > at.gap - noise && next_slide < slide)) {
        at = next;
        slide = next_slide;
        damping = newton ? damping / 16 : Scalar{0};
        break;
      }
      // Not even a short step leads uphill.
      const bool spent = !newton && !(step.squaredNorm() > noise * noise);
      if (spent || found.iterations >= goal.most_iterations) return found;
      ++found.iterations;
      if (!newton) damping = std::max(8 * damping, curvature.trace() + std::abs(at.gap)) / 2;
    }
  }
  return found;
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
