// Exact sums and products of doubles, as expansions: sums of doubles that do not overlap.
// Paper: Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
//        predicates", DCG 18, 1997.
#pragma once

#include <array>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone {

// Exact as long as nothing underflows or overflows: see `is_safe`.
class FloatExpansion {
 public:
  FloatExpansion() = default;  // 0
  explicit FloatExpansion(double x) {
    if (x != 0) terms_.push_back(x);
  }
  static FloatExpansion difference(double a, double b);

  int sign() const { return terms_.empty() ? 0 : (terms_.back() > 0 ? 1 : -1); }
  // Off by at most two units in its last place.
  double value() const;

  FloatExpansion operator-() const;
  friend FloatExpansion operator+(const FloatExpansion& a, const FloatExpansion& b);
  friend FloatExpansion operator-(const FloatExpansion& a, const FloatExpansion& b) {
    return a + -b;
  }
  friend FloatExpansion operator*(const FloatExpansion& a, const FloatExpansion& b);

 private:
  void add(double x);          // grows the sum by one double
  void compress();             // to few terms, the last of which is the sum, rounded
  std::vector<double> terms_;  // not zero, from the least to the greatest in magnitude
};

// Products of up to six numbers, differences of which are within these, have no term below the least
// double or beyond the greatest.
inline bool is_safe(double x) {
  const double magnitude = x < 0 ? -x : x;
  return x == 0 || (magnitude >= 0x1p-120 && magnitude <= 0x1p120);
}

using Expansion3 = std::array<FloatExpansion, 3>;

inline Expansion3 exact_difference(const Vec3d& a, const Vec3d& b) {
  return {FloatExpansion::difference(a[0], b[0]), FloatExpansion::difference(a[1], b[1]),
          FloatExpansion::difference(a[2], b[2])};
}
inline Expansion3 exact_vector(const Vec3d& a) {
  return {FloatExpansion(a[0]), FloatExpansion(a[1]), FloatExpansion(a[2])};
}
inline FloatExpansion dot(const Expansion3& a, const Expansion3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Expansion3 cross(const Expansion3& a, const Expansion3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace touchstone
