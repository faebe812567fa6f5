// The level of AVX-512 of real_lanes.h. Included by it, inside its namespace.

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
#include "algorithms/kernels/simd/real_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx512
