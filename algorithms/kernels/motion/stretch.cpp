// Selects the level of vector instructions of stretch.inl.
#include "algorithms/kernels/motion/stretch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

// Four numbers fill no wider vectors.
#if !defined(TOUCHSTONE_TWO_LEVELS)
#define TOUCHSTONE_TWO_LEVELS
#define TOUCHSTONE_STRETCH_HAS_TWO_LEVELS
#endif
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

using simd::Quad;

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/motion/stretch.inl"
#include "algorithms/kernels/simd/foreach_target.inl"
#if defined(TOUCHSTONE_STRETCH_HAS_TWO_LEVELS)
#undef TOUCHSTONE_TWO_LEVELS
#undef TOUCHSTONE_STRETCH_HAS_TWO_LEVELS
#endif

}  // namespace

Stretch stretch_of(const Pose& pose) {
  return isa() == Isa::baseline ? baseline::stretch_at(pose) : avx2::stretch_at(pose);
}

}  // namespace touchstone
