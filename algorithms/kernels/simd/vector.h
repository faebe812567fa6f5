// Vectors of floats or doubles at each level of vector instructions. A file compiles its loops once
// for each level by foreach_target.inl; `Simd<Scalar>` is then that level's vocabulary. Each
// operation is the scalar's own, correctly rounded, so a lane has the same bits at every level.
//
// Simd<Scalar> has `width` lanes, the type Vector (with the operators of the language), the type
// Mask of comparisons, and:
//   load, store, broadcast, abs, min, max, sqrt
//   max_abs             the greater of two absolute values
//   less, less_equal    the mask of the lanes where it holds, and where `within` holds
//   select(mask, a, b)  a in the mask's lanes, b in the others
//   to_bits, from_bits  a mask as an integer, with lane 0 in bit 0
//   reduce_max          the greatest lane
//   concat, concat_at   a vector of the quads (four scalars each) 0, 4, 8..., or of those at the
//                       addresses 0, 4, 8...
//   transpose           turns four such vectors, of the quads of all lanes, into a vector of their
//                       first numbers, one of their second numbers and so on
// Simd<float> also handles values in memory, sixteen at a time at every level:
//   reduce_min16, reduce_max16
//   meet(a, b, c, d)                   the mask of the lanes in which the intervals [a, b] and
//                                      [c, d] share a number, and where `within` holds; an interval
//                                      is a <= b, or empty as [inf, -inf]. Masks in registers of
//                                      their own are slow to compute, so that level compares once
//   compress(bits, from, to)           copies the values from[0..15] whose bits are set to the
//                                      front of `to`, which has room for 16; returns their number
//   compress_indices(bits, first, to)  does so with the numbers first, first + 1...
//   fill(x, to)                        writes x to to[0..15]
//   test(marks, want)                  the bits of those of `width` integers that have all bits of
//                                      `want`
// Used by every kernel and algorithm with vector loops. It includes core only.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/simd/target_attributes.h"

#define TOUCHSTONE_INLINE inline __attribute__((always_inline))

namespace touchstone::simd {

template <class Scalar>
using Quad =
    std::conditional_t<std::is_same_v<Scalar, float>, float __attribute__((vector_size(16))),
                       double __attribute__((vector_size(32)))>;

// Elements are accessed one by one, which compiles to the same code on any machine.
template <class Floats4>
inline float reduce_min4(Floats4 x) {
  return std::min(std::min(x[0], x[1]), std::min(x[2], x[3]));
}
template <class Floats4>
inline float reduce_max4(Floats4 x) {
  return std::max(std::max(x[0], x[1]), std::max(x[2], x[3]));
}

namespace baseline {
#define TOUCHSTONE_TARGET
#include "algorithms/kernels/simd/quad_lanes.inl"

// SSE2 on x86-64, elsewhere what the machine has.
template <class Scalar>
struct Simd : QuadLanes<Scalar> {};

// Four doubles as two vectors of two, which is what SSE2 has: the compiler takes wider ones apart
// into scalars wherever they are compared.
template <class Half>
struct Halves {
  Half low, high;

  TOUCHSTONE_INLINE auto operator[](std::size_t lane) const {
    return lane < 2 ? low[lane] : high[lane - 2];
  }
  friend TOUCHSTONE_INLINE Halves operator-(Halves x) { return {-x.low, -x.high}; }
  friend TOUCHSTONE_INLINE Halves operator~(Halves x) { return {~x.low, ~x.high}; }
#define TOUCHSTONE_OPERATOR(op)                                     \
  friend TOUCHSTONE_INLINE Halves operator op(Halves a, Halves b) { \
    return {a.low op b.low, a.high op b.high};                      \
  }                                                                 \
  friend TOUCHSTONE_INLINE Halves operator op(double a, Halves b) { \
    return {a op b.low, a op b.high};                               \
  }                                                                 \
  friend TOUCHSTONE_INLINE Halves operator op(Halves a, double b) { \
    return {a.low op b, a.high op b};                               \
  }                                                                 \
  TOUCHSTONE_INLINE Halves& operator op##=(Halves b) { return *this = *this op b; }
  TOUCHSTONE_OPERATOR(+)
  TOUCHSTONE_OPERATOR(-)
  TOUCHSTONE_OPERATOR(*)
  TOUCHSTONE_OPERATOR(/)
  TOUCHSTONE_OPERATOR(&)
  TOUCHSTONE_OPERATOR(|)
  TOUCHSTONE_OPERATOR(^)
#undef TOUCHSTONE_OPERATOR
};

template <>
struct Simd<double> {
  using Half = double __attribute__((vector_size(16)));
  using HalfMask = std::int64_t __attribute__((vector_size(16)));
  static constexpr std::size_t width = 4;
  using Vector = Halves<Half>;
  using Mask = Halves<HalfMask>;

