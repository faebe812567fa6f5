// Gaps along the fifteen axes of two boxes, and the rates at which they close.
#include "algorithms/kernels/motion/advancement/box_planes.h"

#include <cmath>

#include "algorithms/kernels/motion/advancement/turning_normal.h"

namespace touchstone {
namespace {

constexpr int next(int i) { return i == 2 ? 0 : i + 1; }

double sign_of(double x) { return std::copysign(1.0, x); }

// The axis whose gap lasts longest so far.
struct Axis {
  double lasts = -1;         // for how long, if the rate stays
  int of_a = -1, of_b = -1;  // faces, or both for edges
  double sense = 1;

  // `gap` and `rate` may be times any length.
  void consider(double gap, double rate, int a, int b, double sign) {
    constexpr double least_rate = 1e-3;  // a gap that hardly closes lasts for as long as it is wide
    const double time = gap / std::max(-rate, least_rate * gap);
    if (!(time > lasts)) return;
    lasts = time;
    of_a = a;
    of_b = b;
    sense = sign;
  }
};

}  // namespace

std::optional<BoxPlane> longest_open_plane(SupportPair<double>& pair, const PairMotion& motion,
                                           double least_gap) {
  const Mat3d &a = pair.a().matrix(), &b = pair.b().matrix();
  // Columns are of these lengths, up to rounding.
  const double scale_a = pair.a().shape().unit / pair.unit();
  const double scale_b = pair.b().shape().unit / pair.unit();
  const Vec3d p = scale_a * pair.a().shape().extents, q = scale_b * pair.b().shape().extents;
  const Vec3d& offset = pair.centre_b();
  const Vec3d velocity = motion.velocity / pair.unit();
  const Vec3d turn = motion.turn_b - motion.turn_a;
  // The offset, its rate and the axes of b as seen from a, and the first two as seen from b.
  const Vec3d c = a.transpose() * offset / scale_a;
  const Vec3d v = a.transpose() * (velocity - motion.turn_a.cross(offset)) / scale_a;
  const Vec3d d = b.transpose() * offset / scale_b;
  const Vec3d w = b.transpose() * (velocity - motion.turn_b.cross(offset)) / scale_b;
  const Vec3d turn_in_a = a.transpose() * turn / scale_a;
  const Mat3d m = a.transpose() * b / (scale_a * scale_b);
  Mat3d rate, size, size_rate;  // of m, of |m|
  for (int j = 0; j < 3; ++j) {
    rate.col(j) = turn_in_a.cross(m.col(j));
    for (int i = 0; i < 3; ++i) {
      size(i, j) = std::abs(m(i, j));
      size_rate(i, j) = sign_of(m(i, j)) * rate(i, j);
    }
  }
  Axis best;
  for (int i = 0; i < 3; ++i) {
    const double gap = std::abs(c[i]) - p[i] - size.row(i).dot(q);
    if (gap > least_gap) {
      best.consider(gap, sign_of(c[i]) * v[i] - size_rate.row(i).dot(q), i, -1, sign_of(c[i]));
    }
  }
  for (int j = 0; j < 3; ++j) {
    const double gap = std::abs(d[j]) - q[j] - size.col(j).dot(p);
    if (gap > least_gap) {
      best.consider(gap, sign_of(d[j]) * w[j] - size_rate.col(j).dot(p), -1, j, sign_of(d[j]));
    }
  }
  constexpr double nearly_parallel = 0.05;
  for (int i = 0; i < 3; ++i) {
    const int k = next(i), l = next(k);
    for (int j = 0; j < 3; ++j) {
      const int s = next(j), t = next(s);
      const double along = c[l] * m(k, j) - c[k] * m(l, j);
      const double gap = std::abs(along) - p[k] * size(l, j) - p[l] * size(k, j) -
                         q[s] * size(i, t) - q[t] * size(i, s);
      if (!(gap > 0)) continue;
      const double square = m(k, j) * m(k, j) + m(l, j) * m(l, j);
      if (!(gap * gap > least_gap * least_gap * square) ||
          !(square > nearly_parallel * nearly_parallel)) {
        continue;
      }
      const double change = v[l] * m(k, j) + c[l] * rate(k, j) - v[k] * m(l, j) - c[k] * rate(l, j);
      best.consider(gap,
                    sign_of(along) * change - p[k] * size_rate(l, j) - p[l] * size_rate(k, j) -
                        q[s] * size_rate(i, t) - q[t] * size_rate(i, s),
                    i, j, sign_of(along));
    }
  }
  if (best.of_a < 0 && best.of_b < 0) return {};
  if (best.of_b < 0) return BoxPlane{best.sense / scale_a * a.col(best.of_a), motion.turn_a};
  if (best.of_a < 0) return BoxPlane{best.sense / scale_b * b.col(best.of_b), motion.turn_b};
  const Vec3d edge_a = a.col(best.of_a), edge_b = b.col(best.of_b);
  const Vec3d normal = best.sense * edge_a.cross(edge_b).normalized();
  return BoxPlane{normal,
                  turning_across_edges(edge_a, edge_b, normal, motion.turn_a, motion.turn_b)};
}

}  // namespace touchstone
