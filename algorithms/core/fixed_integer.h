// Signed integers of a fixed number of 64-bit limbs, for exact determinants of points on a grid.
// Nothing is allocated and every loop has a constant length. Everything may include this.
//
// The oracle's integers (oracle/numbers/integer.h) have any length and are several times slower.
// The caller makes sure that nothing overflows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace touchstone {

template <std::size_t size>
struct FixedInteger {
  std::array<std::uint64_t, size> limbs{};  // two's complement, the least significant first

  bool is_zero() const {
    std::uint64_t any = 0;
    for (const std::uint64_t limb : limbs) any |= limb;
    return any == 0;
  }
  bool is_negative() const { return limbs[size - 1] >> 63 != 0; }
  int sign() const {
    if (is_negative()) return -1;
    return is_zero() ? 0 : 1;
  }
};

namespace fixed_integer_detail {

// These without the warning that they are not part of the language's standard.
__extension__ using Twice = unsigned __int128;
__extension__ using Signed = __int128;

}  // namespace fixed_integer_detail

template <std::size_t size>
FixedInteger<size> operator+(const FixedInteger<size>& x, const FixedInteger<size>& y) {
  FixedInteger<size> sum;
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const auto part = fixed_integer_detail::Twice{x.limbs[i]} + y.limbs[i] + carry;
    sum.limbs[i] = static_cast<std::uint64_t>(part);
    carry = static_cast<std::uint64_t>(part >> 64);
  }
  return sum;
}

template <std::size_t size>
FixedInteger<size> operator-(const FixedInteger<size>& x, const FixedInteger<size>& y) {
  FixedInteger<size> difference;
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const auto part = fixed_integer_detail::Twice{x.limbs[i]} - y.limbs[i] - borrow;
    difference.limbs[i] = static_cast<std::uint64_t>(part);
    borrow = static_cast<std::uint64_t>(part >> 64) & 1;
  }
  return difference;
}

template <std::size_t size_x, std::size_t size_y>
FixedInteger<size_x + size_y> operator*(const FixedInteger<size_x>& x,
                                        const FixedInteger<size_y>& y) {
  FixedInteger<size_x + size_y> product;
  for (std::size_t i = 0; i < size_x; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < size_y; ++j) {
      const auto part =
          fixed_integer_detail::Twice{x.limbs[i]} * y.limbs[j] + product.limbs[i + j] + carry;
      product.limbs[i + j] = static_cast<std::uint64_t>(part);
      carry = static_cast<std::uint64_t>(part >> 64);
    }
    product.limbs[i + size_y] = carry;
  }
  // Two's complement adds 2^(64 size) to a negative factor; what that added is taken away. Signs are
  // random, so a mask is quicker than a branch.
  const auto take_away = [&](const auto& other, std::size_t from, std::uint64_t mask) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < other.limbs.size(); ++i) {
      const auto part =
          fixed_integer_detail::Twice{product.limbs[from + i]} - (other.limbs[i] & mask) - borrow;
      product.limbs[from + i] = static_cast<std::uint64_t>(part);
      borrow = static_cast<std::uint64_t>(part >> 64) & 1;
    }
  };
  take_away(y, size_x, 0 - (x.limbs[size_x - 1] >> 63));
  take_away(x, size_y, 0 - (y.limbs[size_y - 1] >> 63));
  return product;
}

// The same number with one limb more.
template <std::size_t size>
FixedInteger<size + 1> extended(const FixedInteger<size>& x) {
  FixedInteger<size + 1> wide;
  for (std::size_t i = 0; i < size; ++i) wide.limbs[i] = x.limbs[i];
  wide.limbs[size] = x.is_negative() ? ~std::uint64_t{0} : 0;
  return wide;
}

// The number times a small factor.
template <std::size_t size>
FixedInteger<size> times(const FixedInteger<size>& x, std::uint32_t factor) {
  FixedInteger<size> product;
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const auto part = fixed_integer_detail::Twice{x.limbs[i]} * factor + carry;
    product.limbs[i] = static_cast<std::uint64_t>(part);
    carry = static_cast<std::uint64_t>(part >> 64);
  }
  return product;
}

// Adds a * b * 2^shift.
template <std::size_t size>
void add_product(FixedInteger<size>& sum, std::int64_t a, std::int64_t b, unsigned shift) {
  using fixed_integer_detail::Signed;
  using fixed_integer_detail::Twice;
  const Signed product = Signed{a} * b;
  if constexpr (size <= 2) {
    // What is above the limbs is lost, as in every sum.
    const Twice part = static_cast<Twice>(product) << shift;
    if constexpr (size == 1) {
      sum.limbs[0] += static_cast<std::uint64_t>(part);
    } else {
      const Twice whole = (Twice{sum.limbs[1]} << 64 | sum.limbs[0]) + part;
      sum.limbs = {static_cast<std::uint64_t>(whole), static_cast<std::uint64_t>(whole >> 64)};
    }
  } else {
    const std::size_t from = shift / 64;
    const unsigned bits = shift % 64;
    const auto low = static_cast<Twice>(product) << bits;
    const auto high =
        static_cast<std::uint64_t>(bits == 0 ? product >> 127 >> 1 : product >> (128 - bits));
    const std::uint64_t above = product < 0 ? ~std::uint64_t{0} : 0;
    std::uint64_t carry = 0;
    for (std::size_t i = from; i < size; ++i) {
      const std::uint64_t limb = i == from       ? static_cast<std::uint64_t>(low)
                                 : i == from + 1 ? static_cast<std::uint64_t>(low >> 64)
                                 : i == from + 2 ? high
                                                 : above;
      const auto part = Twice{sum.limbs[i]} + limb + carry;
      sum.limbs[i] = static_cast<std::uint64_t>(part);
      carry = static_cast<std::uint64_t>(part >> 64);
    }
  }
}

// The nearest double up to a few units in its last place; `size` is at most 15.
template <std::size_t size>
double to_double(const FixedInteger<size>& x) {
  static_assert(size <= 15);
  const FixedInteger<size> magnitude = x.is_negative() ? FixedInteger<size>{} - x : x;
  double value = 0;
  for (std::size_t i = size; i-- > 0;) {
    value = value * 0x1p64 + static_cast<double>(magnitude.limbs[i]);
  }
  return x.is_negative() ? -value : value;
}

template <std::size_t size>
using FixedVector = std::array<FixedInteger<size>, 3>;

template <std::size_t size>
FixedVector<size> operator-(const FixedVector<size>& u, const FixedVector<size>& v) {
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}

template <std::size_t size>
FixedVector<2 * size> cross(const FixedVector<size>& u, const FixedVector<size>& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

template <std::size_t size_u, std::size_t size_v>
FixedInteger<size_u + size_v> dot(const FixedVector<size_u>& u, const FixedVector<size_v>& v) {
  FixedInteger<size_u + size_v> sum;
  for (std::size_t i = 0; i < 3; ++i) {
    // Bodies stand along the axes so often that the test pays.
    if (u[i].is_zero() || v[i].is_zero()) continue;
    sum = sum + u[i] * v[i];
  }
  return sum;
}

}  // namespace touchstone
