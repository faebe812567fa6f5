// Part of the oracle: tries every subset of a simplex, and takes the one whose nearest point no other
// point is in front of.
#include "algorithms/oracle/cast/nearest.h"

#include <array>
#include <bit>
#include <optional>

namespace touchstone::oracle {
namespace {

using Points = std::vector<IntegerVector>;

std::optional<RationalPoint> on_segment(const IntegerVector& p, const IntegerVector& q) {
  const IntegerVector edge = q - p;
  const Integer along = -dot(p, edge), whole = dot(edge, edge);
  if (!(along > 0 && along < whole)) return {};
  return RationalPoint{whole * p + along * edge, whole, {whole - along, along}};
}

std::optional<RationalPoint> on_triangle(const IntegerVector& p, const IntegerVector& q,
                                         const IntegerVector& r) {
  const IntegerVector n = cross(q - p, r - p);
  // Twice the areas of the triangles between the projected origin and each side.
  std::vector<Integer> areas = {dot(n, cross(q, r)), dot(n, cross(r, p)), dot(n, cross(p, q))};
  for (const Integer& area : areas) {
    if (!(area > 0)) return {};
  }
  return RationalPoint{dot(n, p) * n, dot(n, n), std::move(areas)};
}

std::optional<RationalPoint> in_tetrahedron(const Points& s) {
  const auto volume = [](const IntegerVector& p, const IntegerVector& q, const IntegerVector& r) {
    return dot(p, cross(q, r));
  };
  const std::array<Integer, 4> parts = {volume(s[1], s[2], s[3]), -volume(s[0], s[2], s[3]),
                                        volume(s[0], s[1], s[3]), -volume(s[0], s[1], s[2])};
  for (const Integer& part : parts) {
    if (part.is_zero() || (part < 0) != (parts[0] < 0)) return {};
  }
  RationalPoint origin;
  for (const Integer& part : parts) origin.weights.emplace_back(abs(part));
  return origin;
}

std::optional<RationalPoint> nearest_inside(const Points& s) {
  switch (s.size()) {
    case 1: return RationalPoint{s[0], 1, {1}};
    case 2: return on_segment(s[0], s[1]);
    case 3: return on_triangle(s[0], s[1], s[2]);
    default: return in_tetrahedron(s);
  }
}

}  // namespace

RationalPoint reduce_to_nearest(Points& points) {
  const unsigned all = (1u << points.size()) - 1;
  for (unsigned subset = all; subset > 0; --subset) {
    Points chosen;
    for (unsigned i = 0; i < points.size(); ++i) {
      if ((subset >> i & 1) != 0) chosen.push_back(points[i]);
    }
    const std::optional<RationalPoint> z = nearest_inside(chosen);
    if (!z) continue;
    const Integer square = dot(z->numerator, z->numerator);
    bool nearest = true;
    for (unsigned i = 0; i < points.size() && nearest; ++i) {
      const bool outside = (subset >> i & 1) == 0;
      nearest = !outside || dot(z->numerator, points[i]) * z->denominator >= square;
    }
    if (!nearest) continue;
    points = std::move(chosen);
    return *z;
  }
  return {};  // never reached: one subset is the answer
}

}  // namespace touchstone::oracle
