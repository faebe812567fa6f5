// Places a pair on a common grid and scales lengths of that grid.
#include "algorithms/oracle/grid_pair.h"

#include <algorithm>
#include <cmath>

#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle {
namespace {

constexpr int none = -100000;  // the exponent of zero

int exponent_of(double magnitude) {
  if (magnitude == 0) return none;
  int exponent = 0;
  std::frexp(magnitude, &exponent);
  return exponent;
}

// Returns 2^exponent, clamped to the range of double. The part that is cut off is far below the
// filters' bounds.
double power(int exponent) { return std::ldexp(1.0, std::clamp(exponent, -1022, 1000)); }

// Returns x * 2^exponent in two steps, since one power of two may be out of range.
template <class Value>
Value scaled_by(const Value& x, int exponent) {
  const int half = exponent / 2;
  return x * power(half) * power(exponent - half);
}

// The matrix divided by a power of two, so that no entry is beyond 1.
struct ScaledMatrix {
  Mat3d matrix;
  int exponent;
};
ScaledMatrix scaled_matrix(const Body& body) {
  if (body.quaternion) {
    const auto& q = *body.quaternion;
    const double greatest =
        std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
    const double inverse = power(-exponent_of(greatest));
    const double w = q[0] * inverse, x = q[1] * inverse, y = q[2] * inverse, z = q[3] * inverse;
    const double square = w * w + x * x + y * y + z * z;
    Mat3d m;
    m << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),
        2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
        2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
    return {m / square, 0};
  }
  const int exponent = exponent_of(body.matrix.cwiseAbs().maxCoeff());
  if (exponent == none) return {body.matrix, 0};
  return {scaled_by(body.matrix, -exponent), exponent};
}

// to - from, rounded once, is `vector` times 2^exponent.
struct ScaledDifference {
  ScaledDifference() = default;
  ScaledDifference(const Vec3d& from, const Vec3d& to) {
    const double furthest = std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
    if (furthest > 0) exponent = exponent_of(furthest);
    vector = scaled_by(to, -exponent) - scaled_by(from, -exponent);
  }
  // No coordinate is greater than 2^reach().
  int reach() const {
    const int own = exponent_of(vector.cwiseAbs().maxCoeff());
    return own == none ? none : own + exponent;
  }
  Vec3d over_power(int power) const { return scaled_by(vector, exponent - power); }

  Vec3d vector = Vec3d::Zero();
  int exponent = 0;
};

ScaledDifference sweep_of(const Body& body) {
  return body.sweep ? ScaledDifference((*body.sweep)[1], (*body.sweep)[0]) : ScaledDifference();
}

// A number for each axis, times 2^-exponent.
IntegerVector over_power(const Vec3d& v, long exponent) {
  IntegerVector scaled;
  for (int k = 0; k < 3; ++k) scaled[k] = dyadic(v[k]).over_power(static_cast<int>(exponent));
  return scaled;
}

}  // namespace

void GridPair::place(const Body& body_a, const Body& body_b) {
  body_a_ = &body_a;
  body_b_ = &body_b;
  exactly_ = false;
  const ScaledMatrix matrix_a = scaled_matrix(body_a), matrix_b = scaled_matrix(body_b);
  const int reach_a = body_a.solid->exponent + matrix_a.exponent;
  const int reach_b = body_b.solid->exponent + matrix_b.exponent;
  const ScaledDifference offset(body_a.translation, body_b.translation);
  const ScaledDifference sweep_a = sweep_of(body_a), sweep_b = sweep_of(body_b);
  const double radii = body_a.solid->radius / 2 + body_b.solid->radius / 2;
  int unit = std::max({reach_a, reach_b, offset.reach(), sweep_a.reach(), sweep_b.reach(),
                       radii > 0 ? exponent_of(radii) + 1 : none});
  if (unit == none) unit = 0;
  unit_ = unit;
  radius = 2 * scaled_by(radii, -unit);
  a.place(body_a, matrix_a.matrix, power(reach_a - unit), Vec3d::Zero(), sweep_a.over_power(unit));
  b.place(body_b, matrix_b.matrix, power(reach_b - unit), offset.over_power(unit),
          sweep_b.over_power(unit));
}

