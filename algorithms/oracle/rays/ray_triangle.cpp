// The ray and the triangle on one grid of integers.
//
// Steps: 1. Leave out triangles that lie behind the origin on an axis, by comparisons alone.
//        2. If the ray crosses the triangle's plane, take the point there and see on which side of
//           each edge it is.
//        3. If it lies in the plane, cut it off behind each edge in turn.
//        4. A triangle without area is a segment or a point: solve for the segment's parameter.
#include "algorithms/oracle/rays/ray_triangle.h"

#include <algorithm>
#include <cmath>

#include "algorithms/oracle/numbers/dyadic.h"
#include "algorithms/oracle/rays/on_grid.h"

namespace touchstone::oracle {
namespace {

bool lies_behind(const Vec3d& origin, const Vec3d& direction,
                 const std::array<Vec3d, 3>& triangle) {
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax({triangle[0][k], triangle[1][k], triangle[2][k]});
    if (direction[k] >= 0 && high < origin[k]) return true;
    if (direction[k] <= 0 && low > origin[k]) return true;
  }
  return false;
}

using oracle::least_exponent;
using oracle::on_grid;

// A vector whose components are sums of dyadic numbers, exactly.
using Terms = std::array<std::array<Dyadic, 4>, 3>;

Terms placed(const Vec3d& v, const Pose& pose) {
  Terms terms;
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 3; ++k) {
      const Dyadic a = dyadic(pose.rotation(row, k)), b = dyadic(v[k]);
      if (a.mantissa.is_zero() || b.mantissa.is_zero()) continue;
      terms[row][k] = {a.mantissa * b.mantissa, a.exponent + b.exponent};
    }
    terms[row][3] = dyadic(pose.translation[row]);
  }
  return terms;
}
int least_exponent(const Terms& terms) {
  int least = Dyadic::of_zero;
  for (const auto& row : terms) {
    for (const Dyadic& term : row) least = std::min(least, term.exponent);
  }
  return least;
}
IntegerVector on_grid(const Terms& terms, int exponent) {
  IntegerVector v;
  for (std::size_t row = 0; row < 3; ++row) {
    for (const Dyadic& term : terms[row]) v[row] += term.over_power(exponent);
  }
  return v;
}

// A number top / bottom with bottom > 0.
struct Fraction {
  Integer top, bottom;
};
Fraction fraction(const Integer& top, const Integer& bottom) {
  return bottom < 0 ? Fraction{-top, -bottom} : Fraction{top, bottom};
}
bool less(const Fraction& a, const Fraction& b) { return a.top * b.bottom < b.top * a.bottom; }

// Seen from the ray's origin, on the grid; the ray is the points t * direction.
struct Seen {
  std::array<IntegerVector, 3> corner;
  IntegerVector direction;
};

// Where the ray crosses the plane with this normal, which is not along it.
std::optional<Fraction> crossing(const Seen& seen, const IntegerVector& normal) {
  const Fraction t = fraction(dot(normal, seen.corner[0]), dot(normal, seen.direction));
  if (t.top < 0) return {};
  const IntegerVector at = t.top * seen.direction;  // times t.bottom, as all below
  for (std::size_t k = 0; k < 3; ++k) {
    const IntegerVector& from = seen.corner[k];
    const IntegerVector edge = seen.corner[(k + 1) % 3] - from;
    if (dot(normal, cross(edge, at - t.bottom * from)) < 0) return {};
  }
  return t;
}

// Where the ray, in the plane with this normal, is first in the triangle.
std::optional<Fraction> entry(const Seen& seen, const IntegerVector& normal) {
  Fraction first = {0, 1};
  std::optional<Fraction> last;
  for (std::size_t k = 0; k < 3; ++k) {
    const IntegerVector& from = seen.corner[k];
    const IntegerVector inward = cross(normal, seen.corner[(k + 1) % 3] - from);
    // Inside: inward . (t * direction - from) >= 0.
    const Integer speed = dot(inward, seen.direction), bound = dot(inward, from);
    if (speed.is_zero()) {
      if (bound > 0) return {};
      continue;
    }
    const Fraction t = fraction(bound, speed);
    if (speed > 0) {
      if (less(first, t)) first = t;
    } else if (!last || less(t, *last)) {
      last = t;
    }
  }
  if (last && less(*last, first)) return {};
  return first;
}

// Where the ray first meets the segment p q, or the point p = q.
std::optional<Fraction> meeting(const Seen& seen, const IntegerVector& p, const IntegerVector& q) {
  const IntegerVector& d = seen.direction;
  const IntegerVector along = q - p, across = cross(d, along);
  if (!is_zero(across)) {
    // t * d = p + s * along: both sides times `along` and times d.
    if (!dot(p, across).is_zero()) return {};
    const Integer square = dot(across, across);
    const Integer s = dot(cross(p, d), across), t = dot(cross(p, along), across);
    if (s < 0 || s > square || t < 0) return {};
    return Fraction{t, square};
  }
  if (!is_zero(cross(p, d))) return {};
  const Integer square = dot(d, d), at_p = dot(p, d), at_q = dot(q, d);
  if (at_p < 0 && at_q < 0) return {};
  if (at_p < 0 || at_q < 0) return Fraction{0, 1};
  return Fraction{std::min(at_p, at_q), square};
}

