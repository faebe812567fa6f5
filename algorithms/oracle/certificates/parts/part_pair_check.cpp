// Planes between two parts, and points of both.
#include "algorithms/oracle/certificates/parts/part_pair_check.h"

namespace touchstone::oracle {

bool ApartBy::holds(const mpq_class& gap, const RationalVector& n) const {
  const mpq_class length = dot(n, n), square = gap * gap, least = radii + distance;
  return gap > 0 && square > radii * radii * length && square >= least * least * length;
}

bool is_parted(const RationalVector& n, const RationalCore& a, const RationalCore& b,
               const ApartBy& by) {
  require(!is_zero(n), "a plane has no direction");
  const auto reach_a = a.support(n), reach_b = b.support(mpq_class(-1) * n);
  return reach_a && reach_b && by.holds(-*reach_a - *reach_b, n);
}

RationalVector own_normal(const RationalCore& a, const RationalCore& b) {
  require(a.is_halfspace() || b.is_halfspace(), "neither part is a half-space");
  return a.is_halfspace() ? a.normal() : mpq_class(-1) * b.normal();
}

SignedSquare greatest_distance(const PartsCertificate::Met& met, const RationalCore& a,
                               const RationalCore& b) {
  const Difference difference(a.points(met.a), b.points(met.b));
  const bool has_points = !met.closest.empty();
  const bool has_surface = !met.surface.triangles.empty() || !met.surface.points.empty();
  if (a.is_halfspace() && b.is_halfspace()) {
    require(!has_points && !has_surface, "two half-spaces need no points");
    return distance_of_halfspaces(a, b);
  }
  require(has_points != has_surface, "not one of points and a surface is there");
  if (has_points) return distance_of(met.closest, difference, a, b);
  require(!a.is_halfspace() && !b.is_halfspace(), "a half-space has no surface");
  require(!met.surface.triangles.empty(), "the surface has no triangles");
  return surface_depth(met.surface, difference);
}

}  // namespace touchstone::oracle
