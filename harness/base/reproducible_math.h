// Arithmetic that gives the same bits on every platform, for seeded scenes.
//
// Only + - * / and the square root round equally everywhere (IEEE 754). The functions of libm do
// not, and a matrix product of Eigen may be fused or reordered on another vector unit.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "algorithms/core/double_double.h"
#include "algorithms/core/orthonormal_error.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/vec.h"

namespace touchstone::base {

struct SinCos {
  double sin, cos;
};

// Sine and cosine of an angle in turns (1 = 360 degrees), correct to about an ulp of the angle and
// exact at multiples of a quarter.
inline SinCos sin_cos_turns(double turns) {
  turns -= std::floor(turns);
  const int quarter = static_cast<int>(std::floor(4 * turns + 0.5));  // 0 to 4
  const double x = 6.283185307179586476925 * (turns - 0.25 * quarter);
  const double xx = x * x;
  // Taylor's series on [-pi/4, pi/4], from the smallest term; the next term is below half an ulp.
  double s = 0, c = 0;
  for (int n = 16; n > 0; n -= 2) {
    s = (1 - s) * xx / (n * (n + 1));
    c = (1 - c) * xx / (n * (n - 1));
  }
  s = x - x * s;
  c = 1 - c;
  switch (quarter % 4) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

// The cube root of x > 0.
inline double cube_root(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // [0.5, 1)
  const int third = exponent >= 0 ? exponent / 3 : -((2 - exponent) / 3);
  const double target = std::ldexp(mantissa, exponent - 3 * third);  // [0.5, 4)
  double root = 1;
  for (int step = 0; step < 8; ++step) root -= (root - target / (root * root)) / 3;  // Newton
  return std::ldexp(root, third);
}

inline double length(const Vec3d& v) {
  return std::sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z());
}

inline double inner(const Vec3d& u, const Vec3d& v) {
  return u.x() * v.x() + u.y() * v.y() + u.z() * v.z();
}
inline Vec3d times(const Mat3d& m, const Vec3d& v) {
  return {m(0, 0) * v.x() + m(0, 1) * v.y() + m(0, 2) * v.z(),
          m(1, 0) * v.x() + m(1, 1) * v.y() + m(1, 2) * v.z(),
          m(2, 0) * v.x() + m(2, 1) * v.y() + m(2, 2) * v.z()};
}
inline Vec3d transposed_times(const Mat3d& m, const Vec3d& v) {
  return {m(0, 0) * v.x() + m(1, 0) * v.y() + m(2, 0) * v.z(),
          m(0, 1) * v.x() + m(1, 1) * v.y() + m(2, 1) * v.z(),
          m(0, 2) * v.x() + m(1, 2) * v.y() + m(2, 2) * v.z()};
}
inline Mat3d product(const Mat3d& a, const Mat3d& b) {
  Mat3d c;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  }
  return c;
}

// The pose `inner`, which is relative to `around`, where that is.
inline Pose placed(const Pose& around, const Pose& inner) {
  return {product(around.rotation, inner.rotation),
          times(around.rotation, inner.translation) + around.translation};
}

// The rotation of a nonzero quaternion (w, x, y, z) of any length. Exact for quarter turns.
inline Mat3d rotation_of(const std::array<double, 4>& q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double s = 2 / (w * w + x * x + y * y + z * z);
  Mat3d r;
  r << 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
      s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),   //
      s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y);
  return r;
}

// The same of a quaternion whose squares may overflow or underflow; nothing if it is zero.
inline std::optional<Mat3d> rotation_of_any(const std::array<double, 4>& q) {
  double size = 0;
  for (const double part : q) size = std::max(size, std::abs(part));
  if (!(size > 0)) return std::nullopt;
  return rotation_of({q[0] / size, q[1] / size, q[2] / size, q[3] / size});
}

// Whether a matrix of a file is used as a rotation, as it stands: to a thousandth, and right-handed.
inline bool is_rotation(const Mat3d& m) {
  return orthonormal_error(m) <= 1e-3 && !(m.determinant() < 0);
}

// The rotation by angular velocity w (radians per second) over a time (seconds): the exponential
// map.
inline Mat3d rotation_over(const Vec3d& w, double time) {
  const double rate = length(w);
  if (!(rate > 0)) return Mat3d::Identity();
  const SinCos half = sin_cos_turns(rate * time / (2 * 6.283185307179586476925));
  const double s = half.sin / rate;
  return rotation_of({half.cos, s * w.x(), s * w.y(), s * w.z()});
}

// Vector products in plain arithmetic, so that they round equally on every platform and with every
// Eigen.

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

// Returns the rotation by the smallest angle that takes `from` to the direction of `to`; where they are opposite it is
// one of many. The vectors may have any length but zero. Rounding is in proportion to 1 / (1 + cosine), but for the last
// 1e-12 before opposites, where it is small. Eigen's function of that kind, whose bits these are elsewhere, falls back on
// a singular value decomposition, which takes ten seconds to compile.
Mat3d rotation_between(const Vec3d& from, const Vec3d& to);

}  // namespace touchstone::base
