// Random numbers that are equal on every platform.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "harness/base/hash.h"
#include "harness/base/reproducible_math.h"

namespace touchstone::base {

// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014)
// with distributions in plain arithmetic, because those of the standard library differ between
// vendors.
class Random {
 public:
  // Streams of one seed are independent.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(mix(seed) ^ mix(mix(stream))) {}

  std::uint64_t next() {
    const std::uint64_t value = mix(state_);
    state_ += 0x9e3779b97f4a7c15;
    return value;
  }
  // A multiple of 2^-53 in [0, 1).
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  // An integer in [0, n), n > 0; all values are equally likely.
  std::uint64_t below(std::uint64_t n) {
    const std::uint64_t limit = ~std::uint64_t{0} - ~std::uint64_t{0} % n;
    for (;;) {
      const std::uint64_t value = next();
      if (value < limit) return value % n;
    }
  }
  // A number in [low, high], 0 < low <= high, even over magnitudes: an octave, then a place in it.
  double magnitude(double low, double high) {
    int first = 0, last = 0;
    std::frexp(low, &first);
    std::frexp(high, &last);
    for (;;) {
      const auto octave = static_cast<int>(below(static_cast<std::uint64_t>(last - first) + 1));
      const double value = std::ldexp(1 + unit(), first + octave - 1);
      if (value >= low && value <= high) return value;
      if (low == high) return low;
    }
  }
  // A number from the normal distribution of mean 0 and deviation 1, exactly, by comparison of
  // uniform numbers (Karney, "Sampling exactly from the normal distribution", ACM TOMS 42(1), 2016,
  // algorithm N). Logarithms differ between platforms.
  double normal() {
    for (;;) {
      int k = 0;
      while (exponential_coin(0.5)) ++k;
      bool kept = true;  // with probability exp(-k (k - 1) / 2)
      for (int i = 0; kept && i < k * (k - 1); ++i) kept = exponential_coin(0.5);
      const double x = unit();
      // The exponential exp(-x (2 k + x) / 2), in k + 1 factors whose exponents are at most 1.
      for (int i = 0; kept && i <= k; ++i) kept = exponential_coin(x * (2 * k + x) / (2 * k + 2));
      if (kept) return below(2) == 0 ? k + x : -(k + x);
    }
  }
  // A point in the unit ball, evenly distributed.
  Vec3d in_ball() {
    for (;;) {
      const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
      if (x * x + y * y + z * z <= 1) return {x, y, z};
    }
  }
  // A point on the unit sphere, evenly distributed up to rounding.
  Vec3d on_sphere() {
    for (;;) {
      const Vec3d v = in_ball();
      const double norm = length(v);
      if (norm > 0.01) return {v.x() / norm, v.y() / norm, v.z() / norm};
    }
  }
  // A rotation, evenly distributed over all rotations.
  Mat3d rotation() {
    for (;;) {
      const double w = uniform(-1, 1), x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
      const double norm = w * w + x * x + y * y + z * z;
      if (norm <= 1 && norm > 0.01) return rotation_of({w, x, y, z});
    }
  }

 private:
  // Returns true with probability exp(-t), 0 <= t <= 1 (von Neumann 1951), by the length of a
  // falling run.
  bool exponential_coin(double t) {
    bool even = true;
    for (double last = t;; even = !even) {
      const double next = unit();
      if (!(next < last)) return even;
      last = next;
    }
  }

  std::uint64_t state_;
};

}  // namespace touchstone::base
