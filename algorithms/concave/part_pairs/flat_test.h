// Part of part-pairs: two triangles in one plane, in doubles: an edge crosses an edge, or a corner of
// one is in the other.
#pragma once

#include <algorithm>
#include <array>

#include "algorithms/kernels/triangles/exact_triangles.h"

namespace touchstone {

struct FlatPoint {
  double x, y;
};
using FlatTriangle = std::array<FlatPoint, 3>;

inline double turn(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

inline bool edges_cross(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c,
                        const FlatPoint& d) {
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y)) {
    return false;
  }
  return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
}

inline bool is_in(const FlatPoint& p, const FlatTriangle& t) {
  const double r = turn(t[0], t[1], p), s = turn(t[1], t[2], p), u = turn(t[2], t[0], p);
  return (r >= 0 && s >= 0 && u >= 0) || (r <= 0 && s <= 0 && u <= 0);
}

// True if the triangles share a point, where both are in one plane with this normal.
inline bool flat_test(const TriangleCorners& a, const TriangleCorners& b, const Vec3d& normal) {
  int longest = 0;
  normal.cwiseAbs().maxCoeff(&longest);
  const int x = (longest + 1) % 3, y = (longest + 2) % 3;
  FlatTriangle p, q;
  for (int k = 0; k < 3; ++k) {
    p[k] = {a[k][x], a[k][y]};
    q[k] = {b[k][x], b[k][y]};
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (edges_cross(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3])) return true;
    }
  }
  return is_in(p[0], q) || is_in(q[0], p);
}

}  // namespace touchstone
