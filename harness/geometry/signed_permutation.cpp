// The signed permutations of determinant 1, their products and names.
#include "harness/geometry/signed_permutation.h"

#include <vector>

namespace touchstone::geometry {

Mat3d SignedPermutation::operator()(const Mat3d& m) const {
  Mat3d result;
  for (int column = 0; column < 3; ++column) result.col(column) = (*this)(Vec3d(m.col(column)));
  return result;
}

SignedPermutation SignedPermutation::inverse() const {
  SignedPermutation result;
  for (int i = 0; i < 3; ++i) {
    result.from[static_cast<std::size_t>(from[i])] = i;
    result.sign[static_cast<std::size_t>(from[i])] = sign[i];
  }
  return result;
}

std::string SignedPermutation::name() const {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    text += sign[i] > 0 ? '+' : '-';
    text += "xyz"[from[i]];
  }
  return text;
}

std::span<const SignedPermutation> signed_permutations() {
  static const std::vector<SignedPermutation> all = [] {
    std::vector<SignedPermutation> list;
    constexpr std::array<std::array<int, 3>, 6> orders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (std::size_t order = 0; order < orders.size(); ++order) {
      for (int signs = 0; signs < 8; ++signs) {
        const int negative = (signs & 1) + (signs >> 1 & 1) + (signs >> 2 & 1);
        const bool odd = order >= 3;
        if ((negative % 2 == 1) != odd) continue;
        const auto sign = [&](int bit) { return signs >> bit & 1 ? -1.0 : 1.0; };
        list.push_back({orders[order], {sign(0), sign(1), sign(2)}});
      }
    }
    return list;
  }();
  return all;
}

}  // namespace touchstone::geometry