// The ends of a triangle without area.
std::array<std::size_t, 2> ends(const Seen& seen) {
  std::array<std::size_t, 2> best = {0, 1};
  Integer longest = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const IntegerVector edge = seen.corner[(k + 1) % 3] - seen.corner[k];
    const Integer square = dot(edge, edge);
    if (square > longest) {
      longest = square;
      best = {k, (k + 1) % 3};
    }
  }
  return best;
}

}  // namespace

double quotient(const Integer& top, const Integer& bottom) {
  if (top.is_zero()) return 0;
  const Integer magnitude = top < 0 ? Integer(-top) : top;
  const long shift = 64 + static_cast<long>(msb(bottom)) - static_cast<long>(msb(magnitude));
  const Integer digits =
      shift >= 0 ? Integer((magnitude << shift) / bottom) : Integer(magnitude / (bottom << -shift));
  const double value = round_down(digits, -shift);
  return top < 0 ? -value : value;
}

namespace {

// The corners are vectors or their terms.
template <class Corner>
std::optional<RayPoint> first_point_of(const Vec3d& origin, const Vec3d& direction,
                                       const std::array<Corner, 3>& triangle) {
  int exponent = least_exponent(origin);
  for (const Corner& corner : triangle) exponent = std::min(exponent, least_exponent(corner));
  const int of_direction = least_exponent(direction);
  Seen seen;
  const IntegerVector from = on_grid(origin, exponent);
  for (std::size_t k = 0; k < 3; ++k) seen.corner[k] = on_grid(triangle[k], exponent) - from;
  seen.direction = on_grid(direction, of_direction);
  const auto& [a, b, c] = seen.corner;
  const IntegerVector normal = cross(b - a, c - a);
  const bool flat = !is_zero(normal);
  std::optional<Fraction> t;
  if (!flat) {
    const auto [p, q] = ends(seen);
    t = meeting(seen, seen.corner[p], seen.corner[q]);
  } else if (!dot(normal, seen.direction).is_zero()) {
    t = crossing(seen, normal);
  } else if (dot(normal, a).is_zero()) {
    t = entry(seen, normal);
  }
  if (!t) return {};
  const IntegerVector at = t->top * seen.direction - t->bottom * a;  // from a, times t->bottom
  RayPoint point{t->top, t->bottom, 0, 0};
  if (flat) {
    const Integer area = t->bottom * dot(normal, normal);
    point.u = quotient(dot(cross(at, c - a), normal), area);
    point.v = quotient(dot(cross(b - a, at), normal), area);
  } else {
    const IntegerVector ab = b - a, ac = c - a;
    const Integer to_b = dot(ab, ab), to_c = dot(ac, ac);
    // The greater of the two has the point between its ends, or the point is beyond a on the other.
    const bool beyond = dot(at, to_b >= to_c ? ab : ac) < 0;
    if ((to_b >= to_c) != beyond) {
      if (!to_b.is_zero()) point.u = quotient(dot(at, ab), t->bottom * to_b);
    } else if (!to_c.is_zero()) {
      point.v = quotient(dot(at, ac), t->bottom * to_c);
    }
  }
  // The grids of the points and of the direction differ by a power of two.
  const int power = exponent >= Dyadic::of_zero ? 0 : exponent - of_direction;
  if (power >= 0) {
    point.top <<= power;
  } else {
    point.bottom <<= -power;
  }
  return point;
}

}  // namespace

std::optional<RayPoint> first_point(const Vec3d& origin, const Vec3d& direction,
                                    const std::array<Vec3d, 3>& triangle) {
  if (lies_behind(origin, direction, triangle)) return {};
  return first_point_of(origin, direction, triangle);
}

std::optional<RayPoint> first_point(const Vec3d& origin, const Vec3d& direction,
                                    const std::array<Vec3d, 3>& triangle, const Pose& pose) {
  return first_point_of<Terms>(
      origin, direction,
      {placed(triangle[0], pose), placed(triangle[1], pose), placed(triangle[2], pose)});
}

int compare_t(const RayPoint& first, const RayPoint& second) {
  return Integer(first.top * second.bottom - second.top * first.bottom).sign();
}

int compare_t(const RayPoint& point, double x) {
  const Dyadic number = dyadic(x);
  if (number.mantissa.is_zero()) return point.top.sign();
  if (number.exponent >= 0) {
    return Integer(point.top - (number.mantissa << number.exponent) * point.bottom).sign();
  }
  return Integer((point.top << -number.exponent) - number.mantissa * point.bottom).sign();
}

}  // namespace touchstone::oracle
