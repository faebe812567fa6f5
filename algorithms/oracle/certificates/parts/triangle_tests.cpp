// A triangle is what lies over its area, and its three edges. All is seen from the ray's origin, or the point.
#include "algorithms/oracle/certificates/parts/triangle_tests.h"

#include <algorithm>

namespace touchstone::oracle {
namespace {

RationalTriangle seen(const RationalVector& from, const RationalTriangle& triangle) {
  return {triangle[0] - from, triangle[1] - from, triangle[2] - from};
}

// The first time on the segment from p to q.
std::optional<mpq_class> first_on_edge(const RationalVector& direction, const RationalVector& p,
                                       const RationalVector& q) {
  const RationalVector edge = q - p, across = cross(direction, edge);
  if (!is_zero(across)) {
    // t * direction = p + s * edge, times the edge and times the direction.
    if (dot(p, across) != 0) return {};
    const mpq_class square = dot(across, across);
    const mpq_class s = dot(cross(p, direction), across) / square;
    const mpq_class t = dot(cross(p, edge), across) / square;
    if (s < 0 || s > 1 || t < 0) return {};
    return t;
  }
  if (!is_zero(cross(p, direction))) return {};
  const mpq_class square = dot(direction, direction);
  const mpq_class at_p = dot(p, direction) / square, at_q = dot(q, direction) / square;
  if (at_p < 0 && at_q < 0) return {};
  return std::max<mpq_class>(0, std::min(at_p, at_q));
}

// True if the line through the origin along the normal meets the triangle with that normal.
bool is_over(const RationalVector& normal, const RationalTriangle& t) {
  return dot(normal, cross(t[0], t[1])) >= 0 && dot(normal, cross(t[1], t[2])) >= 0 &&
         dot(normal, cross(t[2], t[0])) >= 0;
}

}  // namespace

std::optional<mpq_class> first_time(const RationalVector& origin, const RationalVector& direction,
                                    const RationalTriangle& triangle) {
  const RationalTriangle t = seen(origin, triangle);
  const RationalVector normal = cross(t[1] - t[0], t[2] - t[0]);
  if (!is_zero(normal)) {
    const mpq_class height = dot(normal, t[0]), speed = dot(normal, direction);
    if (speed != 0) {
      const mpq_class time = height / speed;
      if (time < 0 || !is_over(normal, seen(time * direction, t))) return {};
      return time;
    }
    if (height != 0) return {};
    if (is_over(normal, t)) return mpq_class(0);
  }
  std::optional<mpq_class> first;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto time = first_on_edge(direction, t[k], t[(k + 1) % 3]);
    if (time && (!first || *time < *first)) first = time;
  }
  return first;
}

mpq_class squared_distance(const RationalVector& point, const RationalTriangle& triangle) {
  const RationalTriangle t = seen(point, triangle);
  const RationalVector normal = cross(t[1] - t[0], t[2] - t[0]);
  if (!is_zero(normal) && is_over(normal, t)) {
    const mpq_class height = dot(normal, t[0]);
    return height * height / dot(normal, normal);
  }
  mpq_class least = dot(t[0], t[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const RationalVector &p = t[k], edge = t[(k + 1) % 3] - p;
    const mpq_class square = dot(edge, edge);
    const mpq_class along =
        square == 0 ? mpq_class(0) : mpq_class(std::clamp<mpq_class>(-dot(p, edge) / square, 0, 1));
    const RationalVector nearest = p + along * edge;
    least = std::min<mpq_class>(least, dot(nearest, nearest));
  }
  return least;
}

}  // namespace touchstone::oracle
