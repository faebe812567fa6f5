// A ray is a segment to planes in doubles.
#include "algorithms/oracle/rays/ray_planes.h"

namespace touchstone::oracle {
namespace {

// A multiple of the vector.
IntegerVector multiple(const RationalVector& v) {
  mpz_class common = lcm(lcm(v[0].get_den(), v[1].get_den()), v[2].get_den());
  IntegerVector whole;
  for (std::size_t k = 0; k < 3; ++k) whole[k] = integer(mpq_class(v[k] * common).get_num());
  return whole;
}

}  // namespace

Integer integer(const mpz_class& x) { return Integer(x.get_str()); }

Vec3d rounded_vector(const RationalVector& v) { return {v[0].get_d(), v[1].get_d(), v[2].get_d()}; }

double reach_of(const RationalBox& box) {
  const Vec3d low = rounded_vector(box.low), high = rounded_vector(box.high);
  return Vec3d(low.cwiseAbs().cwiseMax(high.cwiseAbs())).stableNorm();
}

Vec3d way_of(const RaySpan& span, double reach) {
  if (span.end) return rounded_vector(*span.end * span.direction);
  const double far = rounded_vector(span.origin).stableNorm() + reach;
  return 4 * far * rounded_vector(span.direction).stableNormalized();
}

std::optional<IntegerVector> parting(const IntegerVector& direction, const RaySpan& span,
                                     const IsParted& is_parted) {
  const RationalVector n = rational_vector(direction);
  if (is_zero(n)) return {};
  if (is_parted(n)) return direction;
  const RationalVector across =
      n - dot(n, span.direction) / dot(span.direction, span.direction) * span.direction;
  if (span.end || is_zero(across) || !is_parted(across)) return {};
  return multiple(across);
}

std::optional<IntegerVector> plane_off(const RaySpan& span, const Vec3d& way,
                                       const RoundedGroup& group, double radius,
                                       const IsParted& is_parted) {
  const Vec3d from = rounded_vector(span.origin);
  const RoundedGroup segment(from, from + way, group);
  const auto n = plane_between(segment, group, radius);
  if (!n) return {};
  return parting(*n, span, is_parted);
}

}  // namespace touchstone::oracle