  static TOUCHSTONE_INLINE Vector load(const double* from) {
    Vector x;
    std::memcpy(&x, from, sizeof x);
    return x;
  }
  static TOUCHSTONE_INLINE void store(double* to, Vector x) { std::memcpy(to, &x, sizeof x); }
  static TOUCHSTONE_INLINE Vector broadcast(double x) { return {Half{x, x}, Half{x, x}}; }
  static TOUCHSTONE_INLINE Mask less(Vector a, Vector b) {
    return {a.low < b.low, a.high < b.high};
  }
  static TOUCHSTONE_INLINE Mask less_equal(Vector a, Vector b) {
    return {a.low <= b.low, a.high <= b.high};
  }
  static TOUCHSTONE_INLINE Mask less_equal(Mask within, Vector a, Vector b) {
    return within & less_equal(a, b);
  }
  static TOUCHSTONE_INLINE Vector select(Mask mask, Vector a, Vector b) {
    return {mask.low ? a.low : b.low, mask.high ? a.high : b.high};
  }
  static TOUCHSTONE_INLINE Vector abs(Vector x) {
    const HalfMask bits = ~(HalfMask{} + std::numeric_limits<std::int64_t>::min());
    return {std::bit_cast<Half>(std::bit_cast<HalfMask>(x.low) & bits),
            std::bit_cast<Half>(std::bit_cast<HalfMask>(x.high) & bits)};
  }
  static TOUCHSTONE_INLINE Vector max(Vector a, Vector b) { return select(less(b, a), a, b); }
  static TOUCHSTONE_INLINE Vector min(Vector a, Vector b) { return select(less(a, b), a, b); }
  static TOUCHSTONE_INLINE Vector max_abs(Vector a, Vector b) { return max(abs(a), abs(b)); }
  static TOUCHSTONE_INLINE double reduce_max(Vector x) {
    const double even = x[0] > x[2] ? x[0] : x[2], odd = x[1] > x[3] ? x[1] : x[3];
    return even > odd ? even : odd;
  }
  static TOUCHSTONE_INLINE Vector sqrt(Vector x) {
    return {Half{std::sqrt(x[0]), std::sqrt(x[1])}, Half{std::sqrt(x[2]), std::sqrt(x[3])}};
  }
  static TOUCHSTONE_INLINE unsigned to_bits(Mask m) {
    return static_cast<unsigned>((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
  }
  static TOUCHSTONE_INLINE Mask from_bits(unsigned bits) {
    const auto set = [bits](unsigned lane) { return -static_cast<std::int64_t>(bits >> lane & 1); };
    return {HalfMask{set(0), set(1)}, HalfMask{set(2), set(3)}};
  }
  static TOUCHSTONE_INLINE Vector concat(const Quad<double>* quads) {
    return std::bit_cast<Vector>(quads[0]);
  }
  static TOUCHSTONE_INLINE Vector concat_at(const double* const* at) { return load(at[0]); }
  static TOUCHSTONE_INLINE void transpose(Vector r[4]) {
    const Vector a = r[0], b = r[1], c = r[2], d = r[3];
    for (int k = 0; k < 4; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      r[k] = {Half{a[lane], b[lane]}, Half{c[lane], d[lane]}};
    }
  }
  static TOUCHSTONE_INLINE Mask meet(Vector a, Vector b, Vector c, Vector d) {
    return less_equal(c, b) & less_equal(a, d);
  }
  static TOUCHSTONE_INLINE Mask meet(Mask within, Vector a, Vector b, Vector c, Vector d) {
    return within & meet(a, b, c, d);
  }
};
#include "algorithms/kernels/simd/quads.inl"
#undef TOUCHSTONE_TARGET
}  // namespace baseline

#if defined(__x86_64__)
#include "algorithms/kernels/simd/vector_avx2.inl"
#include "algorithms/kernels/simd/vector_avx512.inl"
#endif

}  // namespace touchstone::simd
