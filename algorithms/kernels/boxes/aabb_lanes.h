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
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/simd/target_attributes.h"

namespace touchstone::box_lanes {

// The arrays' places by value, so that the loops keep them in registers whatever they write.
struct Columns {
  const float* min[3];
  const float* max[3];
  const std::uint32_t* ids;
};

inline Columns columns_of(const AabbSoA& boxes) {
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
#include "algorithms/kernels/boxes/aabb_lanes.inl"
#undef TOUCHSTONE_TARGET
}  // namespace baseline

#if defined(__x86_64__)
#include "algorithms/kernels/boxes/aabb_lanes_avx2.inl"
#include "algorithms/kernels/boxes/aabb_lanes_avx512.inl"
#else
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif

}  // namespace touchstone::box_lanes
