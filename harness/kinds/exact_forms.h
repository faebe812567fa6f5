// Changes of numbers that round nothing, for cases in other forms.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "harness/base/random.h"
#include "harness/geometry/signed_permutation.h"

namespace touchstone::kinds {

// Returns the sum if no coordinate of it is rounded.
inline std::optional<Vec3d> exact_sum(const Vec3d& a, const Vec3d& b) {
  Vec3d sum;
  for (int i = 0; i < 3; ++i) {
    // The error of a sum, after Knuth, "The art of computer programming", volume 2, 4.2.2.
    sum[i] = a[i] + b[i];
    const double part = sum[i] - a[i];
    if ((a[i] - (sum[i] - part)) + (b[i] - part) != 0) return std::nullopt;
  }
  return sum;
}

// The numbers of a form, the same for the case whenever it is asked.
struct FormNumbers {
  double scale;  // a power of two
  geometry::SignedPermutation turn;
  Vec3d shift;  // metres, a multiple of 2^-10 in each coordinate

  FormNumbers(std::uint64_t seed, std::uint64_t index) {
    base::Random random(seed, ~index);
    scale = std::ldexp(1, static_cast<int>(random.below(41)) - 20);
    turn = geometry::signed_permutations()[1 + random.below(23)];
    const auto coordinate = [&] { return static_cast<double>(random.below(8192)) / 1024 - 4; };
    const double x = coordinate(), y = coordinate();
    shift = {x, y, coordinate()};
  }
};

}  // namespace touchstone::kinds
