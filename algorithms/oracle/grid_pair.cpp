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

}  // namespace

void GridPair::place(const Body& body_a, const Body& body_b) {
  body_a_ = &body_a;
  body_b_ = &body_b;
  exactly_ = false;
  const ScaledMatrix matrix_a = scaled_matrix(body_a), matrix_b = scaled_matrix(body_b);
  const int reach_a = body_a.solid->exponent + matrix_a.exponent;
  const int reach_b = body_b.solid->exponent + matrix_b.exponent;
  // The offset is divided by a power of two that bounds both origins.
  const double furthest =
      std::max(body_a.translation.cwiseAbs().maxCoeff(), body_b.translation.cwiseAbs().maxCoeff());
  const int far = furthest == 0 ? 0 : exponent_of(furthest);
  const Vec3d offset = scaled_by(body_b.translation, -far) - scaled_by(body_a.translation, -far);
  const int apart = exponent_of(offset.cwiseAbs().maxCoeff());
  const double radii = body_a.solid->radius / 2 + body_b.solid->radius / 2;
  int unit = std::max({reach_a, reach_b, apart == none ? none : apart + far,
                       radii > 0 ? exponent_of(radii) + 1 : none});
  if (unit == none) unit = 0;
  unit_ = unit;
  radius = 2 * scaled_by(radii, -unit);
  a.place(body_a, matrix_a.matrix, power(reach_a - unit), Vec3d::Zero());
  b.place(body_b, matrix_b.matrix, power(reach_b - unit), scaled_by(offset, far - unit));
}

void GridPair::place_exactly() {
  if (exactly_) return;
  exactly_ = true;
  const ExactMatrix matrix_a = exact_matrix(*body_a_), matrix_b = exact_matrix(*body_b_);
  std::array<Dyadic, 3> origin_a, origin_b;
  exponent_ = Dyadic::of_zero;
  const auto cover = [&](const Body& body, const ExactMatrix& matrix,
                         std::array<Dyadic, 3>& origin) {
    for (int k = 0; k < 3; ++k) {
      exponent_ = std::min<long>(exponent_, matrix.exponent + body.solid->grid[k]);
      origin[k] = dyadic(body.translation[k]);
      exponent_ = std::min<long>(exponent_, origin[k].exponent);
    }
  };
  cover(*body_a_, matrix_a, origin_a);
  cover(*body_b_, matrix_b, origin_b);
  denominator_ = matrix_a.denominator * matrix_b.denominator;
  IntegerVector offset;
  for (int k = 0; k < 3; ++k) {
    const int e = static_cast<int>(exponent_);
    offset[k] = (origin_b[k].over_power(e) - origin_a[k].over_power(e)) * denominator_;
  }
  a.place_exactly(matrix_a, exponent_, matrix_b.denominator, {0, 0, 0});
  b.place_exactly(matrix_b, exponent_, matrix_a.denominator, offset);
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
