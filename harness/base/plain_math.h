// Vector products in plain arithmetic, so that they round equally on every platform and with every
// Eigen.
#pragma once

#include <array>
#include <cmath>

#include "algorithms/core/double_double.h"
#include "algorithms/core/vec.h"
#include "harness/base/reproducible_math.h"

namespace touchstone::base {

inline Vec3d outer(const Vec3d& u, const Vec3d& v) {
  return {u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(),
          u.x() * v.y() - u.y() * v.x()};
}
// A vector of length 1 up to rounding; the x axis if v is zero. No square overflows or underflows.
inline Vec3d unit(const Vec3d& v) {
  const double greatest = v.cwiseAbs().maxCoeff();
  if (!(greatest > 0)) return Vec3d::UnitX();
  const Vec3d scaled = v / greatest;
  return scaled / length(scaled);
}
// The unit vector perpendicular to the unit vector n that is nearest to `wish` (not along n).
inline Vec3d beside(const Vec3d& n, const Vec3d& wish) { return unit(outer(outer(n, wish), n)); }

// Products in double-double precision.
inline DoubleDouble3 exactly(const Vec3d& v) { return {{v.x(), 0}, {v.y(), 0}, {v.z(), 0}}; }
inline DoubleDouble3 scaled(const DoubleDouble3& v, const DoubleDouble& factor) {
  return {v.x * factor, v.y * factor, v.z * factor};
}
inline DoubleDouble3 times(const Mat3d& m, const DoubleDouble3& v) {
  const auto row = [&](int i) {
    return v.x * DoubleDouble{m(i, 0), 0} + v.y * DoubleDouble{m(i, 1), 0} +
           v.z * DoubleDouble{m(i, 2), 0};
  };
  return {row(0), row(1), row(2)};
}
// The direction of v with length 1 to about 1e-31.
inline DoubleDouble3 true_unit(const Vec3d& v) {
  const Vec3d n = unit(v);
  const DoubleDouble3 wide = exactly(n);
  // 1 / sqrt(1 + e) = 1 - e / 2 + ..., with e of a few units in the last place.
  const DoubleDouble excess = dot(wide, wide) - DoubleDouble{1, 0};
  return scaled(wide, DoubleDouble{1, 0} - excess * DoubleDouble{0.5, 0});
}

}  // namespace touchstone::base
