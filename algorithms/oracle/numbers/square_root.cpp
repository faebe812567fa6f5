// Newton's method on twice as many bits in each step.
//
// Steps: 1. The root of up to 62 bits is that of a double, corrected.
//        2. Of more, the root of the upper half of the bits, plus one, is an estimate a that is not too
//           small. (a + square / a) / 2 is not either, and too great by less than one before it is
//           rounded, since a was off by less than a quarter of its bits.
#include "algorithms/oracle/numbers/square_root.h"

#include <cmath>

namespace touchstone::oracle {

Integer root_below(const Integer& square) {
  if (square.is_zero()) return 0;
  const unsigned bits = static_cast<unsigned>(msb(square)) + 1;
  if (bits <= 62) {
    const auto whole = square.convert_to<std::uint64_t>();
    auto root = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(whole)));
    while (root * root > whole) --root;
    while ((root + 1) * (root + 1) <= whole) ++root;
    return root;
  }
  const unsigned half = (bits / 2 - 2) / 2;
  const Integer estimate = Integer(root_below(square >> (2 * half)) + 1) << half;
  Integer root = (estimate + square / estimate) >> 1;
  while (root * root > square) --root;
  return root;
}

}  // namespace touchstone::oracle
