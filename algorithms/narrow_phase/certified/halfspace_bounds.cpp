// Part of certified: the bounds of halfspace_bounds.h, for double and long double.
#include "algorithms/narrow_phase/certified/halfspace_bounds.h"

#include <algorithm>
#include <cmath>

#include "algorithms/core/cofactors.h"

namespace touchstone {
namespace {

// A plane, and bounds on a body's height over it.
template <class Real>
struct Height {
  Real lower = -std::numeric_limits<Real>::infinity();
  Real upper = std::numeric_limits<Real>::infinity();
  Vec3<Real> normal = Vec3<Real>::Zero();  // outward
  Real length = 0;                         // of the plane's normal before it was normalised
  Real doubt = 0;
};

template <class Real, class HullSupport>
Height<Real> height_over(const BoundedShape& a, const Pose& pose_a, const BoundedShape& b,
                         const Pose& pose_b, const HullSupport& hull_support) {
  constexpr Real ulp = std::numeric_limits<Real>::epsilon() / 2;
  Height<Real> result;
  // The transformed half-space is m . (x - t) <= offset |det M| with m = +-cof(M) n, since planes
  // map by the inverse transpose.
  const Mat3<Real> matrix = pose_b.rotation.cast<Real>(), size = matrix.cwiseAbs();
  const Mat3<Real> cofactors = cofactor_matrix(matrix);
  Mat3<Real> cofactor_terms;
  for (int i = 0; i < 3; ++i) {
    const int p = (i + 1) % 3, q = (i + 2) % 3;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      cofactor_terms(i, k) = size(p, l) * size(q, m) + size(p, m) * size(q, l);
    }
  }
  // Cofactors are off by 2 units of their terms, the determinant and m by 5 of theirs.
  const Real determinant = matrix.row(0).dot(cofactors.row(0));
  const Real determinant_terms = size.row(0).dot(cofactor_terms.row(0));
  if (!(std::abs(determinant) > 8 * ulp * determinant_terms)) return result;
  const Vec3<Real> n = b.shape->normal.cast<Real>();
  Vec3<Real> m = cofactors * n;
  if (determinant < 0) m = -m;
  const Vec3<Real> m_terms = cofactor_terms * n.cwiseAbs();

  const Mat3<Real> matrix_a = pose_a.rotation.cast<Real>();
  const Vec3<Real> offset = pose_a.translation.cast<Real>() - pose_b.translation.cast<Real>();
  const Sum<Real> lowest = support<Real>(a, matrix_a.transpose() * -m,
                                         matrix_a.cwiseAbs().transpose() * m_terms, hull_support);
  const Real plane = b.shape->offset;
  const Real value = m.dot(offset) - lowest.value - plane * std::abs(determinant);
  const Real terms =
      m_terms.dot(offset.cwiseAbs()) + lowest.terms + std::abs(plane) * determinant_terms;
  // The support is off by 32 units of its terms, the product with the offset by 9, the plane's by
  // 6, their sum by 2 more, and the length by as much as m.
  const Real length = std::sqrt(m.dot(m));
  const Real of_length = 8 * ulp * m_terms.sum() / length;
  if (!(of_length < Real(0x1p-20))) return result;
  const Real radius = a.support.radius;
  const Real core = value / length;
  const Real distance = core - radius;
  result.doubt = 40 * ulp * terms / length + 2 * (of_length + 8 * ulp) * (std::abs(core) + radius);
  result.lower = distance - result.doubt;
  result.upper = distance + result.doubt;
  result.normal = m / length;
  result.length = length;
  return result;
}

}  // namespace

DistanceBounds HalfspaceBounder::closely(const BoundedShape& a, const Pose& pose_a,
                                         const BoundedShape& b, const Pose& pose_b, Vec3d& normal) {
  if (!is_wide) return {};
  const auto height = height_over<Wide>(a, pose_a, b, pose_b, AllThatMayBe(values_, furthest_));
  normal = height.normal.cast<double>();
  return {round_down(height.lower), round_up(height.upper)};
}

DistanceBounds HalfspaceBounder::roughly(const BoundedShape& a, const Pose& pose_a,
                                         const BoundedShape& b, const Pose& pose_b, Vec3d& normal) {
  const auto height = height_over<double>(a, pose_a, b, pose_b, BestByScan());
  normal = height.normal;
  // Nothing overflows if matrices and the plane's normal are below 2^100 and lengths below 2^200,
  // and all underflow amounts to less than 2^-500.
  const double factors =
      std::max({pose_a.rotation.cwiseAbs().maxCoeff(), pose_b.rotation.cwiseAbs().maxCoeff(),
                b.shape->normal.cwiseAbs().maxCoeff()});
  const double lengths = std::max({a.reach.maxCoeff(), std::abs(b.shape->offset),
                                   pose_a.translation.cwiseAbs().maxCoeff(),
                                   pose_b.translation.cwiseAbs().maxCoeff(), a.support.unit});
  const bool in_range =
      factors < 0x1p100 && lengths < 0x1p200 && height.doubt > 0x1p-400 && height.length > 0x1p-100;
  if (!in_range) return {};
  return {height.lower, height.upper};
}

}  // namespace touchstone
