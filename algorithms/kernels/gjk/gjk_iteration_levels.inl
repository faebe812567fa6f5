// Selects the active level of vector instructions for the iteration of gjk_iteration.h, compiled
// for two given cores or for any. Included by gjk_iteration.cpp and gjk-templated; local to each.
#include <cmath>
#include <limits>

#include "algorithms/kernels/gjk/gjk_iteration.h"

namespace touchstone {
namespace {

using simd::Quad;

constexpr unsigned all_corners = 0xf;

#define TOUCHSTONE_TARGET_NAMESPACE hull_scan
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/gjk/gjk_iteration.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

template <bool numbered, class CoreOfA, class CoreOfB, class Scalar>
FastGjkResult<Scalar> fast_gjk_at_level(SupportPair<Scalar>& pair, const FastGjkGoal& goal,
                                        Scalar tolerance, const FastGjkStart<Scalar>& start) {
  FastGjkResult<Scalar> found;
  switch (isa()) {
    case Isa::avx512:
      avx512::fast_gjk_at<numbered, CoreOfA, CoreOfB>(pair, goal, tolerance, start, found);
      break;
    case Isa::avx2:
      avx2::fast_gjk_at<numbered, CoreOfA, CoreOfB>(pair, goal, tolerance, start, found);
      break;
    default: baseline::fast_gjk_at<numbered, CoreOfA, CoreOfB>(pair, goal, tolerance, start, found);
  }
  return found;
}

}  // namespace

}  // namespace touchstone
