// Derives both bounds of a certificate in rationals and compares them with the claim.
#include "algorithms/oracle/certificates/certificate_check.h"

#include <algorithm>
#include <set>
#include <utility>

#include "algorithms/oracle/certificates/rational_core.h"

namespace touchstone::oracle {
namespace {

SignedSquare gap_along(const RationalVector& n, const RationalCore& a, const RationalCore& b) {
  const auto reach_a = a.support(n), reach_b = b.support(mpq_class(-1) * n);
  if (!reach_a || !reach_b) return {-1};
  return quotient(-*reach_a - *reach_b, dot(n, n));
}

SignedSquare proven_lower(const Certificate& certificate, const RationalCore& a,
                          const RationalCore& b) {
  const RationalVector n = rational_vector(certificate.direction);
  if (!is_zero(n)) return gap_along(n, a, b);
  require(certificate.lower.is_infinite(), "the direction is zero");
  return {-1};
}

// Points of the difference of the cores, by their generators.
class Difference {
 public:
  Difference(std::vector<RationalVector> a, std::vector<RationalVector> b)
      : a_(std::move(a)), b_(std::move(b)) {}

  RationalVector operator()(const DifferencePoint& point) const {
    require(point.a < a_.size() && point.b < b_.size(), "a point names no generator");
    return a_[point.a] - b_[point.b];
  }
  RationalVector operator()(const std::vector<Certificate::Term>& terms) const {
    RationalVector sum;
    mpq_class weights;
    for (const Certificate::Term& term : terms) {
      require(term.weight > 0, "a weight is not positive");
      sum = sum + rational(term.weight) * (*this)(term.point);
      weights += rational(term.weight);
    }
    return 1 / weights * sum;
  }

 private:
  std::vector<RationalVector> a_, b_;
};

// Returns minus the least distance of the triangles' planes from the origin. Every edge has its
// reverse, so the surface winds around the origin a whole number of times, and at least once, since
// all triangles wind in one direction. So each ray from the origin meets the surface, no nearer
// than the nearest plane.
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

SignedSquare proven_upper(const Certificate& certificate, const RationalCore& a,
                          const RationalCore& b) {
  if (certificate.upper.sign > 0 && certificate.upper.is_infinite()) return {1};
  const Difference difference(a.points(certificate.a), b.points(certificate.b));
  // Two half-spaces are their own proof: no other direction has a gap.
  if (a.is_halfspace() && b.is_halfspace()) return gap_along(a.normal(), a, b);
  require(!certificate.closest.empty() || !certificate.surface.triangles.empty(),
          "nothing is there to prove the upper bound");
  SignedSquare best{1};
  if (!certificate.closest.empty()) {
    const RationalVector z = difference(certificate.closest);
    if (a.is_halfspace() || b.is_halfspace()) {
      const RationalVector& n = (a.is_halfspace() ? a : b).normal();
      const mpq_class height = dot(n, z);
      best = quotient(a.is_halfspace() ? mpq_class(-height) : height, dot(n, n));
    } else {
      best = {0, dot(z, z)};
    }
  }
  if (!certificate.surface.triangles.empty()) {
    require(!a.is_halfspace() && !b.is_halfspace(), "a half-space has no surface");
    best = std::min(best, surface_depth(certificate.surface, difference));
  }
  return best;
}

mp_bitcnt_t size_of(const Integer& x) { return x > 0 ? msb(x) : 0; }

Answer answer_of(const SignedSquare& lower, const SignedSquare& upper, const mpq_class& radius) {
  const SignedSquare radii{0, radius * radius};
  if (lower > radii) return Answer::separated;
  if (upper < radii) return Answer::overlapping;
  return lower >= radii && upper <= radii ? Answer::touching : Answer::unknown;
}

}  // namespace

std::string fault(const Certificate& certificate, const Body& a, const Body& b) {
  try {
    const SignedSquare lower = signed_square(certificate.lower);
    const SignedSquare upper = signed_square(certificate.upper);
    // Roots are far finer than the claim, whose rounding is of about its own size.
    const mp_bitcnt_t root_bits =
        256 + size_of(certificate.lower.numerator) + size_of(certificate.lower.denominator);
    const RationalCore core_a(a, root_bits), core_b(b, root_bits);
    const mpq_class radius_a = rational(a.solid->radius), radius_b = rational(b.solid->radius);
    require(radius_a >= 0 && radius_b >= 0, "a radius is negative");
    require(lower <= proven_lower(certificate, core_a, core_b),
            "the direction does not prove the lower bound");
    require(upper >= proven_upper(certificate, core_a, core_b),
            "the points do not prove the upper bound");
    require(certificate.answer == answer_of(lower, upper, radius_a + radius_b),
            "the answer does not follow from the bounds");
  } catch (const Fault& found) {
    return found.reason;
  }
  return {};
}

}  // namespace touchstone::oracle
