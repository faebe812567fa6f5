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
#include "algorithms/kernels/vector_targets.h"

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
#include "algorithms/kernels/real_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace baseline

#if defined(__x86_64__)
namespace avx2 {
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX2
template <class Scalar>
struct RealLanes;

template <>
struct RealLanes<float> {
  static constexpr std::size_t width = 8;
  using Real = __m256;
  using Mask = __m256;

  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real broadcast(float x) { return _mm256_set1_ps(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less(Real a, Real b) {
    return _mm256_cmp_ps(a, b, _CMP_LT_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real select(Mask mask, Real a, Real b) {
    return _mm256_blendv_ps(b, a, mask);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real abs(Real x) {
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), x);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real max(Real a, Real b) {
    return _mm256_max_ps(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real min(Real a, Real b) {
    return _mm256_min_ps(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real max_abs(Real a, Real b) {
    return max(abs(a), abs(b));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE float greatest(Real x) {
    const __m128 four = _mm_max_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1));
    const __m128 two = _mm_max_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps(two, two, 1)));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real sqrt(Real x) { return _mm256_sqrt_ps(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE unsigned bits(Mask m) {
    return static_cast<unsigned>(_mm256_movemask_ps(m));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask mask(unsigned bits) {
    const __m256i lanes = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), lanes);
    return _mm256_castsi256_ps(_mm256_cmpeq_epi32(set, lanes));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real join(const Quad<float>* quads) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(quads[0]), quads[4], 1);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void transpose(Real r[4]) {
    const __m256d a = _mm256_castps_pd(_mm256_unpacklo_ps(r[0], r[1]));
    const __m256d b = _mm256_castps_pd(_mm256_unpackhi_ps(r[0], r[1]));
    const __m256d c = _mm256_castps_pd(_mm256_unpacklo_ps(r[2], r[3]));
    const __m256d d = _mm256_castps_pd(_mm256_unpackhi_ps(r[2], r[3]));
    r[0] = _mm256_castpd_ps(_mm256_unpacklo_pd(a, c));
    r[1] = _mm256_castpd_ps(_mm256_unpackhi_pd(a, c));
    r[2] = _mm256_castpd_ps(_mm256_unpacklo_pd(b, d));
    r[3] = _mm256_castpd_ps(_mm256_unpackhi_pd(b, d));
  }
};

template <>
struct RealLanes<double> {
  static constexpr std::size_t width = 4;
  using Real = __m256d;
  using Mask = __m256d;

  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real broadcast(double x) { return _mm256_set1_pd(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less(Real a, Real b) {
    return _mm256_cmp_pd(a, b, _CMP_LT_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real select(Mask mask, Real a, Real b) {
    return _mm256_blendv_pd(b, a, mask);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real abs(Real x) {
    return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real max(Real a, Real b) {
    return _mm256_max_pd(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real min(Real a, Real b) {
    return _mm256_min_pd(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real max_abs(Real a, Real b) {
    return max(abs(a), abs(b));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE double greatest(Real x) {
    const __m128d two = _mm_max_pd(_mm256_castpd256_pd128(x), _mm256_extractf128_pd(x, 1));
    return _mm_cvtsd_f64(_mm_max_sd(two, _mm_unpackhi_pd(two, two)));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real sqrt(Real x) { return _mm256_sqrt_pd(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE unsigned bits(Mask m) {
    return static_cast<unsigned>(_mm256_movemask_pd(m));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask mask(unsigned bits) {
    const __m256i lanes = _mm256_setr_epi64x(1, 2, 4, 8);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi64x(bits), lanes);
    return _mm256_castsi256_pd(_mm256_cmpeq_epi64(set, lanes));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real join(const Quad<double>* quads) {
    return quads[0];
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real join_at(const double* const* at) {
    return _mm256_loadu_pd(at[0]);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void transpose(Real r[4]) {
    const __m256d a = _mm256_unpacklo_pd(r[0], r[1]), b = _mm256_unpackhi_pd(r[0], r[1]);
    const __m256d c = _mm256_unpacklo_pd(r[2], r[3]), d = _mm256_unpackhi_pd(r[2], r[3]);
    r[0] = _mm256_permute2f128_pd(a, c, 0x20);
    r[1] = _mm256_permute2f128_pd(b, d, 0x20);
    r[2] = _mm256_permute2f128_pd(a, c, 0x31);
    r[3] = _mm256_permute2f128_pd(b, d, 0x31);
  }
};
#include "algorithms/kernels/real_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx2

namespace avx512 {
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX512
template <class Scalar>
struct RealLanes;

template <>
struct RealLanes<float> {
  static constexpr std::size_t width = 16;
  using Real = __m512;
  using Mask = __mmask16;

  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real broadcast(float x) { return _mm512_set1_ps(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less(Real a, Real b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real select(Mask mask, Real a, Real b) {
    return _mm512_mask_blend_ps(mask, b, a);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real abs(Real x) { return _mm512_abs_ps(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real max(Real a, Real b) {
    return _mm512_max_ps(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real min(Real a, Real b) {
    return _mm512_min_ps(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real max_abs(Real a, Real b) {
    return _mm512_range_ps(a, b, 0b1011);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE float greatest(Real x) {
    return avx2::RealLanes<float>::greatest(
        _mm256_max_ps(_mm512_castps512_ps256(x), _mm512_extractf32x8_ps(x, 1)));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real sqrt(Real x) { return _mm512_sqrt_ps(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE unsigned bits(Mask m) { return m; }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask mask(unsigned bits) {
    return static_cast<Mask>(bits);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real join(const Quad<float>* quads) {
    const __m256 low = _mm256_insertf128_ps(_mm256_castps128_ps256(quads[0]), quads[4], 1);
    const __m256 high = _mm256_insertf128_ps(_mm256_castps128_ps256(quads[8]), quads[12], 1);
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void transpose(Real r[4]) {
    const __m512d a = _mm512_castps_pd(_mm512_unpacklo_ps(r[0], r[1]));
    const __m512d b = _mm512_castps_pd(_mm512_unpackhi_ps(r[0], r[1]));
    const __m512d c = _mm512_castps_pd(_mm512_unpacklo_ps(r[2], r[3]));
    const __m512d d = _mm512_castps_pd(_mm512_unpackhi_ps(r[2], r[3]));
    r[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(a, c));
    r[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(a, c));
    r[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(b, d));
    r[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(b, d));
  }
};

template <>
struct RealLanes<double> {
  static constexpr std::size_t width = 8;
  using Real = __m512d;
  using Mask = __mmask8;

  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real broadcast(double x) { return _mm512_set1_pd(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less(Real a, Real b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real select(Mask mask, Real a, Real b) {
    return _mm512_mask_blend_pd(mask, b, a);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real abs(Real x) { return _mm512_abs_pd(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real max(Real a, Real b) {
    return _mm512_max_pd(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real min(Real a, Real b) {
    return _mm512_min_pd(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real max_abs(Real a, Real b) {
    return _mm512_range_pd(a, b, 0b1011);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE double greatest(Real x) {
    return avx2::RealLanes<double>::greatest(
        _mm256_max_pd(_mm512_castpd512_pd256(x), _mm512_extractf64x4_pd(x, 1)));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real sqrt(Real x) { return _mm512_sqrt_pd(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE unsigned bits(Mask m) { return m; }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask mask(unsigned bits) {
    return static_cast<Mask>(bits);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real join(const Quad<double>* quads) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(quads[0]), quads[4], 1);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Real join_at(const double* const* at) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(at[0])),
                              _mm256_loadu_pd(at[4]), 1);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void transpose(Real r[4]) {
    const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    const __m512d a = _mm512_unpacklo_pd(r[0], r[1]), b = _mm512_unpackhi_pd(r[0], r[1]);
    const __m512d c = _mm512_unpacklo_pd(r[2], r[3]), d = _mm512_unpackhi_pd(r[2], r[3]);
    r[0] = _mm512_permutex2var_pd(a, low, c);
    r[1] = _mm512_permutex2var_pd(b, low, d);
    r[2] = _mm512_permutex2var_pd(a, high, c);
    r[3] = _mm512_permutex2var_pd(b, high, d);
  }
};
#include "algorithms/kernels/real_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx512
#endif

}  // namespace touchstone::real_lanes
