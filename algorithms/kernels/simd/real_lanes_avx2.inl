// The level of AVX2 of real_lanes.h. Included by it, inside its namespace.

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
#include "algorithms/kernels/simd/real_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx2
