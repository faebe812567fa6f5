// Triangles in integers.
//
// Two triangles share a point if and only if an edge of one shares a point with the other. For
// their common points are a convex set, and one of its corners is on an edge of one of them: two
// planes that cross have a line in common, so that a corner in the interior of both is none.
#include "algorithms/kernels/triangles/exact_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace touchstone {
namespace {

ExactPoint operator-(const ExactPoint& u, const ExactPoint& v) {
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
ExactPoint cross(const ExactPoint& u, const ExactPoint& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
ExactInteger dot(const ExactPoint& u, const ExactPoint& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
// An axis along which the vector is not zero; -1 if there is none.
int axis_of(const ExactPoint& v) {
  for (int k = 0; k < 3; ++k) {
    if (!v[k].is_zero()) return k;
  }
  return -1;
}

// mantissa * 2^exponent; the mantissa is odd, or zero with a great exponent.
struct Dyadic {
  static constexpr int of_zero = std::numeric_limits<int>::max() / 4;
  std::int64_t mantissa = 0;
  int exponent = of_zero;

  Dyadic() = default;
  explicit Dyadic(double x) {
    if (x == 0) return;
    mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    mantissa /= std::int64_t{1} << zeros;
    exponent += zeros - 53;
  }
  bool is_zero() const { return mantissa == 0; }
};

// The sum of three products and a number, term by term.
struct Terms {
  std::array<Dyadic, 3> left, right;
  Dyadic added;

  int least_exponent() const {
    int least = added.exponent;
    for (int k = 0; k < 3; ++k) {
      if (left[k].is_zero() || right[k].is_zero()) continue;
      least = std::min(least, left[k].exponent + right[k].exponent);
    }
    return least;
  }
  ExactInteger over_power(int e) const {
    ExactInteger sum = 0;
    for (int k = 0; k < 3; ++k) {
      if (left[k].is_zero() || right[k].is_zero()) continue;
      ExactInteger product = left[k].mantissa;
      product *= right[k].mantissa;
      sum += product << (left[k].exponent + right[k].exponent - e);
    }
    if (!added.is_zero()) sum += ExactInteger(added.mantissa) << (added.exponent - e);
    return sum;
  }
};

// --- in the plane without the axis k, which is not parallel to the plane of all these points ------

struct Plane {
  int x, y;
  explicit Plane(int k) : x((k + 1) % 3), y((k + 2) % 3) {}

  int area_sign(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) const {
    const ExactInteger area = (b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]);
    return area.sign();
  }
};

bool boxes_meet(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c,
                const ExactPoint& d) {
  for (int k = 0; k < 3; ++k) {
    if (std::max(a[k], b[k]) < std::min(c[k], d[k])) return false;
    if (std::max(c[k], d[k]) < std::min(a[k], b[k])) return false;
  }
  return true;
}

// Segments in one plane.
bool segments_meet(const Plane& plane, const ExactPoint& a, const ExactPoint& b,
                   const ExactPoint& c, const ExactPoint& d) {
  if (!boxes_meet(a, b, c, d)) return false;
  return plane.area_sign(a, b, c) * plane.area_sign(a, b, d) <= 0 &&
         plane.area_sign(c, d, a) * plane.area_sign(c, d, b) <= 0;
}

// Segments anywhere, which may be points.
bool segments_meet(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c,
                   const ExactPoint& d) {
  if (!boxes_meet(a, b, c, d)) return false;
  const ExactPoint along = b - a, other = d - c, between = c - a;
  const ExactPoint normal = cross(along, other);
  const int axis = axis_of(normal);
  if (axis >= 0) return dot(normal, between).is_zero() && segments_meet(Plane(axis), a, b, c, d);
  // They are parallel, or points: on one line, boxes that meet have a common point.
  return axis_of(cross(between, along)) < 0 && axis_of(cross(between, other)) < 0;
}

bool segment_meets(const ExactPoint& p, const ExactPoint& q, const ExactTriangle& t,
                   const ExactPoint& normal) {
  const int axis = axis_of(normal);
  if (axis < 0) {
    return segments_meet(p, q, t[0], t[1]) || segments_meet(p, q, t[1], t[2]) ||
           segments_meet(p, q, t[2], t[0]);
  }
  const int side_p = dot(normal, p - t[0]).sign(), side_q = dot(normal, q - t[0]).sign();
  if (side_p * side_q > 0) return false;
  std::array<int, 3> turns;
  if (side_p != 0 || side_q != 0) {
    for (int i = 0; i < 3; ++i) turns[i] = volume_sign(p, q, t[i], t[(i + 1) % 3]);
    return std::ranges::min(turns) >= 0 || std::ranges::max(turns) <= 0;
  }
  const Plane plane(axis);
  for (int i = 0; i < 3; ++i) {
    if (segments_meet(plane, p, q, t[i], t[(i + 1) % 3])) return true;
    turns[i] = plane.area_sign(t[i], t[(i + 1) % 3], p);
  }
  return std::ranges::min(turns) >= 0 || std::ranges::max(turns) <= 0;
}

bool an_edge_meets(const ExactTriangle& edges, const ExactTriangle& t) {
  const ExactPoint normal = cross(t[1] - t[0], t[2] - t[0]);
  for (int i = 0; i < 3; ++i) {
    if (segment_meets(edges[i], edges[(i + 1) % 3], t, normal)) return true;
  }
  return false;
}

}  // namespace

void place_exactly(std::span<const PlacedPoint> points, ExactPoint* placed) {
  std::vector<Terms> terms(3 * points.size());
  int least = Dyadic::of_zero;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const PlacedPoint& from = points[i / 3];
    const int row = static_cast<int>(i % 3);
    for (int k = 0; k < 3; ++k) {
      terms[i].left[k] = Dyadic(from.pose->rotation(row, k));
      terms[i].right[k] = Dyadic((*from.point)[k]);
    }
    terms[i].added = Dyadic(from.pose->translation[row]);
    least = std::min(least, terms[i].least_exponent());
  }
  for (std::size_t i = 0; i < terms.size(); ++i) placed[i / 3][i % 3] = terms[i].over_power(least);
}

int volume_sign(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c,
                const ExactPoint& d) {
  return dot(cross(b - a, c - a), d - a).sign();
}

bool share_a_point(const ExactTriangle& a, const ExactTriangle& b) {
  return an_edge_meets(a, b) || an_edge_meets(b, a);
}

bool share_a_point(const TriangleCorners& a, const Pose& pose_a, const TriangleCorners& b,
                   const Pose& pose_b) {
  std::array<PlacedPoint, 6> points;
  for (int i = 0; i < 3; ++i) {
    points[i] = {&a[i], &pose_a};
    points[3 + i] = {&b[i], &pose_b};
  }
  std::array<ExactPoint, 6> placed;
  place_exactly(points, placed.data());
  return share_a_point(ExactTriangle{placed[0], placed[1], placed[2]},
                       ExactTriangle{placed[3], placed[4], placed[5]});
}

}  // namespace touchstone
