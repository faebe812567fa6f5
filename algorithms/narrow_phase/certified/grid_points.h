// Part of certified: vertices of two polytopes as integers on one grid, exactly as their shapes and
// poses state them. Includes core and this folder.
//
// A coordinate M v + t of doubles is an integer times a power of two. The grid's step is the least
// power that a pair needs; the numbers of most pairs then fit into 64 or 128 bits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "algorithms/core/fixed_integer.h"
#include "algorithms/core/pose.h"

namespace touchstone {

// mantissa * 2^exponent with an odd mantissa, or zero.
struct SplitDouble {
  std::int64_t mantissa = 0;
  int exponent = 0;

  explicit SplitDouble(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const int stored = static_cast<int>(bits >> 52 & 0x7ff);
    const std::uint64_t fraction = bits & 0xfffffffffffffu;
    const std::uint64_t magnitude = stored != 0 ? fraction | 0x10000000000000u : fraction;
    if (magnitude == 0) return;
    const int zeros = std::countr_zero(magnitude);
    mantissa = static_cast<std::int64_t>(magnitude >> zeros);
    if (bits >> 63 != 0) mantissa = -mantissa;
    exponent = (stored != 0 ? stored : 1) - 1075 + zeros;
  }
  SplitDouble() = default;

  int bits() const {
    return 64 - std::countl_zero(static_cast<std::uint64_t>(mantissa < 0 ? -mantissa : mantissa));
  }
};

// The least and the greatest power of two of a pair's numbers.
struct GridRange {
  int least = std::numeric_limits<int>::max() / 2;
  int most = std::numeric_limits<int>::min() / 2;
  unsigned terms = 0, most_terms = 1;

  void begin_sum() { terms = 0; }
  // A number times integers that are multiples of 2^from and at most 2^to.
  void add(const SplitDouble& a, int from = 0, int to = 0) {
    if (a.mantissa == 0) return;
    least = std::min(least, a.exponent + from);
    // An odd number is below the next power of two, unless it is one.
    const int bits = a.bits();
    most = std::max(most, a.exponent + (bits == 1 ? 0 : bits) + to);
    most_terms = std::max(most_terms, ++terms);
  }
  // The number of bits, with their sign, of the sums, of the difference of two, and of the
  // difference of two such.
  int bits() const { return most - least + std::bit_width(most_terms - 1) + 3; }
};

// The matrix and the translation of a body, split. The translation may be that of a difference of
// two bodies' places: it is a sum of two numbers.
struct SplitPose {
  std::array<std::array<SplitDouble, 3>, 3> matrix;
  std::array<std::array<SplitDouble, 2>, 3> place;

  // Relative to `origin`.
  SplitPose(const Pose& pose, const Vec3d& origin) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) matrix[i][j] = SplitDouble(pose.rotation(i, j));
      if (pose.translation[i] == origin[i]) continue;
      place[i] = {SplitDouble(pose.translation[i]), SplitDouble(-origin[i])};
    }
  }
};

using SplitPoint = std::array<SplitDouble, 3>;

inline SplitPoint split_point(const Vec3d& v) {
  return {SplitDouble(v.x()), SplitDouble(v.y()), SplitDouble(v.z())};
}

// Each component is off by at most 2^-50 of itself.
template <std::size_t size>
Vec3d rounded(const FixedVector<size>& point) {
  return {to_double(point[0]), to_double(point[1]), to_double(point[2])};
}

// The difference of two vertices on the grid, and rounded to doubles.
template <std::size_t size>
struct GridPoint {
  FixedVector<size> exact;
  Vec3d rounded;

  GridPoint() = default;
  explicit GridPoint(const FixedVector<size>& point)
      : exact(point), rounded(touchstone::rounded(point)) {}
};

// Returns true if the two unit vectors are the same up to 2^-33, so that no vertex that is not near
// the plane along one can be furthest along the other: see the thickness of the slab in
// exact_contact.cpp.
inline bool is_same_direction(const Vec3d& u, const Vec3d& v) {
  return (u - v).cwiseAbs().maxCoeff() <= 0x1p-34;
}

// The point at the pose in steps of 2^step; `step` is at most the range's least power.
template <std::size_t size>
FixedVector<size> on_grid(const SplitPose& pose, const SplitPoint& point, int step) {
  FixedVector<size> result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const SplitDouble &m = pose.matrix[i][j], &v = point[j];
      if (m.mantissa == 0 || v.mantissa == 0) continue;
      add_product(result[i], m.mantissa, v.mantissa,
                  static_cast<unsigned>(m.exponent + v.exponent - step));
    }
    for (const SplitDouble& part : pose.place[i]) {
      if (part.mantissa == 0) continue;
      add_product(result[i], part.mantissa, 1, static_cast<unsigned>(part.exponent - step));
    }
  }
  return result;
}

}  // namespace touchstone
