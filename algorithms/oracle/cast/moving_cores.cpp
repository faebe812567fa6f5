// Part of the oracle: places moving polytopes on their grid, exactly.
#include "algorithms/oracle/cast/moving_cores.h"

#include <algorithm>

#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle {
namespace {

// A sum of products of doubles, as a number of units of 2^exponent, which must divide each product.
Dyadic product(double x, double y) {
  const Dyadic a = dyadic(x), b = dyadic(y);
  if (a.mantissa.is_zero() || b.mantissa.is_zero()) return {};
  return {a.mantissa * b.mantissa, a.exponent + b.exponent};
}

// A coordinate of a point in the world as terms that add up to it.
using Terms = std::vector<Dyadic>;

std::array<Terms, 3> vertex_terms(const Body& body, const Vec3d& vertex) {
  std::array<Terms, 3> terms;
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 3; ++k) terms[row].push_back(product(body.matrix(row, k), vertex[k]));
    terms[row].push_back(dyadic(body.translation[row]));
  }
  return terms;
}

Integer sum(const Terms& terms, int exponent) {
  Integer total = 0;
  for (const Dyadic& term : terms) total += term.over_power(exponent);
  return total;
}

IntegerVector sum(const std::array<Terms, 3>& terms, int exponent) {
  return {sum(terms[0], exponent), sum(terms[1], exponent), sum(terms[2], exponent)};
}

}  // namespace

MovingCores::MovingCores(const Body& a, const Motion& motion_a, const Body& b,
                         const Motion& motion_b) {
  std::vector<std::array<Terms, 3>> points;
  for (const Body* body : {&a, &b}) {
    for (const Vec3d& vertex : body->solid->vertices) {
      points.push_back(vertex_terms(*body, vertex));
    }
  }
  std::array<Terms, 3> displacement;
  for (int k = 0; k < 3; ++k) {
    displacement[k] = {dyadic(motion_b.displacement[k]), dyadic(-motion_a.displacement[k])};
  }
  const Terms radii = {dyadic(a.solid->radius), dyadic(b.solid->radius)};

  int exponent = Dyadic::of_zero;
  const auto include = [&](const Terms& terms) {
    for (const Dyadic& term : terms) exponent = std::min(exponent, term.exponent);
  };
  for (const auto& point : points) std::ranges::for_each(point, include);
  std::ranges::for_each(displacement, include);
  include(radii);
  if (exponent == Dyadic::of_zero) exponent = 0;  // all are zero

  // A step of time is 2^-time_bits of the displacement.
  const int unit = exponent - time_bits;
  for (std::size_t i = 0; i < points.size(); ++i) {
    (i < a.solid->vertices.size() ? a_ : b_).push_back(sum(points[i], unit));
  }
  velocity_ = sum(displacement, exponent);
  radius_ = sum(radii, unit);
}

MovingCores::Point MovingCores::least(const IntegerVector& n) const {
  const auto furthest = [&](const std::vector<IntegerVector>& points, bool negative) {
    std::uint32_t best = 0;
    Integer height;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      Integer here = dot(n, points[i]);
      if (negative) here = -here;
      if (i > 0 && here <= height) continue;
      best = i;
      height = here;
    }
    return best;
  };
  const DifferencePoint of{furthest(a_, true), furthest(b_, false)};
  return {difference(of), of};
}

}  // namespace touchstone::oracle
