// The AVX2 level of vector.h, which includes this file inside its namespace.

namespace avx2 {
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX2
#include "algorithms/kernels/simd/quad_lanes.inl"

// The places of the set bits of each byte, lowest first, each in a byte.
inline constexpr std::array<std::uint64_t, 256> compress_orders = [] {
  std::array<std::uint64_t, 256> all{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    unsigned count = 0;
    for (unsigned lane = 0; lane < 8; ++lane) {
      if ((bits >> lane & 1) != 0) all[bits] |= std::uint64_t{lane} << (8 * count++);
    }
  }
  return all;
}();

template <class Scalar>
struct Simd;

template <>
struct Simd<float> {
  static constexpr std::size_t width = 8;
  using Vector = __m256;
  using Mask = __m256;

  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector load(const float* from) {
    return _mm256_loadu_ps(from);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void store(float* to, Vector x) {
    _mm256_storeu_ps(to, x);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector broadcast(float x) { return _mm256_set1_ps(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less(Vector a, Vector b) {
    return _mm256_cmp_ps(a, b, _CMP_LT_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less_equal(Vector a, Vector b) {
    return _mm256_cmp_ps(a, b, _CMP_LE_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less_equal(Mask within, Vector a, Vector b) {
    return _mm256_and_ps(within, less_equal(a, b));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector select(Mask mask, Vector a, Vector b) {
    return _mm256_blendv_ps(b, a, mask);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector abs(Vector x) {
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), x);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector max(Vector a, Vector b) {
    return _mm256_max_ps(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector min(Vector a, Vector b) {
    return _mm256_min_ps(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector max_abs(Vector a, Vector b) {
    return max(abs(a), abs(b));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE float reduce_max(Vector x) {
    const __m128 four = _mm_max_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1));
    const __m128 two = _mm_max_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps(two, two, 1)));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector sqrt(Vector x) { return _mm256_sqrt_ps(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE unsigned to_bits(Mask m) {
    return static_cast<unsigned>(_mm256_movemask_ps(m));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask from_bits(unsigned bits) {
    const __m256i lanes = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), lanes);
    return _mm256_castsi256_ps(_mm256_cmpeq_epi32(set, lanes));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector concat(const Quad<float>* quads) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(quads[0]), quads[4], 1);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void transpose(Vector r[4]) {
    const __m256d a = _mm256_castps_pd(_mm256_unpacklo_ps(r[0], r[1]));
    const __m256d b = _mm256_castps_pd(_mm256_unpackhi_ps(r[0], r[1]));
    const __m256d c = _mm256_castps_pd(_mm256_unpacklo_ps(r[2], r[3]));
    const __m256d d = _mm256_castps_pd(_mm256_unpackhi_ps(r[2], r[3]));
    r[0] = _mm256_castpd_ps(_mm256_unpacklo_pd(a, c));
    r[1] = _mm256_castpd_ps(_mm256_unpackhi_pd(a, c));
    r[2] = _mm256_castpd_ps(_mm256_unpacklo_pd(b, d));
    r[3] = _mm256_castpd_ps(_mm256_unpackhi_pd(b, d));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask meet(Vector a, Vector b, Vector c, Vector d) {
    return less_equal(less_equal(c, b), a, d);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask meet(Mask within, Vector a, Vector b, Vector c,
                                                       Vector d) {
    return less_equal(less_equal(within, c, b), a, d);
  }

  TOUCHSTONE_TARGET static float reduce_min16(const float* from) {
    const __m256 x = _mm256_min_ps(load(from), load(from + width));
    return reduce_min4(_mm_min_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1)));
  }
  TOUCHSTONE_TARGET static float reduce_max16(const float* from) {
    const __m256 x = _mm256_max_ps(load(from), load(from + width));
    return reduce_max4(_mm_max_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1)));
  }
  TOUCHSTONE_TARGET static __m256i load_integers(const void* from) {
    return _mm256_loadu_si256(static_cast<const __m256i*>(from));
  }
  // Moves those of eight values whose bits are set to the front.
  TOUCHSTONE_TARGET static __m256i compress8(unsigned bits, __m256i values) {
    const __m128i order = _mm_cvtsi64_si128(static_cast<long long>(compress_orders[bits & 0xff]));
    return _mm256_permutevar8x32_epi32(values, _mm256_cvtepu8_epi32(order));
  }
  template <class Value>
  TOUCHSTONE_TARGET static std::size_t compress(unsigned bits, const Value* from, Value* to) {
    static_assert(sizeof(Value) == 4);
    return compress16(bits, load_integers(from), load_integers(from + width), to);
  }
  TOUCHSTONE_TARGET static std::size_t compress_indices(unsigned bits, std::uint32_t first,
                                                        std::uint32_t* to) {
    const __m256i numbers = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)),
                                             _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    return compress16(bits, numbers, _mm256_add_epi32(numbers, _mm256_set1_epi32(width)), to);
  }
  template <class Value>
  TOUCHSTONE_TARGET static std::size_t compress16(unsigned bits, __m256i first, __m256i second,
                                                  Value* to) {
    const auto count = static_cast<std::size_t>(std::popcount(bits & 0xff));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), compress8(bits, first));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + count), compress8(bits >> width, second));
    return count + static_cast<std::size_t>(std::popcount(bits >> width));
  }
  TOUCHSTONE_TARGET static void fill(std::uint32_t x, std::uint32_t* to) {
    const __m256i all = _mm256_set1_epi32(static_cast<int>(x));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), all);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + width), all);
  }
  TOUCHSTONE_TARGET static unsigned test(const std::uint32_t* marks, std::uint32_t want) {
    const __m256i wanted = _mm256_set1_epi32(static_cast<int>(want));
    const __m256i held = _mm256_cmpeq_epi32(_mm256_and_si256(load_integers(marks), wanted), wanted);
    return to_bits(_mm256_castsi256_ps(held));
  }
};

template <>
struct Simd<double> {
  static constexpr std::size_t width = 4;
  using Vector = __m256d;
  using Mask = __m256d;

  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector load(const double* from) {
    return _mm256_loadu_pd(from);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void store(double* to, Vector x) {
    _mm256_storeu_pd(to, x);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector broadcast(double x) {
    return _mm256_set1_pd(x);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less(Vector a, Vector b) {
    return _mm256_cmp_pd(a, b, _CMP_LT_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less_equal(Vector a, Vector b) {
    return _mm256_cmp_pd(a, b, _CMP_LE_OQ);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask less_equal(Mask within, Vector a, Vector b) {
    return _mm256_and_pd(within, less_equal(a, b));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector select(Mask mask, Vector a, Vector b) {
    return _mm256_blendv_pd(b, a, mask);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector abs(Vector x) {
    return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector max(Vector a, Vector b) {
    return _mm256_max_pd(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector min(Vector a, Vector b) {
    return _mm256_min_pd(a, b);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector max_abs(Vector a, Vector b) {
    return max(abs(a), abs(b));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE double reduce_max(Vector x) {
    const __m128d two = _mm_max_pd(_mm256_castpd256_pd128(x), _mm256_extractf128_pd(x, 1));
    return _mm_cvtsd_f64(_mm_max_sd(two, _mm_unpackhi_pd(two, two)));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector sqrt(Vector x) { return _mm256_sqrt_pd(x); }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE unsigned to_bits(Mask m) {
    return static_cast<unsigned>(_mm256_movemask_pd(m));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Mask from_bits(unsigned bits) {
    const __m256i lanes = _mm256_setr_epi64x(1, 2, 4, 8);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi64x(bits), lanes);
    return _mm256_castsi256_pd(_mm256_cmpeq_epi64(set, lanes));
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector concat(const Quad<double>* quads) {
    return quads[0];
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE Vector concat_at(const double* const* at) {
    return _mm256_loadu_pd(at[0]);
  }
  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void transpose(Vector r[4]) {
    const __m256d a = _mm256_unpacklo_pd(r[0], r[1]), b = _mm256_unpackhi_pd(r[0], r[1]);
    const __m256d c = _mm256_unpacklo_pd(r[2], r[3]), d = _mm256_unpackhi_pd(r[2], r[3]);
    r[0] = _mm256_permute2f128_pd(a, c, 0x20);
    r[1] = _mm256_permute2f128_pd(b, d, 0x20);
    r[2] = _mm256_permute2f128_pd(a, c, 0x31);
    r[3] = _mm256_permute2f128_pd(b, d, 0x31);
  }
};
#include "algorithms/kernels/simd/quads.inl"
// GCC 12 makes two instructions and an insertion of it.
template <>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> widen<float>(const Quad<float>& q) {
  return _mm256_cvtps_pd(q);
}
#undef TOUCHSTONE_TARGET
}  // namespace avx2
