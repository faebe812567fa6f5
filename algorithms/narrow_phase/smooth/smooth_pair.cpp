// The support functions of smooth_pair.h.
#include "algorithms/narrow_phase/smooth/smooth_pair.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
SmoothCore::SmoothCore(const PosedShape<double>& body, double unit, bool mirrored)
    : core_(body.shape().core) {
  const Vec3d& e = body.shape().extents;
  const double scale = body.shape().unit / unit;
  for (int k = 0; k < 3; ++k) edges_[k] = (mirrored ? -e[k] : e[k]) * body.matrix().col(k);
  if (is_ball()) {
    radius_ = scale * e.maxCoeff();
    return;
  }
  if (has_disc()) radius_ = scale * e.x();
  const double half = scale * e.z();
  has_tie_ = half > 1e-12 && core_ != SupportCore::point;
  axis_ = (mirrored ? -1 / scale : 1 / scale) * body.matrix().col(2);
  if (is_cone()) tilt_ = radius_ / std::sqrt(radius_ * radius_ + 4 * half * half);
}

bool is_rotation(const Mat3d& m) {
  constexpr double most = 1e-12;
  const Vec3d x = m.col(0), y = m.col(1), z = m.col(2);
  // This form of the comparisons is false for NaN.
  return std::abs(x.dot(x) - 1) < most && std::abs(y.dot(y) - 1) < most &&
         std::abs(z.dot(z) - 1) < most && std::abs(x.dot(y)) < most && std::abs(y.dot(z)) < most &&
         std::abs(z.dot(x)) < most;
}

}  // namespace touchstone
