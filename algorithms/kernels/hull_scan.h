// The vertex of a hull that lies furthest in a direction, by looking at all of them: for each level
// of vector instructions, to be inlined where it is used.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "algorithms/core/isa.h"
#include "algorithms/core/vec.h"

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

namespace touchstone::hull_scan {

// Sixteen vertices; copies of the first fill up the last block.
template <class Scalar>
struct VertexBlock {
  static constexpr std::size_t size = 16;
  alignas(64) Scalar x[size], y[size], z[size];

  Vec3<Scalar> vertex(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

template <class Scalar>
struct Found {
  Scalar value;
  std::uint32_t index;
};

inline constexpr std::size_t most_blocks = 16;  // that are looked at together

// At each level `furthest(blocks, direction)` is the index of the vertex with the greatest d.v; of
// several the first: the same at every level. NaN is nobody's greatest: then it is vertex 0.
#if defined(__x86_64__)
namespace baseline {
#define TOUCHSTONE_TARGET
struct Floats {
  using Vector = __m128;
  static constexpr std::size_t width = 4;
  static Vector broadcast(float x) { return _mm_set1_ps(x); }
  static Vector load(const float* x) { return _mm_loadu_ps(x); }
  static Vector greater(Vector a, Vector b) { return _mm_max_ps(a, b); }
  static float greatest(Vector v) {
    v = _mm_max_ps(v, _mm_movehl_ps(v, v));
    return _mm_cvtss_f32(_mm_max_ss(v, _mm_shuffle_ps(v, v, 1)));
  }
  static unsigned equal(Vector a, Vector b) {
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmpeq_ps(a, b)));
  }
};
struct Doubles {
  using Vector = __m128d;
  static constexpr std::size_t width = 2;
  static Vector broadcast(double x) { return _mm_set1_pd(x); }
  static Vector load(const double* x) { return _mm_loadu_pd(x); }
  static Vector greater(Vector a, Vector b) { return _mm_max_pd(a, b); }
  static double greatest(Vector v) { return _mm_cvtsd_f64(_mm_max_sd(v, _mm_unpackhi_pd(v, v))); }
  static unsigned equal(Vector a, Vector b) {
    return static_cast<unsigned>(_mm_movemask_pd(_mm_cmpeq_pd(a, b)));
  }
};
#include "algorithms/kernels/hull_scan.inl"
#undef TOUCHSTONE_TARGET
}  // namespace baseline

namespace avx2 {
#define TOUCHSTONE_TARGET __attribute__((target("avx2")))
struct Floats {
  using Vector = __m256;
  static constexpr std::size_t width = 8;
  TOUCHSTONE_TARGET static Vector broadcast(float x) { return _mm256_set1_ps(x); }
  TOUCHSTONE_TARGET static Vector load(const float* x) { return _mm256_loadu_ps(x); }
  TOUCHSTONE_TARGET static Vector greater(Vector a, Vector b) { return _mm256_max_ps(a, b); }
  TOUCHSTONE_TARGET static float greatest(Vector v) {
    return baseline::Floats::greatest(
        _mm_max_ps(_mm256_castps256_ps128(v), _mm256_extractf128_ps(v, 1)));
  }
  TOUCHSTONE_TARGET static unsigned equal(Vector a, Vector b) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_EQ_OQ)));
  }
};
struct Doubles {
  using Vector = __m256d;
  static constexpr std::size_t width = 4;
  TOUCHSTONE_TARGET static Vector broadcast(double x) { return _mm256_set1_pd(x); }
  TOUCHSTONE_TARGET static Vector load(const double* x) { return _mm256_loadu_pd(x); }
  TOUCHSTONE_TARGET static Vector greater(Vector a, Vector b) { return _mm256_max_pd(a, b); }
  TOUCHSTONE_TARGET static double greatest(Vector v) {
    return baseline::Doubles::greatest(
        _mm_max_pd(_mm256_castpd256_pd128(v), _mm256_extractf128_pd(v, 1)));
  }
  TOUCHSTONE_TARGET static unsigned equal(Vector a, Vector b) {
    return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_EQ_OQ)));
  }
};
#include "algorithms/kernels/hull_scan.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx2

namespace avx512 {
#define TOUCHSTONE_TARGET __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl")))
struct Floats {
  using Vector = __m512;
  static constexpr std::size_t width = 16;
  TOUCHSTONE_TARGET static Vector broadcast(float x) { return _mm512_set1_ps(x); }
  TOUCHSTONE_TARGET static Vector load(const float* x) { return _mm512_loadu_ps(x); }
  TOUCHSTONE_TARGET static Vector greater(Vector a, Vector b) { return _mm512_max_ps(a, b); }
  TOUCHSTONE_TARGET static float greatest(Vector v) {
    return avx2::Floats::greatest(
        _mm256_max_ps(_mm512_castps512_ps256(v), _mm512_extractf32x8_ps(v, 1)));
  }
  TOUCHSTONE_TARGET static unsigned equal(Vector a, Vector b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ);
  }
};
struct Doubles {
  using Vector = __m512d;
  static constexpr std::size_t width = 8;
  TOUCHSTONE_TARGET static Vector broadcast(double x) { return _mm512_set1_pd(x); }
  TOUCHSTONE_TARGET static Vector load(const double* x) { return _mm512_loadu_pd(x); }
  TOUCHSTONE_TARGET static Vector greater(Vector a, Vector b) { return _mm512_max_pd(a, b); }
  TOUCHSTONE_TARGET static double greatest(Vector v) {
    return avx2::Doubles::greatest(
        _mm256_max_pd(_mm512_castpd512_pd256(v), _mm512_extractf64x4_pd(v, 1)));
  }
  TOUCHSTONE_TARGET static unsigned equal(Vector a, Vector b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ);
  }
};
#include "algorithms/kernels/hull_scan.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx512
#else
namespace baseline {
#define TOUCHSTONE_TARGET
template <class Scalar>
struct Single {
  using Vector = Scalar;
  static constexpr std::size_t width = 1;
  static Vector broadcast(Scalar x) { return x; }
  static Vector load(const Scalar* x) { return *x; }
  static Vector greater(Vector a, Vector b) { return a > b ? a : b; }
  static Scalar greatest(Vector v) { return v; }
  static unsigned equal(Vector a, Vector b) { return a == b ? 1 : 0; }
};
using Floats = Single<float>;
using Doubles = Single<double>;
#include "algorithms/kernels/hull_scan.inl"
#undef TOUCHSTONE_TARGET
}  // namespace baseline
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif

// At the level in use.
template <class Scalar>
std::uint32_t furthest(std::span<const VertexBlock<Scalar>> blocks, const Vec3<Scalar>& direction);

extern template std::uint32_t furthest(std::span<const VertexBlock<float>>, const Vec3<float>&);
extern template std::uint32_t furthest(std::span<const VertexBlock<double>>, const Vec3<double>&);

}  // namespace touchstone::hull_scan
