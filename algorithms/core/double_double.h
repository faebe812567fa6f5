// Numbers of twice double's precision, where rounding of doubles would decide. Used by convex
// hulls.
#pragma once

#include <cmath>

#include "algorithms/core/vec.h"

namespace touchstone {

// The unevaluated sum high + low, with |low| at most half a unit in the last place of high: about
// 106 bits. Dekker, "A floating-point technique for extending the available precision", 1971;
// Knuth, TAOCP 2, 4.2.2. Every platform gives the same bits, since only +, - and std::fma are used.
// Overflow and underflow are not detected: scale first.
struct DoubleDouble {
  double high = 0, low = 0;

  static DoubleDouble sum(double a, double b) {
    const double s = a + b;
    const double t = s - a;
    return {s, (a - (s - t)) + (b - t)};
  }
  static DoubleDouble product(double a, double b) {
    const double p = a * b;
    return {p, std::fma(a, b, -p)};
  }
  double value() const { return high + low; }

  friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble s = sum(a.high, b.high);
    const DoubleDouble t = sum(a.low, b.low);
    const DoubleDouble u = sum(s.high, s.low + t.high);
    return sum(u.high, u.low + t.low);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble p = product(a.high, b.high);
    return sum(p.high, p.low + (a.high * b.low + a.low * b.high));
  }
};

struct DoubleDouble3 {
  DoubleDouble x, y, z;

  // Returns a - b, exactly.
  static DoubleDouble3 difference(const Vec3d& a, const Vec3d& b) {
    return {DoubleDouble::sum(a.x(), -b.x()), DoubleDouble::sum(a.y(), -b.y()),
            DoubleDouble::sum(a.z(), -b.z())};
  }
  Vec3d value() const { return {x.value(), y.value(), z.value()}; }

  friend DoubleDouble3 operator+(const DoubleDouble3& a, const DoubleDouble3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend DoubleDouble3 operator-(const DoubleDouble3& a, const DoubleDouble3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend DoubleDouble dot(const DoubleDouble3& a, const DoubleDouble3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend DoubleDouble3 cross(const DoubleDouble3& a, const DoubleDouble3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

}  // namespace touchstone
