// The function attributes of each level of vector instructions, and the intrinsics.
#pragma once

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

// What threads do to each other is the same at every level: their sanitizer is shown one.
#if defined(__SANITIZE_THREAD__)
#define TOUCHSTONE_ONE_LEVEL
#endif
// The widest vectors differ from the next by their number of lanes alone, and take longest to
// check.
#if defined(__SANITIZE_ADDRESS__)
#define TOUCHSTONE_TWO_LEVELS
#endif

// Inlines all that a function calls, so that it is compiled for the function's own level; not where
// a sanitizer makes that code many times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TOUCHSTONE_FLATTEN
#else
#define TOUCHSTONE_FLATTEN __attribute__((flatten))
#endif
