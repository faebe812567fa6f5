// The support functions of smooth_pair.h.
#include "algorithms/narrow_phase/smooth/smooth_pair.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

// Reaches below this have a direction of rounding only; lengths are at most about 1.
constexpr double least_reach = 1e-140;

}  // namespace

SmoothCore::SmoothCore(const PosedShape<double>& body, bool mirrored) : core_(body.shape().core) {
  const Vec3d& e = body.shape().extents;
  for (int k = 0; k < 3; ++k) edges_[k] = (mirrored ? -e[k] : e[k]) * body.matrix().col(k);
  if (is_ball()) {
    for (const Vec3d& edge : edges_) radius_ = std::max(radius_, edge.norm());
    return;
  }
  if (has_disc()) radius_ = std::max(edges_[0].norm(), edges_[1].norm());
  const double half = core_ == SupportCore::point ? 0 : edges_[2].norm();
  has_tie_ = half > 1e-12;
  const double length = body.matrix().col(2).norm();
  axis_ = (mirrored ? -1 / length : 1 / length) * body.matrix().col(2);
  if (is_cone()) tilt_ = radius_ / std::sqrt(radius_ * radius_ + 4 * half * half);
}

SmoothPoint SmoothCore::furthest(const Vec3d& n) const {
  SmoothPoint found;
  if (core_ == SupportCore::point) return found;
  const double x = edges_[0].dot(n), y = edges_[1].dot(n), z = edges_[2].dot(n);
  if (core_ == SupportCore::segment) {
    found.point = z < 0 ? Vec3d(-edges_[2]) : edges_[2];
    found.height = std::abs(z);
    return found;
  }
  if (is_ball()) {
    found.reach = found.height = std::sqrt(x * x + y * y + z * z);
    if (!(found.reach > least_reach)) return found;
    const Vec3d w = Vec3d(x, y, z) / found.reach;
    found.point = w.x() * edges_[0] + w.y() * edges_[1] + w.z() * edges_[2];
    // Two unit vectors across w.
    const double sign = std::copysign(1.0, w.z()), t = -1 / (sign + w.z()), s = w.x() * w.y() * t;
    const Vec3d u(1 + sign * w.x() * w.x() * t, sign * s, -sign * w.x());
    const Vec3d v(s, sign + w.y() * w.y() * t, -w.y());
    found.turn = u.x() * edges_[0] + u.y() * edges_[1] + u.z() * edges_[2];
    found.turn_2 = v.x() * edges_[0] + v.y() * edges_[1] + v.z() * edges_[2];
    return found;
  }
  found.reach = std::sqrt(x * x + y * y);
  found.is_tip = is_cone() && 2 * z > found.reach;
  if (found.is_tip) {
    found.point = edges_[2];
    found.height = z;
    return found;
  }
  const bool down = is_cone() || z < 0;
  found.height = found.reach + (down ? -z : z);
  found.point = down ? Vec3d(-edges_[2]) : edges_[2];
  if (!(found.reach > least_reach)) return found;
  const double along = x / found.reach, across = y / found.reach;
  found.point += along * edges_[0] + across * edges_[1];
  found.turn = along * edges_[1] - across * edges_[0];
  return found;
}

double SmoothPair::height(const Vec3d& n) const {
  return a.furthest(n).height + b.furthest(n).height + n.dot(offset);
}

bool is_rotation(const Mat3d& m) {
  const Mat3d square = m.transpose() * m - Mat3d::Identity();
  // This form of the comparison is false for NaN.
  return square.cwiseAbs().maxCoeff() < 1e-12;
}

}  // namespace touchstone
