// The children of a node that a ray meets, as keys that sort from near to far, and eight of them sorted in
// a vector without a branch: which children are met in which order is what processors predict worst.
// Paper: Batcher, "Sorting networks and their applications", AFIPS 1968.
#pragma once

#include <bit>
#include <cstdint>

#include "algorithms/kernels/simd/target_attributes.h"

namespace touchstone::ray_tree {

// `near`, which is not negative, in the upper half and the child in the lower. Keys sort by near, and by
// number where it is equal.
inline std::uint64_t key_of(std::int32_t child, float near) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(near)} << 32 |
         static_cast<std::uint32_t>(child);
}
inline std::int32_t child_of(std::uint64_t key) { return static_cast<std::int32_t>(key); }
inline float near_of(std::uint64_t key) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32));
}

#if defined(__x86_64__)
namespace sorting_network {
// A stage compares each lane with its partner; the lanes of `least` keep the lesser key.
template <int p0, int p1, int p2, int p3, int p4, int p5, int p6, int p7, unsigned least>
TOUCHSTONE_TARGET_AVX512 inline __attribute__((always_inline)) __m512i stage(__m512i keys) {
  const __m512i others =
      _mm512_permutexvar_epi64(_mm512_setr_epi64(p0, p1, p2, p3, p4, p5, p6, p7), keys);
  return _mm512_mask_min_epu64(_mm512_max_epu64(keys, others), static_cast<__mmask8>(least), keys,
                               others);
}
}  // namespace sorting_network

// Writes the keys of the children whose bits are set to `to`, from far to near, and something behind them
// up to the eighth; returns the least key. At least one bit is set.
TOUCHSTONE_TARGET_AVX512 inline __attribute__((always_inline)) std::uint64_t push_sorted(
    unsigned bits, const std::int32_t* child, __m256 near, std::uint64_t* to) {
  namespace network = sorting_network;
  const __m512i children =
      _mm512_cvtepu32_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(child)));
  const __m512i nears = _mm512_cvtepu32_epi64(_mm256_castps_si256(near));
  const __m512i packed = _mm512_or_si512(_mm512_slli_epi64(nears, 32), children);
  const auto set = static_cast<__mmask8>(bits);
  const std::uint64_t least = _mm512_mask_reduce_min_epu64(set, packed);
  // What is left out is zero, less than any key of a leaf or of a node but the root.
  __m512i keys = _mm512_maskz_mov_epi64(set, packed);
  keys = network::stage<1, 0, 3, 2, 5, 4, 7, 6, 0b10101010>(keys);
  keys = network::stage<2, 3, 0, 1, 6, 7, 4, 5, 0b11001100>(keys);
  keys = network::stage<0, 2, 1, 3, 4, 6, 5, 7, 0b01000100>(keys);
  keys = network::stage<4, 5, 6, 7, 0, 1, 2, 3, 0b11110000>(keys);
  keys = network::stage<0, 1, 4, 5, 2, 3, 6, 7, 0b00110000>(keys);
  keys = network::stage<0, 2, 1, 4, 3, 6, 5, 7, 0b01010100>(keys);
  _mm512_storeu_si512(to, keys);
  return least;
}
#endif

}  // namespace touchstone::ray_tree
