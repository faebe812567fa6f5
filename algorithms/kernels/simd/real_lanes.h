// Vectors of real numbers, float or double, at each level of vector instructions, for loops that
// treat one pair of bodies a lane. Such a file includes its loops once for each level, by
// every_level.inl with TOUCHSTONE_LANES set to real_lanes. Each operation is the scalar's own,
// correctly rounded, so a lane has the same bits at every level.
//
// RealLanes<Scalar> has `width` lanes, its vectors Real (with the operators of the language) and
// Mask, and Quad, four scalars. `greatest` is of all lanes, `max_abs` the greater of two without
// their signs. Of quads 0, 4, 8... `join` makes a vector, `join_at` of those at the addresses 0, 4,
// 8..., and `transpose` turns four such vectors, of the quads of all lanes, into four of their
// first numbers, their second and so on.
#pragma once

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

namespace touchstone::real_lanes {

template <class Scalar>
using Quad =
    std::conditional_t<std::is_same_v<Scalar, float>, float __attribute__((vector_size(16))),
                       double __attribute__((vector_size(32)))>;

namespace baseline {
// Four lanes in the compiler's own vector types.
template <class Scalar>
struct RealLanes {
  static constexpr std::size_t width = 4;
  using Real = Quad<Scalar>;
  using Integer = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;
  using Mask =
      std::conditional_t<sizeof(Scalar) == 4, std::int32_t __attribute__((vector_size(16))),
                         std::int64_t __attribute__((vector_size(32)))>;

  static TOUCHSTONE_INLINE Real broadcast(Scalar x) { return Real{x, x, x, x}; }
  static TOUCHSTONE_INLINE Mask less(Real a, Real b) { return a < b; }
  static TOUCHSTONE_INLINE Real select(Mask mask, Real a, Real b) { return mask ? a : b; }
  static TOUCHSTONE_INLINE Real abs(Real x) {
    const Mask bits = std::bit_cast<Mask>(x) & ~(Mask{} + std::numeric_limits<Integer>::min());
    return std::bit_cast<Real>(bits);
  }
  static TOUCHSTONE_INLINE Real max(Real a, Real b) { return a > b ? a : b; }
  static TOUCHSTONE_INLINE Real min(Real a, Real b) { return a < b ? a : b; }
  static TOUCHSTONE_INLINE Real max_abs(Real a, Real b) { return max(abs(a), abs(b)); }
  static TOUCHSTONE_INLINE Scalar greatest(Real x) {
    const Scalar even = x[0] > x[2] ? x[0] : x[2], odd = x[1] > x[3] ? x[1] : x[3];
    return even > odd ? even : odd;
  }
  static TOUCHSTONE_INLINE Real sqrt(Real x) {
    return Real{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
  }
  static TOUCHSTONE_INLINE unsigned bits(Mask m) {
    return static_cast<unsigned>((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
  }
  static TOUCHSTONE_INLINE Real join(const Quad<Scalar>* quads) { return quads[0]; }
  static TOUCHSTONE_INLINE Real join_at(const Scalar* const* at) {
    Real quad;
    std::memcpy(&quad, at[0], sizeof quad);
    return quad;
  }
  static TOUCHSTONE_INLINE Mask mask(unsigned bits) {
    const auto set = [bits](unsigned lane) { return -static_cast<Integer>(bits >> lane & 1); };
    return Mask{set(0), set(1), set(2), set(3)};
  }
  static TOUCHSTONE_INLINE void transpose(Real r[4]) {
    const Real a = r[0], b = r[1], c = r[2], d = r[3];
    for (int k = 0; k < 4; ++k) r[k] = Real{a[k], b[k], c[k], d[k]};
  }
};
#define TOUCHSTONE_TARGET
#include "algorithms/kernels/simd/real_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace baseline

#if defined(__x86_64__)
#include "algorithms/kernels/simd/real_lanes_avx2.inl"
#include "algorithms/kernels/simd/real_lanes_avx512.inl"
#endif

}  // namespace touchstone::real_lanes
