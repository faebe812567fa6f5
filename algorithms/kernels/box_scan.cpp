#include "algorithms/kernels/box_scan.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "algorithms/core/isa.h"

#if defined(__x86_64__)
#pragma GCC diagnostic push
#if !defined(__clang__)
// GCC 12 takes the header's own undefined vectors for mistakes of ours.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>
#pragma GCC diagnostic pop
#endif

namespace touchstone {
namespace {

// The arrays' places by value, so that the loops keep them in registers whatever they write.
struct Columns {
  const float* min[3];
  const float* max[3];
  const std::uint32_t* ids;
};

struct Marks {
  const std::uint32_t* marks;
  const std::uint32_t* wants;
};

Columns columns_of(const BoxArrays& boxes) {
  return {{boxes.min(0), boxes.min(1), boxes.min(2)},
          {boxes.max(0), boxes.max(1), boxes.max(2)},
          boxes.ids()};
}

// The ids of one box and of those among ids[0..] whose bit is set.
inline void write_pairs(unsigned lanes, std::uint32_t id, const std::uint32_t* ids,
                        PairBuffer& out) {
  out.reserve(static_cast<std::size_t>(std::popcount(lanes)));
  IndexPair* end = out.end();
  for (; lanes != 0; lanes &= lanes - 1) {
    const std::uint32_t other = ids[std::countr_zero(lanes)];
    *end++ = {std::min(id, other), std::max(id, other)};
  }
  out.advance(static_cast<std::size_t>(end - out.end()));
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
};
#define TOUCHSTONE_TARGET
#include "algorithms/kernels/box_scan.inl"
#undef TOUCHSTONE_TARGET
}  // namespace baseline

#if defined(__x86_64__)

namespace avx2 {
#define TOUCHSTONE_TARGET __attribute__((target("avx2")))
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
  TOUCHSTONE_TARGET static void write(unsigned lanes, std::uint32_t id, const std::uint32_t* ids,
                                      PairBuffer& out) {
    write_pairs(lanes, id, ids, out);
  }
};
#include "algorithms/kernels/box_scan.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx2

namespace avx512 {
#define TOUCHSTONE_TARGET __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl")))
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
  // Compresses in registers and stores whole vectors: compressing to memory is slow on Zen 4.
  TOUCHSTONE_TARGET static void write(unsigned lanes, std::uint32_t id, const std::uint32_t* ids,
                                      PairBuffer& out) {
    const auto mask = static_cast<__mmask16>(lanes);
    const __m512i one = _mm512_set1_epi32(static_cast<int>(id));
    const __m512i others = _mm512_maskz_compress_epi32(mask, _mm512_loadu_si512(ids));
    const __m512i a = _mm512_min_epu32(one, others);
    const __m512i b = _mm512_max_epu32(one, others);
    const __m512i low = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    const __m512i high =
        _mm512_setr_epi32(8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
    const auto count = static_cast<std::size_t>(std::popcount(lanes));
    out.reserve(width);
    _mm512_storeu_si512(out.end(), _mm512_permutex2var_epi32(a, low, b));
    if (count > 8) _mm512_storeu_si512(out.end() + 8, _mm512_permutex2var_epi32(a, high, b));
    out.advance(count);
  }
};
#include "algorithms/kernels/box_scan.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx512

#else
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif

}  // namespace

void scan_boxes(const BoxArrays& boxes, IndexRange rows, std::span<const IndexRange> columns,
                PairBuffer& out) {
  switch (isa()) {
    case Isa::avx512: return avx512::scan(columns_of(boxes), rows, columns, out);
    case Isa::avx2: return avx2::scan(columns_of(boxes), rows, columns, out);
    case Isa::baseline: return baseline::scan(columns_of(boxes), rows, columns, out);
  }
}

void scan_marked_boxes(const BoxArrays& boxes, std::span<const std::uint32_t> marks,
                       std::span<const std::uint32_t> wants, IndexRange rows, IndexRange columns,
                       PairBuffer& out) {
  const Marks m{marks.data(), wants.data()};
  switch (isa()) {
    case Isa::avx512: return avx512::scan_marked(columns_of(boxes), m, rows, columns, out);
    case Isa::avx2: return avx2::scan_marked(columns_of(boxes), m, rows, columns, out);
    case Isa::baseline: return baseline::scan_marked(columns_of(boxes), m, rows, columns, out);
  }
}

void sweep_boxes(const BoxArrays& boxes, int axis, IndexRange rows, PairBuffer& out) {
  switch (isa()) {
    case Isa::avx512: return avx512::sweep(columns_of(boxes), axis, rows, out);
    case Isa::avx2: return avx2::sweep(columns_of(boxes), axis, rows, out);
    case Isa::baseline: return baseline::sweep(columns_of(boxes), axis, rows, out);
  }
}

std::size_t pairs_of_scan(IndexRange rows, IndexRange columns) {
  const std::size_t first = std::max(rows.first, columns.first);
  const std::size_t last = std::max(first, std::min(rows.last, columns.last));
  const std::size_t within = last - first;  // rows that the range holds
  const std::size_t outside = rows.last - rows.first - within;
  // Row i within is tested against columns.last - 1 - i.
  const std::size_t behind = within * (columns.last - 1 - first) - within * (within - 1) / 2;
  return outside * (columns.last - columns.first) + behind;
}

BroadPhaseWork work_of_sweep(const BoxArrays& boxes, int axis) {
  const std::span min(boxes.min(axis), boxes.size());
  std::size_t candidates = 0;
  std::size_t ended = 0;
  for (std::size_t row = 0; row < boxes.size(); ++row) {
    const auto behind = min.subspan(row + 1);
    const auto end = std::ranges::upper_bound(behind, boxes.max(axis)[row]);
    candidates += static_cast<std::size_t>(end - behind.begin());
    ended += end != behind.end() ? 1 : 0;
  }
  return {.box_tests = static_cast<std::int64_t>(candidates + ended),
          .node_visits = 0,
          .candidates = static_cast<std::int64_t>(candidates)};
}

}  // namespace touchstone
