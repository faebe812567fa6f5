// The support functions of smooth_pair.h.
#include "algorithms/narrow_phase/smooth/smooth_pair.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
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

bool is_rotation(const Mat3d& m) {
  const Mat3d square = m.transpose() * m - Mat3d::Identity();
  // This form of the comparison is false for NaN.
  return square.cwiseAbs().maxCoeff() < 1e-12;
}

}  // namespace touchstone
