// Part of the oracle, used by the checks of certificates and by what makes them: rays against parts in rationals.
#pragma once

#include <optional>

#include "algorithms/oracle/certificates/certificate.h"
#include "algorithms/oracle/certificates/parts/placed_parts.h"

namespace touchstone::oracle {

// The points of a ray from time 0 to its end.
struct RaySpan {
  RationalVector origin, direction;
  std::optional<mpq_class> end;  // none: there is no end
  bool is_closed = true;         // the point of the end belongs to it

  RationalVector at(const mpq_class& t) const { return origin + t * direction; }
  // That of another end, which does not belong to it.
  RaySpan until(const mpq_class& other_end) const { return {origin, direction, other_end, false}; }
  // True if the planes along n part the span from what reaches up to `reach` along -n, and from balls around it.
  bool is_parted(const RationalVector& n, const mpq_class& reach, const mpq_class& radius) const;
  // True if the triangle has no point of the span.
  bool passes(const RationalTriangle& triangle) const;
};

// The part that is hit at the end of a span, of which it is free only until a time of its own.
struct PartUntil {
  std::uint32_t body = 0, part = 0;
  mpq_class end;
};

// The corners of a part that is a triangle without a ball, or less.
std::optional<RationalTriangle> triangle_of(const PlacedParts& parts, std::uint32_t part);

// True if the part has the point, which for a hull of more than three vertices the surface has to show. Throws
// Fault if that is not one, and if the matrix of a round core, a box or a half-space has no inverse.
bool has_point(const PlacedParts& parts, std::uint32_t part, const RationalVector& point,
               const std::vector<Generator>& generators, const Certificate::Surface& surface);

}  // namespace touchstone::oracle
