// Closest points of two segments about their centres.
#include "algorithms/kernels/motion/advancement/round_cores.h"

#include <algorithm>

namespace touchstone {
namespace {

// x / y in [-1, 1]; 0 where y is not positive.
double within(double x, double y) { return y > 0 ? std::clamp(x / y, -1.0, 1.0) : 0.0; }

}  // namespace

Vec3d half_axis(const PosedShape<double>& shape) {
  if (shape.shape().core == SupportCore::point) return Vec3d::Zero();
  return shape.shape().extents.z() * shape.matrix().col(2);
}

ClosestOfRound closest_of_round(SupportPair<double>& pair) {
  return closest_of_segments(half_axis(pair.a()), half_axis(pair.b()), pair.centre_b());
}

ClosestOfRound closest_of_segments(const Vec3d& p, const Vec3d& q, const Vec3d& offset) {
  // The point s p is to be near offset + t q.
  const double pp = p.squaredNorm(), qq = q.squaredNorm(), pq = p.dot(q);
  const double along_p = offset.dot(p), along_q = offset.dot(q);
  double s = within(along_p * qq - along_q * pq, pp * qq - pq * pq);
  const double t = within(s * pq - along_q, qq);
  s = within(along_p + t * pq, pp);
  const Vec3d on_a = s * p, on_b = t * q;
  return {on_a, on_b, offset + on_b - on_a, s, t};
}

}  // namespace touchstone
