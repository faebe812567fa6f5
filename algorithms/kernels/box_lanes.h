// Vectors of boxes at each level of vector instructions, for the files whose loops test many boxes
// at a time. Such a file includes its loops once for each level, by every_level.inl.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "algorithms/core/isa.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/box_arrays.h"

#if defined(__x86_64__)
#pragma GCC diagnostic push
#if !defined(__clang__)
// GCC 12 takes the header's own undefined vectors for mistakes of ours.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
#include <immintrin.h>
#pragma GCC diagnostic pop
#endif

#define TOUCHSTONE_TARGET_AVX2 __attribute__((target("avx2")))
#define TOUCHSTONE_TARGET_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl")))

namespace touchstone::box_lanes {

// The arrays' places by value, so that the loops keep them in registers whatever they write.
struct Columns {
  const float* min[3];
  const float* max[3];
  const std::uint32_t* ids;
};

inline Columns columns_of(const BoxArrays& boxes) {
  return {{boxes.min(0), boxes.min(1), boxes.min(2)},
          {boxes.max(0), boxes.max(1), boxes.max(2)},
          boxes.ids()};
}

// Writes the ids of one box and of those among ids[0..] whose bit is set, where there is room for
// 16 pairs; where they end.
inline IndexPair* put_pairs(unsigned lanes, std::uint32_t id, const std::uint32_t* ids,
                            IndexPair* end) {
  for (; lanes != 0; lanes &= lanes - 1) {
    const std::uint32_t other = ids[std::countr_zero(lanes)];
    *end++ = {std::min(id, other), std::max(id, other)};
  }
  return end;
}

// The same into a buffer.
inline void write_pairs(unsigned lanes, std::uint32_t id, const std::uint32_t* ids,
                        PairBuffer& out) {
  out.reserve(static_cast<std::size_t>(std::popcount(lanes)));
  out.advance(static_cast<std::size_t>(put_pairs(lanes, id, ids, out.end()) - out.end()));
}

// Those of from[0..15] whose bit is set, one behind the other; how many.
template <class Value>
inline std::size_t pick(unsigned lanes, const Value* from, Value* to) {
  std::size_t count = 0;
  for (; lanes != 0; lanes &= lanes - 1) to[count++] = from[std::countr_zero(lanes)];
  return count;
}
// The numbers first + lane of the bits that are set; how many.
inline std::size_t pick_numbers(unsigned lanes, std::uint32_t first, std::uint32_t* to) {
  std::size_t count = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    to[count++] = first + static_cast<std::uint32_t>(std::countr_zero(lanes));
  }
  return count;
}

// By element, so that it compiles to the same on any machine.
template <class Floats4>
inline float least4(Floats4 x) {
  return std::min(std::min(x[0], x[1]), std::min(x[2], x[3]));
}
template <class Floats4>
inline float greatest4(Floats4 x) {
  return std::max(std::max(x[0], x[1]), std::max(x[2], x[3]));
}

// Four lanes in the compiler's own vector types: SSE2 on x86-64, whatever there is elsewhere.
namespace baseline {
struct Lanes {
  static constexpr std::size_t width = 4;
  using Floats = float __attribute__((vector_size(16)));
  using Test = std::int32_t __attribute__((vector_size(16)));

  static Floats load(const float* from) {
    Floats x;
    std::memcpy(&x, from, sizeof x);
    return x;
  }
  static Floats broadcast(float x) { return Floats{x, x, x, x}; }
  static Test less_equal(Floats a, Floats b) { return a <= b; }
  static Test less_equal(Test within, Floats a, Floats b) { return within & (a <= b); }
  static unsigned bits(Test test) {
#if defined(__x86_64__)
    return static_cast<unsigned>(_mm_movemask_ps(std::bit_cast<__m128>(test)));
#else
    return (test[0] & 1u) | (test[1] & 2u) | (test[2] & 4u) | (test[3] & 8u);
#endif
  }
  // Which of marks[0..3] have every bit of `want`.
  static unsigned holding(const std::uint32_t* marks, std::uint32_t want) {
    unsigned lanes = 0;
    for (unsigned lane = 0; lane < width; ++lane) {
      lanes |= static_cast<unsigned>((marks[lane] & want) == want) << lane;
    }
    return lanes;
  }
  static void write(unsigned lanes, std::uint32_t id, const std::uint32_t* ids, PairBuffer& out) {
    write_pairs(lanes, id, ids, out);
  }
  // Sixteen ids, and the pairs of another with those whose bit is set: where there is room for 16.
  using Ids = const std::uint32_t*;
  static Ids load_ids(const std::uint32_t* ids) { return ids; }
  static IndexPair* put(unsigned lanes, std::uint32_t id, Ids ids, IndexPair* end) {
    return put_pairs(lanes, id, ids, end);
  }
  // As box_lanes::pick and pick_numbers, but up to 16 values may be written.
  template <class Value>
  static std::size_t compress(unsigned lanes, const Value* from, Value* to) {
    return pick(lanes, from, to);
  }
  static std::size_t compress_numbers(unsigned lanes, std::uint32_t first, std::uint32_t* to) {
    return pick_numbers(lanes, first, to);
  }
  // Of from[0..15].
  static float least16(const float* from) {
    Floats x = load(from);
    for (std::size_t part = width; part < 16; part += width) {
      const Floats y = load(from + part);
      x = y < x ? y : x;
    }
    return least4(x);
  }
  static float greatest16(const float* from) {
    Floats x = load(from);
    for (std::size_t part = width; part < 16; part += width) {
      const Floats y = load(from + part);
      x = y > x ? y : x;
    }
    return greatest4(x);
  }
};
#define TOUCHSTONE_TARGET
#include "algorithms/kernels/box_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace baseline

#if defined(__x86_64__)

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
#include "algorithms/kernels/box_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx2

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
#include "algorithms/kernels/box_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx512

#else
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif

}  // namespace touchstone::box_lanes
