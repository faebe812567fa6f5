// Compiles the loops in the file TOUCHSTONE_TARGET_INCLUDE once for each level of vector
// instructions: in the namespaces baseline, avx2 and avx512, each with that level's names from the
// namespace TOUCHSTONE_TARGET_NAMESPACE (simd by default), and with TOUCHSTONE_TARGET set to the
// level's attribute. TOUCHSTONE_ONE_LEVEL makes all three the first; TOUCHSTONE_TWO_LEVELS makes
// the third the second; TOUCHSTONE_NO_BASELINE leaves the first out, on x86-64 alone.

#ifndef TOUCHSTONE_TARGET_NAMESPACE
#define TOUCHSTONE_TARGET_NAMESPACE simd
#endif

#if !defined(TOUCHSTONE_NO_BASELINE)
namespace baseline {
using namespace TOUCHSTONE_TARGET_NAMESPACE::baseline;
#define TOUCHSTONE_TARGET
#include TOUCHSTONE_TARGET_INCLUDE
#undef TOUCHSTONE_TARGET
}  // namespace baseline
#endif

#if defined(__x86_64__) && !defined(TOUCHSTONE_ONE_LEVEL)
namespace avx2 {
using namespace TOUCHSTONE_TARGET_NAMESPACE::avx2;
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX2
#include TOUCHSTONE_TARGET_INCLUDE
#undef TOUCHSTONE_TARGET
}  // namespace avx2

#if defined(TOUCHSTONE_TWO_LEVELS)
namespace avx512 = avx2;
#else
namespace avx512 {
using namespace TOUCHSTONE_TARGET_NAMESPACE::avx512;
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX512
#include TOUCHSTONE_TARGET_INCLUDE
#undef TOUCHSTONE_TARGET
}  // namespace avx512
#endif
#else
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif

#undef TOUCHSTONE_TARGET_INCLUDE
#undef TOUCHSTONE_TARGET_NAMESPACE
