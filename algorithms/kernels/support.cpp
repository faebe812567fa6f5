#include "algorithms/kernels/support.h"

#include <algorithm>

namespace touchstone {

template <class Scalar>
Vec3d centre_offset(const SupportShape<Scalar>& a, const Pose& pose_a,
                    const SupportShape<Scalar>& b, const Pose& pose_b) {
  if (a.centre.isZero(0) && b.centre.isZero(0)) return pose_b.translation - pose_a.translation;
  const auto near_its_origin = [](const SupportShape<Scalar>& shape) {
    return shape.centre.squaredNorm() <= shape.size * shape.size;
  };
  if (near_its_origin(a) && near_its_origin(b)) {
    return (pose_b.rotation * b.centre - pose_a.rotation * a.centre) +
           (pose_b.translation - pose_a.translation);
  }
  // Where the vertices of a hull lie far from its origin, its rotated centre must be known to more
  // digits than a double has.
  const auto wide = [](const auto& x) { return x.template cast<long double>(); };
  const Eigen::Matrix<long double, 3, 1> sum =
      (wide(pose_b.rotation) * wide(b.centre) - wide(pose_a.rotation) * wide(a.centre)) +
      (wide(pose_b.translation) - wide(pose_a.translation));
  return sum.template cast<double>();
}

template <class Scalar>
bool balls_are_apart(const SupportShape<Scalar>& a, const Pose& pose_a,
                     const SupportShape<Scalar>& b, const Pose& pose_b) {
  // A matrix makes no vector longer than by its Frobenius norm. Overflow makes this false.
  constexpr double beyond_rounding = 1 + 1e-12;
  const double reach_a = a.size * pose_a.rotation.norm() + a.radius;
  const double reach_b = b.size * pose_b.rotation.norm() + b.radius;
  const double reach = (reach_a + reach_b) * beyond_rounding;
  return centre_offset(a, pose_a, b, pose_b).squaredNorm() > reach * reach &&
         reach < std::numeric_limits<double>::infinity();
}

template <class Scalar>
SupportPair<Scalar>::SupportPair(const SupportShape<Scalar>& a, const Pose& pose_a,
                                 const SupportShape<Scalar>& b, const Pose& pose_b)
    : offset_(centre_offset(a, pose_a, b, pose_b)),
      unit_(power_of_two_above(std::max(
          {offset_.cwiseAbs().maxCoeff(), a.reach(pose_a.rotation), b.reach(pose_b.rotation)}))),
      a_(a, pose_a.rotation, unit_),
      b_(b, pose_b.rotation, unit_),
      centre_b_((offset_ * (1 / unit_)).template cast<Scalar>()),
      origin_(pose_a(a.centre)),
      is_polytope_(a.is_polytope() && b.is_polytope()) {}

template bool balls_are_apart(const SupportShape<float>&, const Pose&, const SupportShape<float>&,
                              const Pose&);
template bool balls_are_apart(const SupportShape<double>&, const Pose&, const SupportShape<double>&,
                              const Pose&);
template class SupportPair<float>;
template class SupportPair<double>;
template Vec3d centre_offset(const SupportShape<float>&, const Pose&, const SupportShape<float>&,
                             const Pose&);
template Vec3d centre_offset(const SupportShape<double>&, const Pose&, const SupportShape<double>&,
                             const Pose&);

}  // namespace touchstone
