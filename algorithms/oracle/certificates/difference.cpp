// Points, gaps and surfaces of a difference of cores.
#include "algorithms/oracle/certificates/difference.h"

#include <algorithm>
#include <set>
#include <utility>

namespace touchstone::oracle {

SignedSquare gap_along(const RationalVector& n, const RationalCore& a, const RationalCore& b) {
  const auto reach_a = a.support(n), reach_b = b.support(mpq_class(-1) * n);
  if (!reach_a || !reach_b) return {-1};
  return quotient(-*reach_a - *reach_b, dot(n, n));
}

SignedSquare distance_of_halfspaces(const RationalCore& a, const RationalCore& b) {
  const RationalVector n = a.normal(), other = b.normal();
  if (!is_zero(cross(n, other)) || dot(n, other) > 0) return {-1};
  return gap_along(n, a, b);
}

RationalVector Difference::operator()(const DifferencePoint& point) const {
  require(point.a < a_.size() && point.b < b_.size(), "a point names no generator");
  return a_[point.a] - b_[point.b];
}

RationalVector Difference::operator()(const std::vector<Certificate::Term>& terms) const {
  RationalVector sum;
  mpq_class weights;
  for (const Certificate::Term& term : terms) {
    require(term.weight > 0, "a weight is not positive");
    sum = sum + rational(term.weight) * (*this)(term.point);
    weights += rational(term.weight);
  }
  return 1 / weights * sum;
}

SignedSquare surface_depth(const Certificate::Surface& surface, const Difference& difference) {
  std::vector<RationalVector> points;
  for (const DifferencePoint& point : surface.points) points.push_back(difference(point));
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  SignedSquare least{-1};
  for (const auto& corners : surface.triangles) {
    for (int i = 0; i < 3; ++i) {
      require(corners[i] < points.size(), "a triangle names no point of the surface");
      require(edges.emplace(corners[i], corners[(i + 1) % 3]).second,
              "an edge of the surface is there twice");
    }
    const RationalVector &p = points[corners[0]], &q = points[corners[1]], &r = points[corners[2]];
    const RationalVector n = cross(q - p, r - p);
    const mpq_class height = dot(n, p);
    require(height > 0, "the origin is not on the inner side of each triangle");
    least = std::max(least, quotient(-height, dot(n, n)));
  }
  for (const auto& [tail, head] : edges) {
    require(edges.contains({head, tail}), "the surface is not closed");
  }
  return least;
}

SignedSquare distance_of(const std::vector<Certificate::Term>& terms, const Difference& difference,
                         const RationalCore& a, const RationalCore& b) {
  const RationalVector z = difference(terms);
  if (!a.is_halfspace() && !b.is_halfspace()) return {0, dot(z, z)};
  const RationalVector& n = (a.is_halfspace() ? a : b).normal();
  const mpq_class height = dot(n, z);
  return quotient(a.is_halfspace() ? mpq_class(-height) : height, dot(n, n));
}

}  // namespace touchstone::oracle
