// Gaps along the centre line and face normals, their error bound, and the report of the best axis.
#include "algorithms/kernels/sat/separating_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/core/cofactors.h"
#include "algorithms/kernels/minkowski/resolution.h"
#include "algorithms/kernels/sat/witness_points.h"

namespace touchstone {
namespace {

// The vector from the centre of a to the centre of b (metres, world axes). A body far from its own
// origin has a nonzero centre, which needs more digits than a double has.
template <class Scalar>
Vec3d centre_offset(const Polytope<Scalar>& a, const Pose& pose_a, const Polytope<Scalar>& b,
                    const Pose& pose_b) {
  if (a.centre.isZero(0) && b.centre.isZero(0)) return pose_b.translation - pose_a.translation;
  const auto wide = [](const auto& x) { return x.template cast<long double>(); };
  const Vec3<long double> offset =
      (wide(pose_b.rotation) * wide(b.centre) - wide(pose_a.rotation) * wide(a.centre)) +
      (wide(pose_b.translation) - wide(pose_a.translation));
  return offset.template cast<double>();
}

template <class Scalar>
PlacedPolytope<Scalar> place(const Polytope<Scalar>& shape, const Mat3d& rotation, double unit) {
  PlacedPolytope<Scalar> placed;
  placed.shape = &shape;
  placed.matrix = rotation.template cast<Scalar>();
  const Mat3<Scalar>& m = placed.matrix;
  placed.normals = cofactor_matrix(m);
  const Scalar determinant = m.col(0).dot(placed.normals.col(0));
  placed.orientation = determinant < 0 ? Scalar{-1} : Scalar{1};
  placed.determinant = std::abs(determinant);
  placed.normals *= placed.orientation;
  placed.scale = static_cast<Scalar>(shape.scale / unit);
  placed.origin.setZero();
  return placed;
}

// Returns the best outward face normal of `from`. `offset` is the vector from its origin to that of
// `to`.
template <class Scalar>
Axis<Scalar> best_face(const PlacedPolytope<Scalar>& from, const PlacedPolytope<Scalar>& to,
                       const Vec3<Scalar>& offset, Scalar enough, int& tested) {
  Axis<Scalar> best;
  const Scalar scale = from.scale * from.determinant;
  for (const auto& face : from.shape->faces) {
    const Vec3<Scalar> outward = from.normals * face.normal;
    const Scalar length = outward.norm();
    const Scalar gap = (outward.dot(offset) - to.support(-outward) - scale * face.offset) / length;
    ++tested;
    if (gap > best.gap) best = {gap, outward / length};
    if (gap > enough) break;
  }
  return best;
}

}  // namespace

template <class Scalar>
PolytopePair<Scalar>::PolytopePair(const Polytope<Scalar>& a, const Pose& pose_a,
                                   const Polytope<Scalar>& b, const Pose& pose_b) {
  // Frobenius norms bound the factor by which the matrices stretch lengths.
  const double stretch_a = pose_a.rotation.norm(), stretch_b = pose_b.rotation.norm();
  const double reach_a = static_cast<double>(a.reach) * a.scale * stretch_a;
  const double reach_b = static_cast<double>(b.reach) * b.scale * stretch_b;
  const Vec3d offset = centre_offset(a, pose_a, b, pose_b);
  // The error of centre_offset if the bodies lie far from their own origins.
  const double lost =
      4 * static_cast<double>(std::numeric_limits<long double>::epsilon()) *
      (stretch_a * a.centre.cwiseAbs().sum() + stretch_b * b.centre.cwiseAbs().sum());
  // The squares of shorter lengths underflow, and the norm is then no bound.
  constexpr double shortest = 1e-140;
  far_apart_ = offset.cwiseAbs().maxCoeff() > 1.001 * (reach_a + reach_b) + lost &&
               stretch_a > shortest && stretch_b > shortest;
  // Two points have no size of their own; the unit is then that of the error.
  constexpr double finest = 16 * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  const double reach = std::max(reach_a, reach_b);
  unit_ = power_of_two_above(reach > 0 ? reach : lost / finest);
  anchor_ = pose_a(a.centre);
  a_ = place(a, pose_a.rotation, unit_);
  b_ = place(b, pose_b.rotation, unit_);
  b_.origin = (offset / unit_).template cast<Scalar>();
  // The bound covers rounding of the stored numbers, the matrices, normals and axes (a rotation of
  // the axis moves the gap by its angle times the reach), and of the products. Each is a few
  // roundings of at most half an epsilon of its operands.
  const auto size = static_cast<Scalar>((reach_a + reach_b) / (unit_ * std::sqrt(3.0)));
  error_ = 8 * std::numeric_limits<Scalar>::epsilon() * (size + b_.origin.norm()) +
           static_cast<Scalar>(lost / unit_);
  // The error bound holds for matrices close to rotations or reflections.
  const auto usable = [](const PlacedPolytope<Scalar>& body) {
    return body.determinant > Scalar{0.5} && body.determinant < Scalar{2} &&
           body.matrix.cwiseAbs().maxCoeff() < Scalar{1.5};
  };
  complete_ = a.complete && b.complete && usable(a_) && usable(b_);
  too_large_ = a.too_large || b.too_large;
}

template <class Scalar>
Axis<Scalar> PolytopePair<Scalar>::centre_axis() const {
  const Scalar length = b_.origin.norm();
  if (!(length > 0)) return {};
  return axis_along(b_.origin / length);
}

template <class Scalar>
Axis<Scalar> PolytopePair<Scalar>::axis_along(const Vec3<Scalar>& normal) const {
  return {normal.dot(b_.origin) - b_.support(-normal) - a_.support(normal), normal};
}

template <class Scalar>
Axis<Scalar> PolytopePair<Scalar>::face_axis(int& tested) const {
  const Axis<Scalar> of_a = best_face<Scalar>(a_, b_, b_.origin, error_, tested);
  if (separates(of_a)) return of_a;
  const Axis<Scalar> of_b = best_face<Scalar>(b_, a_, -b_.origin, error_, tested);
  return of_b.gap > of_a.gap ? Axis<Scalar>{of_b.gap, -of_b.normal} : of_a;
}

template <class Scalar>
void PolytopePair<Scalar>::report(const Axis<Scalar>& best, Task task, bool exact,
                                  Outcome& outcome) const {
  if (far_apart_ || separates(best)) {
    outcome.answer = Answer::separated;
    outcome.status = Status::ok;
    return;
  }
  if (!complete_) {
    outcome.answer = Answer::unknown;
    outcome.status = too_large_ ? Status::capacity : Status::degenerate;
    clear_numbers(outcome);
    return;
  }
  const auto metres = [&](Scalar length) { return unit_ * static_cast<double>(length); };
  const double lower = metres(best.gap - error_), upper = metres(best.gap + error_);
  outcome.answer = Answer::overlapping;
  outcome.status = Status::ok;
  if (!(best.gap < -error_) &&
      !write_if_touching(lower, upper, unit_ * resolution<Scalar>, outcome)) {
    outcome.answer = Answer::unknown;
    outcome.status = Status::not_converged;
    clear_numbers(outcome);
  }
  if (!exact) outcome.upper = Outcome::none;
  if (task != Task::penetration) return;
  outcome.distance = metres(best.gap);
  outcome.lower = lower;
  if (exact) outcome.upper = upper;
  outcome.normal = best.normal.template cast<double>().normalized();
  const WitnessPoints<Scalar> point = witness_points(a_, b_, best.normal, best.gap, 4 * error_);
  outcome.witness_a = anchor_ + unit_ * point.a.template cast<double>();
  outcome.witness_b = anchor_ + unit_ * point.b.template cast<double>();
}

template <class Scalar>
std::vector<Polytope<Scalar>> make_polytopes(std::span<const Shape> shapes) {
  std::vector<Polytope<Scalar>> polytopes;
  for (const Shape& shape : shapes) {
    const bool polytopes_only = shape.kind == ShapeKind::box || shape.kind == ShapeKind::hull;
    polytopes.push_back(polytopes_only ? make_polytope<Scalar>(shape) : Polytope<Scalar>{});
  }
  return polytopes;
}

template class PolytopePair<float>;
template class PolytopePair<double>;
template std::vector<Polytope<float>> make_polytopes(std::span<const Shape>);
template std::vector<Polytope<double>> make_polytopes(std::span<const Shape>);

}  // namespace touchstone
