// The function attributes of each level of vector instructions, and the intrinsics. Used by every
// file that compiles loops for more than one level.
#pragma once

#if defined(__x86_64__)
#pragma GCC diagnostic push
#if !defined(__clang__)
// GCC 12 warns of the header's own undefined vectors.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
#include <immintrin.h>
#pragma GCC diagnostic pop
#endif

#define TOUCHSTONE_TARGET_AVX2 __attribute__((target("avx2")))
#define TOUCHSTONE_TARGET_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,bmi2")))

// Threads interact in one way at every level, so ThreadSanitizer checks one level.
#if defined(__SANITIZE_THREAD__)
#define TOUCHSTONE_ONE_LEVEL
#endif
// The widest vectors differ from the next only in their number of lanes, and take the longest to
// check.
#if defined(__SANITIZE_ADDRESS__)
#define TOUCHSTONE_TWO_LEVELS
#endif

// Inlines all calls of a function, so that they are compiled for the function's own level. Under a
// sanitizer that code would be many times as long, and is not inlined.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TOUCHSTONE_FLATTEN
#else
#define TOUCHSTONE_FLATTEN __attribute__((flatten))
#endif
