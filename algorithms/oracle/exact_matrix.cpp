// The exact matrix of a body, from its stored matrix or its quaternion.
#include "algorithms/oracle/exact_matrix.h"

#include <algorithm>

#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle {
namespace {

// Returns R(q) and |q|^2 in integers. The components' common power of two cancels.
ExactMatrix of_quaternion(const std::array<double, 4>& quaternion) {
  std::array<Dyadic, 4> parts;
  int exponent = Dyadic::of_zero;
  for (int i = 0; i < 4; ++i) {
    parts[i] = dyadic(quaternion[i]);
    exponent = std::min(exponent, parts[i].exponent);
  }
  const Integer w = parts[0].over_power(exponent), x = parts[1].over_power(exponent),
                y = parts[2].over_power(exponent), z = parts[3].over_power(exponent);
  const Integer ww = w * w, xx = x * x, yy = y * y, zz = z * z;
  const Integer xy = x * y, xz = x * z, yz = y * z, wx = w * x, wy = w * y, wz = w * z;
  ExactMatrix matrix;
  matrix.columns[0] = {ww + xx - yy - zz, 2 * (xy + wz), 2 * (xz - wy)};
  matrix.columns[1] = {2 * (xy - wz), ww - xx + yy - zz, 2 * (yz + wx)};
  matrix.columns[2] = {2 * (xz + wy), 2 * (yz - wx), ww - xx - yy + zz};
  matrix.denominator = ww + xx + yy + zz;
  return matrix;
}

}  // namespace

ExactMatrix exact_matrix(const Body& body) {
  if (body.quaternion) return of_quaternion(*body.quaternion);
  ExactMatrix matrix;
  std::array<std::array<Dyadic, 3>, 3> entries;
  int exponent = Dyadic::of_zero;
  for (int k = 0; k < 3; ++k) {
    for (int row = 0; row < 3; ++row) {
      entries[k][row] = dyadic(body.matrix(row, k));
      exponent = std::min(exponent, entries[k][row].exponent);
    }
  }
  if (exponent == Dyadic::of_zero) return matrix;
  matrix.exponent = exponent;
  for (int k = 0; k < 3; ++k) {
    for (int row = 0; row < 3; ++row) matrix.columns[k][row] = entries[k][row].over_power(exponent);
  }
  return matrix;
}

}  // namespace touchstone::oracle
