// The level of AVX2 of box_lanes.h. Included by it, inside its namespace.

namespace avx2 {
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX2
// For each eight bits the places of those that are set, a byte each, lowest first.
inline constexpr std::array<std::uint64_t, 256> orders = [] {
  std::array<std::uint64_t, 256> all{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    unsigned count = 0;
    for (unsigned lane = 0; lane < 8; ++lane) {
      if ((bits >> lane & 1) != 0) all[bits] |= std::uint64_t{lane} << (8 * count++);
    }
  }
  return all;
}();

struct Lanes {
  static constexpr std::size_t width = 8;
  using Floats = __m256;
  using Test = __m256;

  TOUCHSTONE_TARGET static Floats load(const float* from) { return _mm256_loadu_ps(from); }
  TOUCHSTONE_TARGET static Floats broadcast(float x) { return _mm256_set1_ps(x); }
  TOUCHSTONE_TARGET static Test less_equal(Floats a, Floats b) {
    return _mm256_cmp_ps(a, b, _CMP_LE_OQ);
  }
  TOUCHSTONE_TARGET static Test less_equal(Test within, Floats a, Floats b) {
    return _mm256_and_ps(within, _mm256_cmp_ps(a, b, _CMP_LE_OQ));
  }
  TOUCHSTONE_TARGET static unsigned bits(Test test) {
    return static_cast<unsigned>(_mm256_movemask_ps(test));
  }
  TOUCHSTONE_TARGET static unsigned holding(const std::uint32_t* marks, std::uint32_t want) {
    const __m256i wanted = _mm256_set1_epi32(static_cast<int>(want));
    const __m256i mark = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(marks));
    const __m256i held = _mm256_cmpeq_epi32(_mm256_and_si256(mark, wanted), wanted);
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(held)));
  }
  // Those of eight values whose bit is set come first.
  TOUCHSTONE_TARGET static __m256i to_front(unsigned lanes, __m256i values) {
    const __m128i order = _mm_cvtsi64_si128(static_cast<long long>(orders[lanes & 0xff]));
    return _mm256_permutevar8x32_epi32(values, _mm256_cvtepu8_epi32(order));
  }
  TOUCHSTONE_TARGET static __m256i load_integers(const void* from) {
    return _mm256_loadu_si256(static_cast<const __m256i*>(from));
  }
  TOUCHSTONE_TARGET static IndexPair* put8(unsigned lanes, __m256i one, __m256i ids,
                                           IndexPair* end) {
    const __m256i others = to_front(lanes, ids);
    const __m256i a = _mm256_min_epu32(one, others);
    const __m256i b = _mm256_max_epu32(one, others);
    const __m256i even = _mm256_unpacklo_epi32(a, b);  // pairs 0, 1, 4, 5
    const __m256i odd = _mm256_unpackhi_epi32(a, b);   // pairs 2, 3, 6, 7
    auto* const to = reinterpret_cast<__m256i*>(end);
    _mm256_storeu_si256(to, _mm256_permute2x128_si256(even, odd, 0x20));
    _mm256_storeu_si256(to + 1, _mm256_permute2x128_si256(even, odd, 0x31));
    return end + std::popcount(lanes);
  }
  TOUCHSTONE_TARGET static void write(unsigned lanes, std::uint32_t id, const std::uint32_t* ids,
                                      PairBuffer& out) {
    out.reserve(2 * width);
    const __m256i one = _mm256_set1_epi32(static_cast<int>(id));
    IndexPair* end = put8(lanes & 0xff, one, load_integers(ids), out.end());
    if (lanes >> width != 0) end = put8(lanes >> width, one, load_integers(ids + width), end);
    out.advance(static_cast<std::size_t>(end - out.end()));
  }
  // Sixteen ids, and the pairs of another with those whose bit is set: where there is room for 16.
  struct Ids {
    __m256i first, second;
  };
  TOUCHSTONE_TARGET static Ids load_ids(const std::uint32_t* ids) {
    return {load_integers(ids), load_integers(ids + width)};
  }
  TOUCHSTONE_TARGET static IndexPair* put(unsigned lanes, std::uint32_t id, const Ids& ids,
                                          IndexPair* end) {
    const __m256i one = _mm256_set1_epi32(static_cast<int>(id));
    return put8(lanes >> width, one, ids.second, put8(lanes & 0xff, one, ids.first, end));
  }
  // As box_lanes::pick and pick_numbers, but up to 16 values may be written.
  template <class Value>
  TOUCHSTONE_TARGET static std::size_t compress(unsigned lanes, const Value* from, Value* to) {
    static_assert(sizeof(Value) == 4);
    return store(lanes, load_integers(from), load_integers(from + width), to);
  }
  TOUCHSTONE_TARGET static std::size_t compress_numbers(unsigned lanes, std::uint32_t first,
                                                        std::uint32_t* to) {
    const __m256i numbers = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)),
                                             _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    return store(lanes, numbers, _mm256_add_epi32(numbers, _mm256_set1_epi32(width)), to);
  }
  template <class Value>
  TOUCHSTONE_TARGET static std::size_t store(unsigned lanes, __m256i first, __m256i second,
                                             Value* to) {
    const auto count = static_cast<std::size_t>(std::popcount(lanes & 0xff));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), to_front(lanes, first));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + count), to_front(lanes >> width, second));
    return count + static_cast<std::size_t>(std::popcount(lanes >> width));
  }
  TOUCHSTONE_TARGET static float least16(const float* from) {
    const __m256 x = _mm256_min_ps(load(from), load(from + width));
    return least4(_mm_min_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1)));
  }
  TOUCHSTONE_TARGET static float greatest16(const float* from) {
    const __m256 x = _mm256_max_ps(load(from), load(from + width));
    return greatest4(_mm_max_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1)));
  }
};
#include "algorithms/kernels/boxes/aabb_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx2
