// The AVX-512 level of vector.h, which includes this file inside its namespace.

namespace avx512 {
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX512
#include "algorithms/kernels/simd/quad_lanes.inl"

template <class Scalar>
struct Simd;

template <>
struct Simd<float> {
  static constexpr std::size_t width = 16;
  using Vector = __m512;
  using Mask = __mmask16;

  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector load(const float* from) {
    return _mm512_loadu_ps(from);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void store(float* to, Vector x) {
    _mm512_storeu_ps(to, x);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector broadcast(float x) { return _mm512_set1_ps(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less(Vector a, Vector b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less_equal(Vector a, Vector b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less_equal(Mask within, Vector a, Vector b) {
    return _mm512_mask_cmp_ps_mask(within, a, b, _CMP_LE_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector select(Mask mask, Vector a, Vector b) {
    return _mm512_mask_blend_ps(mask, b, a);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector abs(Vector x) { return _mm512_abs_ps(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector max(Vector a, Vector b) {
    return _mm512_max_ps(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector min(Vector a, Vector b) {
    return _mm512_min_ps(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector max_abs(Vector a, Vector b) {
    return _mm512_range_ps(a, b, 0b1011);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE float reduce_max(Vector x) {
    return avx2::Simd<float>::reduce_max(
        _mm256_max_ps(_mm512_castps512_ps256(x), _mm512_extractf32x8_ps(x, 1)));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector sqrt(Vector x) { return _mm512_sqrt_ps(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE unsigned to_bits(Mask m) { return m; }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask from_bits(unsigned bits) {
    return static_cast<Mask>(bits);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector concat(const Quad<float>* quads) {
    const __m256 low = _mm256_insertf128_ps(_mm256_castps128_ps256(quads[0]), quads[4], 1);
    const __m256 high = _mm256_insertf128_ps(_mm256_castps128_ps256(quads[8]), quads[12], 1);
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void transpose(Vector r[4]) {
    const __m512d a = _mm512_castps_pd(_mm512_unpacklo_ps(r[0], r[1]));
    const __m512d b = _mm512_castps_pd(_mm512_unpackhi_ps(r[0], r[1]));
    const __m512d c = _mm512_castps_pd(_mm512_unpacklo_ps(r[2], r[3]));
    const __m512d d = _mm512_castps_pd(_mm512_unpackhi_ps(r[2], r[3]));
    r[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(a, c));
    r[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(a, c));
    r[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(b, d));
    r[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(b, d));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask meet(Vector a, Vector b, Vector c, Vector d) {
    return less_equal(max(a, c), min(b, d));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask meet(Mask within, Vector a, Vector b, Vector c,
                                                       Vector d) {
    return less_equal(within, max(a, c), min(b, d));
  }

  TOUCHSTONE_TARGET static float reduce_min16(const float* from) {
    return _mm512_reduce_min_ps(load(from));
  }
  TOUCHSTONE_TARGET static float reduce_max16(const float* from) {
    return _mm512_reduce_max_ps(load(from));
  }
  // The numbers of the set bits, lowest first, four bits each. Instructions that compress vectors
  // take several times as long as these two and a permutation.
  TOUCHSTONE_TARGET static std::uint64_t numbers_of(unsigned bits) {
    return _pext_u64(0xfedcba9876543210, _pdep_u64(bits, 0x1111111111111111) * 15);
  }
  // The first eight of such numbers, each in a lane, below other bits.
  TOUCHSTONE_TARGET static __m256i spread8(std::uint64_t numbers) {
    return _mm256_srlv_epi32(_mm256_set1_epi32(static_cast<int>(numbers)),
                             _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28));
  }
  // The order of lanes that moves those whose bits are set to the front.
  TOUCHSTONE_TARGET static __m512i order_of(unsigned bits) {
    const std::uint64_t numbers = numbers_of(bits);
    return _mm512_inserti64x4(_mm512_castsi256_si512(spread8(numbers)), spread8(numbers >> 32), 1);
  }
  TOUCHSTONE_TARGET static std::size_t compress(unsigned bits, const float* from, float* to) {
    _mm512_storeu_ps(to, _mm512_permutexvar_ps(order_of(bits), load(from)));
    return static_cast<std::size_t>(std::popcount(bits));
  }
  TOUCHSTONE_TARGET static std::size_t compress(unsigned bits, const std::uint32_t* from,
                                                std::uint32_t* to) {
    _mm512_storeu_si512(to, _mm512_permutexvar_epi32(order_of(bits), _mm512_loadu_si512(from)));
    return static_cast<std::size_t>(std::popcount(bits));
  }
  TOUCHSTONE_TARGET static std::size_t compress_indices(unsigned bits, std::uint32_t first,
                                                        std::uint32_t* to) {
    const std::uint64_t numbers = numbers_of(bits);
    const auto count = static_cast<std::size_t>(std::popcount(bits));
    store_numbers(first, spread8(numbers), to);
    if (count > 8) store_numbers(first, spread8(numbers >> 32), to + 8);
    return count;
  }
  TOUCHSTONE_TARGET static void store_numbers(std::uint32_t first, __m256i numbers,
                                              std::uint32_t* to) {
    const __m256i lanes = _mm256_and_si256(numbers, _mm256_set1_epi32(15));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_add_epi32(lanes, _mm256_set1_epi32(static_cast<int>(first))));
  }
  TOUCHSTONE_TARGET static void fill(std::uint32_t x, std::uint32_t* to) {
    _mm512_storeu_si512(to, _mm512_set1_epi32(static_cast<int>(x)));
  }
  TOUCHSTONE_TARGET static unsigned test(const std::uint32_t* marks, std::uint32_t want) {
    const __m512i wanted = _mm512_set1_epi32(static_cast<int>(want));
    const __m512i mark = _mm512_loadu_si512(marks);
    return _mm512_cmpeq_epi32_mask(_mm512_and_si512(mark, wanted), wanted);
  }
};

template <>
struct Simd<double> {
  static constexpr std::size_t width = 8;
  using Vector = __m512d;
  using Mask = __mmask8;

  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector load(const double* from) {
    return _mm512_loadu_pd(from);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void store(double* to, Vector x) {
    _mm512_storeu_pd(to, x);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector broadcast(double x) {
    return _mm512_set1_pd(x);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less(Vector a, Vector b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less_equal(Vector a, Vector b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less_equal(Mask within, Vector a, Vector b) {
    return _mm512_mask_cmp_pd_mask(within, a, b, _CMP_LE_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector select(Mask mask, Vector a, Vector b) {
    return _mm512_mask_blend_pd(mask, b, a);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector abs(Vector x) { return _mm512_abs_pd(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector max(Vector a, Vector b) {
    return _mm512_max_pd(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector min(Vector a, Vector b) {
    return _mm512_min_pd(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector max_abs(Vector a, Vector b) {
    return _mm512_range_pd(a, b, 0b1011);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE double reduce_max(Vector x) {
    return avx2::Simd<double>::reduce_max(
        _mm256_max_pd(_mm512_castpd512_pd256(x), _mm512_extractf64x4_pd(x, 1)));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector sqrt(Vector x) { return _mm512_sqrt_pd(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE unsigned to_bits(Mask m) { return m; }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask from_bits(unsigned bits) {
    return static_cast<Mask>(bits);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector concat(const Quad<double>* quads) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(quads[0]), quads[4], 1);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector concat_at(const double* const* at) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(at[0])),
                              _mm256_loadu_pd(at[4]), 1);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void transpose(Vector r[4]) {
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
#include "algorithms/kernels/simd/quads.inl"
template <>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> widen<float>(const Quad<float>& q) {
  return _mm256_cvtps_pd(q);
}
#undef TOUCHSTONE_TARGET
}  // namespace avx512