void GridPair::place_exactly() {
  if (exactly_) return;
  exactly_ = true;
  const ExactMatrix matrix_a = exact_matrix(*body_a_), matrix_b = exact_matrix(*body_b_);
  exponent_ = Dyadic::of_zero;
  const auto cover = [&](const Body& body, const ExactMatrix& matrix) {
    for (int k = 0; k < 3; ++k) {
      exponent_ = std::min<long>(exponent_, matrix.exponent + body.solid->grid[k]);
      exponent_ = std::min<long>(exponent_, dyadic(body.translation[k]).exponent);
      if (!body.sweep) continue;
      for (const Vec3d& end : *body.sweep)
        exponent_ = std::min<long>(exponent_, dyadic(end[k]).exponent);
    }
  };
  cover(*body_a_, matrix_a);
  cover(*body_b_, matrix_b);
  denominator_ = matrix_a.denominator * matrix_b.denominator;
  const auto between = [&](const Vec3d& from, const Vec3d& to) {
    return denominator_ * (over_power(to, exponent_) - over_power(from, exponent_));
  };
  const auto exact_sweep_of = [&](const Body& body) {
    return body.sweep ? between((*body.sweep)[1], (*body.sweep)[0]) : IntegerVector{};
  };
  a.place_exactly(matrix_a, exponent_, matrix_b.denominator, {0, 0, 0}, exact_sweep_of(*body_a_));
  b.place_exactly(matrix_b, exponent_, matrix_a.denominator,
                  between(body_a_->translation, body_b_->translation), exact_sweep_of(*body_b_));
}

DifferencePoint GridPair::exact_support(const Direction& direction, double filter_scale) {
  const std::uint32_t of_a = a.exact_support(direction, filter_scale);
  const Direction reverse{-direction.exact, -direction.rounded};
  return {of_a, b.exact_support(reverse, filter_scale)};
}

SupportBounds GridPair::support_bounds(const Direction& direction, int shift, double filter_scale) {
  const Direction reverse{-direction.exact, -direction.rounded};
  SupportBounds sum{0, 0};
  const auto add = [&](GridCore& core, const Direction& d) {
    if (core.solid().is_curved()) {
      const SupportBounds bounds = core.support_bounds(d.exact, shift);
      sum.low += bounds.low;
      sum.high += bounds.high;
    } else {
      const Integer value = dot(d.exact, core.exact(core.exact_support(d, filter_scale))) << shift;
      sum.low += value;
      sum.high += value;
    }
  };
  add(a, direction);
  add(b, reverse);
  return sum;
}

Integer GridPair::support_above(const Direction& direction, int shift, double filter_scale) {
  return support_bounds(direction, shift, filter_scale).high;
}

Integer GridPair::support_below(const Direction& direction, int shift, double filter_scale) {
  return support_bounds(direction, shift, filter_scale).low;
}

double GridPair::rounded_length(const Integer& length, const IntegerVector& normal) const {
  const Scaled part = scaled(length), whole = scaled(denominator_);
  Direction direction = make_direction(normal);
  const int axis = [&] {
    int greatest = 0;
    direction.rounded.cwiseAbs().maxCoeff(&greatest);
    return greatest;
  }();
  const Scaled along = scaled(normal[axis]);
  // |normal| follows from its greatest component and the rounded direction.
  const double norm = direction.rounded.norm() / std::abs(direction.rounded[axis]);
  const double value = part.mantissa / (whole.mantissa * std::abs(along.mantissa) * norm);
  const long exponent = part.exponent - whole.exponent - along.exponent + exponent_ - unit_;
  return std::ldexp(value, static_cast<int>(std::clamp(exponent, -3000L, 3000L)));
}

SignedRoot GridPair::in_metres(int sign, const Integer& numerator,
                               const Integer& denominator) const {
  if (sign == 0 || numerator.is_zero()) return {};
  SignedRoot root{sign, numerator, denominator * denominator_ * denominator_};
  if (exponent_ >= 0) {
    root.numerator <<= 2 * exponent_;
  } else {
    root.denominator <<= -2 * exponent_;
  }
  return root;
}

}  // namespace touchstone::oracle
