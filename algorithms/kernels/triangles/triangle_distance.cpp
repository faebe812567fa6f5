// The distance of triangles by their edges and by corners over faces.
#include "algorithms/kernels/triangles/triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// The nearest points of the segments from p along u and from q along v, as parts of their lengths.
struct Along {
  double s, t;
};
Along nearest_on_segments(const Vec3d& p, const Vec3d& u, const Vec3d& q, const Vec3d& v) {
  const Vec3d between = p - q;
  const double a = u.dot(u), e = v.dot(v), f = v.dot(between);
  if (a == 0 && e == 0) return {0, 0};
  if (a == 0) return {0, std::clamp(f / e, 0.0, 1.0)};
  const double c = u.dot(between);
  if (e == 0) return {std::clamp(-c / a, 0.0, 1.0), 0};
  const double b = u.dot(v), denominator = a * e - b * b;
  double s = denominator > 0 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0;
  double t = (b * s + f) / e;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((b * t - c) / a, 0.0, 1.0);
  }
  return {s, t};
}

void keep_nearer(TriangleDistance& best, const Vec3d& on_a, const Vec3d& on_b) {
  const double distance = (on_a - on_b).norm();
  if (distance < best.distance) best = {on_a, on_b, distance};
}

// The foot of p on the plane of the triangle, if it is in the triangle: a mean of the corners, so that
// it is a point of the triangle whatever is rounded.
bool foot(const Vec3d& p, const TriangleCorners& t, const Vec3d& normal, Vec3d& at) {
  Vec3d weight;
  for (int k = 0; k < 3; ++k) {
    const Vec3d &tail = t[(k + 1) % 3], &head = t[(k + 2) % 3];
    weight[k] = (head - tail).cross(p - tail).dot(normal);
  }
  const double sum = weight.sum();
  if (!(sum > 0) || weight.minCoeff() < 0) return false;
  at = (t[0] * weight[0] + t[1] * weight[1] + t[2] * weight[2]) / sum;
  return true;
}

// How far b begins behind a's end along the axis, in either sense; metres.
double gap_along(const Vec3d& axis, const TriangleCorners& a, const TriangleCorners& b) {
  const double length = axis.norm();
  if (!(length > 0)) return 0;
  Vec3d on_a, on_b;
  for (int k = 0; k < 3; ++k) {
    on_a[k] = axis.dot(a[k] - a[0]);
    on_b[k] = axis.dot(b[k] - a[0]);
  }
  return std::max(on_b.minCoeff() - on_a.maxCoeff(), on_a.minCoeff() - on_b.maxCoeff()) / length;
}

Vec3d without(const Vec3d& v, const Vec3d& edge) {
  const double square = edge.squaredNorm();
  return square > 0 ? Vec3d(v - edge * (edge.dot(v) / square)) : v;
}

}  // namespace

TriangleDistance triangle_distance(const TriangleCorners& a, const TriangleCorners& b) {
  TriangleDistance best = {a[0], b[0], (a[0] - b[0]).norm()};
  for (int i = 0; i < 3; ++i) {
    const Vec3d u = a[(i + 1) % 3] - a[i];
    for (int j = 0; j < 3; ++j) {
      const Vec3d v = b[(j + 1) % 3] - b[j];
      const Along at = nearest_on_segments(a[i], u, b[j], v);
      keep_nearer(best, a[i] + u * at.s, b[j] + v * at.t);
    }
  }
  const Vec3d normal_a = (a[1] - a[0]).cross(a[2] - a[0]);
  const Vec3d normal_b = (b[1] - b[0]).cross(b[2] - b[0]);
  Vec3d at;
  for (int k = 0; k < 3; ++k) {
    if (foot(b[k], a, normal_a, at)) keep_nearer(best, at, b[k]);
    if (foot(a[k], b, normal_b, at)) keep_nearer(best, a[k], at);
  }
  return best;
}

TriangleDistance distance_to_edges(const Segment& segment, const TriangleCorners& triangle) {
  TriangleDistance best = {segment[0], triangle[0], (segment[0] - triangle[0]).norm()};
  const Vec3d u = segment[1] - segment[0];
  for (int k = 0; k < 3; ++k) {
    const Vec3d v = triangle[(k + 1) % 3] - triangle[k];
    const Along at = nearest_on_segments(segment[0], u, triangle[k], v);
    keep_nearer(best, segment[0] + u * at.s, triangle[k] + v * at.t);
  }
  return best;
}

double distance_bound(const TriangleCorners& a, const TriangleCorners& b,
                      const TriangleDistance& nearest) {
  const Vec3d way = nearest.on_b - nearest.on_a;
  double bound = std::max(0.0, gap_along(way, a, b));
  const auto enough = [&] { return bound >= nearest.distance * (1 - 0x1p-48); };
  if (enough()) return bound;
  const auto consider = [&](const Vec3d& axis) { bound = std::max(bound, gap_along(axis, a, b)); };
  consider((a[1] - a[0]).cross(a[2] - a[0]));
  consider((b[1] - b[0]).cross(b[2] - b[0]));
  for (int i = 0; i < 3 && !enough(); ++i) {
    const Vec3d u = a[(i + 1) % 3] - a[i];
    consider(without(way, u));
    consider(without(way, b[(i + 1) % 3] - b[i]));
    for (int j = 0; j < 3; ++j) consider(u.cross(b[(j + 1) % 3] - b[j]));
  }
  return bound;
}

}  // namespace touchstone
