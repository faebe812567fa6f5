// Derives both bounds of a certificate in rationals and compares them with the claim.
#include "algorithms/oracle/certificates/certificate_check.h"

#include <algorithm>

#include "algorithms/oracle/certificates/difference.h"

namespace touchstone::oracle {
namespace {

SignedSquare proven_lower(const Certificate& certificate, const RationalCore& a,
                          const RationalCore& b) {
  const RationalVector n = rational_vector(certificate.direction);
  if (!is_zero(n)) return gap_along(n, a, b);
  require(certificate.lower.is_infinite(), "the direction is zero");
  return {-1};
}

SignedSquare proven_upper(const Certificate& certificate, const RationalCore& a,
                          const RationalCore& b) {
  if (certificate.upper.sign > 0 && certificate.upper.is_infinite()) return {1};
  const Difference difference(a.points(certificate.a), b.points(certificate.b));
  // Two half-spaces are their own proof: no other direction has a gap.
  if (a.is_halfspace() && b.is_halfspace()) return distance_of_halfspaces(a, b);
  require(!certificate.closest.empty() || !certificate.surface.triangles.empty(),
          "nothing is there to prove the upper bound");
  SignedSquare best{1};
  if (!certificate.closest.empty()) best = distance_of(certificate.closest, difference, a, b);
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
    return found.what();
  }
  return {};
}

}  // namespace touchstone::oracle
