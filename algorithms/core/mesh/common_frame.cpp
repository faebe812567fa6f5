// The common frame of two bodies, and poses one after the other, each with a bound on its rounding.
//
// u is half an epsilon; norms are those of the greatest sum of a row's magnitudes.
//
// In the frame of a, let A' be about the inverse of a's rotation A: its transpose T; if that is off, as where
// rotations were rounded to floats, T - F T with F = T A - I, which leaves F F; or else the inverse in doubles.
// With E = I - A'A the exact place of b's point y is (I - E)^-1 A' (B y + t), t = t_b - t_a. It is off from A'
// (B y + t) by at most |E| / (1 - |E|) times that, and A' (B y + t) is at most m = |A'| (|B| |y| + |t|).
// Rounding adds u |t| for the difference, 3 u for each product of three terms, and 4 u for the map of a point:
// together less than 12 u m. E is computed to 4 u |A'| |A|.
//
// In the moved world a map of three products and two sums is off by at most 4 u times the sum of
// its magnitudes, and the difference of translations by u more.
#include "algorithms/core/mesh/common_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/core/mesh/skew.h"

namespace touchstone {
namespace {

constexpr double u = std::numeric_limits<double>::epsilon() / 2;
constexpr double tiny = std::numeric_limits<double>::min();
constexpr double least_skew = 64 * u;  // of the transpose of what is a rotation in doubles
constexpr double greatest_step = 1e-6;
constexpr double greatest_skew = 1e-10;

double norm(const Mat3d& m) { return m.cwiseAbs().rowwise().sum().maxCoeff(); }

// About the inverse of a matrix, and what its product with the matrix is off from one, at most.
struct AboutInverse {
  Mat3d matrix;
  double skew;
};

AboutInverse about_inverse(const Mat3d& m) {
  AboutInverse found = {m.transpose(), 0};
  const double length = skew_of(m), cut_off = greatest_row_of_turn * greatest_row_of_turn * u;
  found.skew = length + 8 * cut_off;
  if (found.skew <= least_skew) return found;
  if (length <= greatest_step) {
    found.matrix -= (found.matrix * m - Mat3d::Identity()) * found.matrix;
    // Rounded are `off`, its product with the transpose, and the difference.
    found.skew = 1.1 * length * length + 16 * cut_off;
    return found;
  }
  found.matrix = m.inverse();
  found.skew = norm(found.matrix * m - Mat3d::Identity()) + 8 * u * norm(found.matrix) * norm(m);
  return found;
}

// Returns true if x y is the same in doubles and exactly. What rounding cuts off a product is at least 2^-106
// of it, so that it is a double too unless the product is near the least of them.
bool is_exact_product(double x, double y, double product) {
  if (x == 0 || y == 0 || std::abs(x) == 1 || std::abs(y) == 1) return true;
  return std::abs(product) >= tiny * 0x1p106 && std::fma(x, y, -product) == 0;
}

// Returns true if x y + z is the same in doubles and exactly. Says false for some that are, near the least doubles.
bool is_exact(double x, double y, double z) {
  const double product = x * y;
  if (!is_exact_product(x, y, product)) return false;
  const double sum = product + z, back = sum - product;
  return (product - (sum - back)) + (z - back) == 0;
}

// row . v + start, with `exact` cleared if anything is rounded.
double dot(const Mat3d& m, int row, const Vec3d& v, double start, bool& exact) {
  double sum = start;
  for (int k = 0; k < 3; ++k) {
    if (!is_exact(m(row, k), v[k], sum)) exact = false;
    sum += m(row, k) * v[k];
  }
  return sum;
}

}  // namespace

CommonFrame common_frame(const Pose& a, double reach_a, const Pose& b, double reach_b) {
  CommonFrame frame;
  const auto [turned, skew] = about_inverse(a.rotation);
  const Vec3d offset = b.translation - a.translation;
  const double far = norm(b.rotation) * reach_b + offset.cwiseAbs().maxCoeff();
  if (skew <= greatest_skew) {
    frame.b.rotation = turned * b.rotation;
    frame.b.translation = turned * offset;
    const double length = skew <= least_skew ? greatest_row_of_turn : norm(turned);
    frame.error = (16 * u + 1.1 * skew) * length * far + tiny;
    if (a.rotation == Mat3d::Identity() && b.rotation == Mat3d::Identity()) {
      frame.error = 8 * u * far + tiny;
    }
    return frame;
  }
  return world_frame(a, reach_a, b, reach_b);
}

CommonFrame world_frame(const Pose& a, double reach_a, const Pose& b, double reach_b) {
  CommonFrame frame;
  frame.is_of_a = false;
  frame.a.rotation = a.rotation;
  frame.b.rotation = b.rotation;
  frame.b.translation = b.translation - a.translation;
  const double far = norm(b.rotation) * reach_b + frame.b.translation.cwiseAbs().maxCoeff();
  frame.error = 8 * u * std::max(norm(a.rotation) * reach_a, far) + tiny;
  return frame;
}

ComposedPose composed(const Pose& outer, const Pose& inner, double reach) {
  if (inner.rotation == Mat3d::Identity() && inner.translation.isZero(0)) return {outer, 0};
  ComposedPose result;
  bool exact = true;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      result.pose.rotation(row, column) =
          dot(outer.rotation, row, inner.rotation.col(column), 0, exact);
    }
    result.pose.translation[row] =
        dot(outer.rotation, row, inner.translation, outer.translation[row], exact);
  }
  const double magnitude = norm(outer.rotation) * (norm(inner.rotation) * reach +
                                                   inner.translation.cwiseAbs().maxCoeff()) +
                           outer.translation.cwiseAbs().maxCoeff();
  // The bound is for each coordinate, and for the distance twice that.
  // Entries that underflow are off by less than `tiny`, times the reach.
  result.error = exact ? 0 : 16 * u * magnitude + tiny * (1 + reach);
  return result;
}

}  // namespace touchstone
