// The level of AVX-512 of box_lanes.h. Included by it, inside its namespace.

namespace avx512 {
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX512
struct Lanes {
  static constexpr std::size_t width = 16;
  using Floats = __m512;
  using Test = __mmask16;

  TOUCHSTONE_TARGET static Floats load(const float* from) { return _mm512_loadu_ps(from); }
  TOUCHSTONE_TARGET static Floats broadcast(float x) { return _mm512_set1_ps(x); }
  TOUCHSTONE_TARGET static Test less_equal(Floats a, Floats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
  }
  TOUCHSTONE_TARGET static Test less_equal(Test within, Floats a, Floats b) {
    return _mm512_mask_cmp_ps_mask(within, a, b, _CMP_LE_OQ);
  }
  TOUCHSTONE_TARGET static unsigned bits(Test test) { return test; }
  TOUCHSTONE_TARGET static unsigned holding(const std::uint32_t* marks, std::uint32_t want) {
    const __m512i wanted = _mm512_set1_epi32(static_cast<int>(want));
    const __m512i mark = _mm512_loadu_si512(marks);
    return _mm512_cmpeq_epi32_mask(_mm512_and_si512(mark, wanted), wanted);
  }
  using Ids = __m512i;
  TOUCHSTONE_TARGET static Ids load_ids(const std::uint32_t* ids) {
    return _mm512_loadu_si512(ids);
  }
  // Compresses in registers and stores whole vectors: compressing to memory is slow on Zen 4.
  TOUCHSTONE_TARGET static IndexPair* put(unsigned lanes, std::uint32_t id, Ids ids,
                                          IndexPair* end) {
    const __m512i one = _mm512_set1_epi32(static_cast<int>(id));
    const __m512i others = _mm512_maskz_compress_epi32(static_cast<__mmask16>(lanes), ids);
    const __m512i a = _mm512_min_epu32(one, others);
    const __m512i b = _mm512_max_epu32(one, others);
    const __m512i low = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    const __m512i high =
        _mm512_setr_epi32(8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
    const auto count = static_cast<std::size_t>(std::popcount(lanes));
    _mm512_storeu_si512(end, _mm512_permutex2var_epi32(a, low, b));
    if (count > 8) _mm512_storeu_si512(end + 8, _mm512_permutex2var_epi32(a, high, b));
    return end + count;
  }
  TOUCHSTONE_TARGET static void write(unsigned lanes, std::uint32_t id, const std::uint32_t* ids,
                                      PairBuffer& out) {
    out.reserve(width);
    out.advance(static_cast<std::size_t>(put(lanes, id, load_ids(ids), out.end()) - out.end()));
  }
  TOUCHSTONE_TARGET static std::size_t compress(unsigned lanes, const float* from, float* to) {
    const auto mask = static_cast<__mmask16>(lanes);
    _mm512_storeu_ps(to, _mm512_maskz_compress_ps(mask, _mm512_loadu_ps(from)));
    return static_cast<std::size_t>(std::popcount(lanes));
  }
  TOUCHSTONE_TARGET static std::size_t compress(unsigned lanes, const std::uint32_t* from,
                                                std::uint32_t* to) {
    const auto mask = static_cast<__mmask16>(lanes);
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(mask, _mm512_loadu_si512(from)));
    return static_cast<std::size_t>(std::popcount(lanes));
  }
  TOUCHSTONE_TARGET static std::size_t compress_numbers(unsigned lanes, std::uint32_t first,
                                                        std::uint32_t* to) {
    const __m512i numbers =
        _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(first)),
                         _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    const auto mask = static_cast<__mmask16>(lanes);
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(mask, numbers));
    return static_cast<std::size_t>(std::popcount(lanes));
  }
  TOUCHSTONE_TARGET static float least16(const float* from) {
    return _mm512_reduce_min_ps(load(from));
  }
  TOUCHSTONE_TARGET static float greatest16(const float* from) {
    return _mm512_reduce_max_ps(load(from));
  }
};
#include "algorithms/kernels/boxes/aabb_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx512
