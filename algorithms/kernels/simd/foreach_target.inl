// Loops over box_lanes.h, or over the lanes of the namespace TOUCHSTONE_LANES where that is set;
// TOUCHSTONE_LOOPS by their file's name, once for each level of vector instructions: in the
// namespaces baseline, avx2 and avx512, with TOUCHSTONE_TARGET set to the level's attribute. Where
// TOUCHSTONE_ONE_LEVEL is set, all three are the first; with TOUCHSTONE_TWO_LEVELS the third is the
// second.

#ifndef TOUCHSTONE_LANES
#define TOUCHSTONE_LANES box_lanes
#endif

namespace baseline {
using namespace TOUCHSTONE_LANES::baseline;
#define TOUCHSTONE_TARGET
#include TOUCHSTONE_LOOPS
#undef TOUCHSTONE_TARGET
}  // namespace baseline

#if defined(__x86_64__) && !defined(TOUCHSTONE_ONE_LEVEL)
namespace avx2 {
using namespace TOUCHSTONE_LANES::avx2;
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX2
#include TOUCHSTONE_LOOPS
#undef TOUCHSTONE_TARGET
}  // namespace avx2

#if defined(TOUCHSTONE_TWO_LEVELS)
namespace avx512 = avx2;
#else
namespace avx512 {
using namespace TOUCHSTONE_LANES::avx512;
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX512
#include TOUCHSTONE_LOOPS
#undef TOUCHSTONE_TARGET
}  // namespace avx512
#endif
#else
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif

#undef TOUCHSTONE_LOOPS
#undef TOUCHSTONE_LANES
