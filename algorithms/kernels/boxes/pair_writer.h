// The output of pairs of one box with up to sixteen others, at each level of vector instructions.
// Used by all vector loops that write pairs.
//
// A PairWriter loads sixteen ids, and writes the pairs of another id with those whose bits are set:
// `put` needs room for 16 pairs, `write` appends to a buffer.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone::pair_writer {

namespace baseline {
using namespace simd::baseline;
struct PairWriter {
  using Ids = const std::uint32_t*;
  static Ids load_ids(const std::uint32_t* ids) { return ids; }
  static IndexPair* put(unsigned bits, std::uint32_t id, Ids ids, IndexPair* end) {
    for (; bits != 0; bits &= bits - 1) {
      const std::uint32_t other = ids[std::countr_zero(bits)];
      *end++ = {std::min(id, other), std::max(id, other)};
    }
    return end;
  }
  static void write(unsigned bits, std::uint32_t id, const std::uint32_t* ids, PairBuffer& out) {
    out.reserve(static_cast<std::size_t>(std::popcount(bits)));
    out.advance(static_cast<std::size_t>(put(bits, id, ids, out.end()) - out.end()));
  }
};
}  // namespace baseline

#if defined(__x86_64__)
namespace avx2 {
using namespace simd::avx2;
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX2
struct PairWriter {
  static constexpr std::size_t width = 8;
  struct Ids {
    __m256i first, second;
  };
  TOUCHSTONE_TARGET static __m256i load8(const std::uint32_t* ids) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids));
  }
  TOUCHSTONE_TARGET static Ids load_ids(const std::uint32_t* ids) {
    return {load8(ids), load8(ids + width)};
  }
  TOUCHSTONE_TARGET static IndexPair* put8(unsigned bits, __m256i one, __m256i ids,
                                           IndexPair* end) {
    const __m256i others = Simd<float>::compress8(bits, ids);
    const __m256i a = _mm256_min_epu32(one, others);
    const __m256i b = _mm256_max_epu32(one, others);
    const __m256i even = _mm256_unpacklo_epi32(a, b);  // pairs 0, 1, 4, 5
    const __m256i odd = _mm256_unpackhi_epi32(a, b);   // pairs 2, 3, 6, 7
    auto* const to = reinterpret_cast<__m256i*>(end);
    _mm256_storeu_si256(to, _mm256_permute2x128_si256(even, odd, 0x20));
    _mm256_storeu_si256(to + 1, _mm256_permute2x128_si256(even, odd, 0x31));
    return end + std::popcount(bits);
  }
  TOUCHSTONE_TARGET static IndexPair* put(unsigned bits, std::uint32_t id, const Ids& ids,
                                          IndexPair* end) {
    const __m256i one = _mm256_set1_epi32(static_cast<int>(id));
    return put8(bits >> width, one, ids.second, put8(bits & 0xff, one, ids.first, end));
  }
  TOUCHSTONE_TARGET static void write(unsigned bits, std::uint32_t id, const std::uint32_t* ids,
                                      PairBuffer& out) {
    out.reserve(2 * width);
    const __m256i one = _mm256_set1_epi32(static_cast<int>(id));
    IndexPair* end = put8(bits & 0xff, one, load8(ids), out.end());
    if (bits >> width != 0) end = put8(bits >> width, one, load8(ids + width), end);
    out.advance(static_cast<std::size_t>(end - out.end()));
  }
};
#undef TOUCHSTONE_TARGET
}  // namespace avx2

namespace avx512 {
using namespace simd::avx512;
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX512
struct PairWriter {
  using Ids = __m512i;
  TOUCHSTONE_TARGET static Ids load_ids(const std::uint32_t* ids) {
    return _mm512_loadu_si512(ids);
  }
  TOUCHSTONE_TARGET static IndexPair* put(unsigned bits, std::uint32_t id, Ids ids,
                                          IndexPair* end) {
    const __m128i one = _mm_set1_epi32(static_cast<int>(id));
    const __m128i nibbles = _mm_setr_epi32(0, 4, 8, 12);
    const __m256i in_turn = _mm256_setr_epi32(0, 8, 1, 9, 2, 10, 3, 11);
    const auto count = static_cast<std::size_t>(std::popcount(bits));
    std::uint64_t numbers = Simd<float>::numbers_of(bits);
    // Four pairs at a time, because mostly there are fewer, and whole vectors that cross lines of
    // the cache are slow to store.
    std::size_t written = 0;
    do {
      const __m128i order = _mm_srlv_epi32(_mm_set1_epi32(static_cast<int>(numbers)), nibbles);
      const __m128i others =
          _mm512_castsi512_si128(_mm512_permutexvar_epi32(_mm512_castsi128_si512(order), ids));
      const __m256i a = _mm256_castsi128_si256(_mm_min_epu32(one, others));
      const __m256i b = _mm256_castsi128_si256(_mm_max_epu32(one, others));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(end + written),
                          _mm256_permutex2var_epi32(a, in_turn, b));
      numbers >>= 16;
      written += 4;
    } while (written < count);
    return end + count;
  }
  TOUCHSTONE_TARGET static void write(unsigned bits, std::uint32_t id, const std::uint32_t* ids,
                                      PairBuffer& out) {
    out.reserve(16);
    out.advance(static_cast<std::size_t>(put(bits, id, load_ids(ids), out.end()) - out.end()));
  }
};
#undef TOUCHSTONE_TARGET
}  // namespace avx512
#else
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif

}  // namespace touchstone::pair_writer
