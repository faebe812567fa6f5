// Distance and depth of two boxes by brute force in long double.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "harness/files/cases.h"

namespace touchstone {

using WideVector = Eigen::Matrix<long double, 3, 1>;

struct WideBox {
  std::array<WideVector, 8> corners;  // bit i of the index: the positive side of axis i
  std::array<WideVector, 3> axes;

  WideBox(const Shape& shape, const Pose& pose) {
    const Eigen::Matrix<long double, 3, 3> rotation = pose.rotation.cast<long double>();
    for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(i)] = rotation.col(i);
    for (int i = 0; i < 8; ++i) {
      WideVector v = shape.half_extents.cast<long double>();
      for (int k = 0; k < 3; ++k) {
        if ((i >> k & 1) == 0) v[k] = -v[k];
      }
      corners[static_cast<std::size_t>(i)] = rotation * v + pose.translation.cast<long double>();
    }
  }
};

using WideSegment = std::array<WideVector, 2>;

inline std::vector<WideSegment> edges_of(const WideBox& box) {
  std::vector<WideSegment> edges;
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if ((i >> k & 1) == 0) edges.push_back({box.corners[i], box.corners[i | 1u << k]});
    }
  }
  return edges;
}

inline long double distance_to(const WideSegment& s, const WideVector& p) {
  const WideVector d = s[1] - s[0];
  const long double t = std::clamp((p - s[0]).dot(d) / d.dot(d), 0.0L, 1.0L);
  return (s[0] + t * d - p).norm();
}

inline long double distance_between(const WideSegment& s, const WideSegment& t) {
  long double least = std::min(
      {distance_to(s, t[0]), distance_to(s, t[1]), distance_to(t, s[0]), distance_to(t, s[1])});
  // The lines' closest points count if they are inside both segments.
  const WideVector u = s[1] - s[0], v = t[1] - t[0], w = s[0] - t[0];
  const WideVector n = u.cross(v);
  const long double square = n.dot(n);
  if (square > 1e-12L * u.dot(u) * v.dot(v)) {
    const long double at_s = -w.cross(v).dot(n) / square;
    const long double at_t = -w.cross(u).dot(n) / square;
    if (at_s >= 0 && at_s <= 1 && at_t >= 0 && at_t <= 1) {
      least = std::min(least, std::abs(w.dot(n)) / std::sqrt(square));
    }
  }
  return least;
}

// Returns the distance of a point to those faces of a box that it is over.
inline long double distance_to_faces(const WideBox& box, const WideVector& p) {
  long double least = std::numeric_limits<long double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    for (const std::size_t side : {std::size_t{0}, std::size_t{1} << k}) {
      const WideVector origin = box.corners[side];
      const WideVector u = box.corners[side | 1u << (k + 1) % 3] - origin;
      const WideVector v = box.corners[side | 1u << (k + 2) % 3] - origin;
      const WideVector n = u.cross(v).normalized();
      const WideVector q = p - origin;
      const long double at_u = q.dot(u) / u.dot(u), at_v = q.dot(v) / v.dot(v);
      if (at_u < 0 || at_u > 1 || at_v < 0 || at_v > 1) continue;
      least = std::min(least, std::abs(q.dot(n)));
    }
  }
  return least;
}

// Returns the distance of two boxes that are apart.
inline long double box_distance(const files::Case& c) {
  const WideBox a(c.shape_a, c.pose_a), b(c.shape_b, c.pose_b);
  long double least = std::numeric_limits<long double>::infinity();
  for (const WideSegment& s : edges_of(a)) {
    for (const WideSegment& t : edges_of(b)) least = std::min(least, distance_between(s, t));
  }
  for (const WideVector& p : a.corners) least = std::min(least, distance_to_faces(b, p));
  for (const WideVector& p : b.corners) least = std::min(least, distance_to_faces(a, p));
  return least;
}

// Returns the least overlap of the shadows on the normals of faces and of pairs of edges.
inline long double box_depth(const files::Case& c) {
  const WideBox a(c.shape_a, c.pose_a), b(c.shape_b, c.pose_b);
  std::vector<WideVector> axes;
  for (std::size_t i = 0; i < 3; ++i) {
    axes.push_back(a.axes[i]);
    axes.push_back(b.axes[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      const WideVector n = a.axes[i].cross(b.axes[k]);
      if (n.norm() > 1e-6L) axes.push_back(n);
    }
  }
  long double least = std::numeric_limits<long double>::infinity();
  for (const WideVector& axis : axes) {
    for (const long double sign : {-1.0L, 1.0L}) {
      const WideVector n = sign * axis.normalized();
      long double high = -std::numeric_limits<long double>::infinity(), low = -high;
      for (const WideVector& p : a.corners) high = std::max(high, n.dot(p));
      for (const WideVector& p : b.corners) low = std::min(low, n.dot(p));
      least = std::min(least, high - low);
    }
  }
  return least;
}

}  // namespace touchstone
