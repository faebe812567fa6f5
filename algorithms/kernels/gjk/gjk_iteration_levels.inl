// Selects the active level of vector instructions for the iteration of gjk_iteration.h, compiled
// for two given cores or for any. Included by gjk_iteration.cpp and gjk-templated; local to each.
#include <cmath>
#include <limits>

#include "algorithms/kernels/gjk/gjk_iteration.h"

namespace touchstone {
namespace {

using real_lanes::Quad;

constexpr unsigned all_corners = 0xf;

#define TOUCHSTONE_LANES hull_scan
#define TOUCHSTONE_LOOPS "algorithms/kernels/gjk/gjk_iteration.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

template <bool numbered, class WhichA, class WhichB, class Scalar>
Walk<Scalar> walk_here(SupportPair<Scalar>& pair, const WalkGoal& goal, Scalar tolerance,
                       const WalkStart<Scalar>& start) {
  Walk<Scalar> found;
  switch (isa()) {
    case Isa::avx512:
      avx512::walk_at<numbered, WhichA, WhichB>(pair, goal, tolerance, start, found);
      break;
    case Isa::avx2:
      avx2::walk_at<numbered, WhichA, WhichB>(pair, goal, tolerance, start, found);
      break;
    default: baseline::walk_at<numbered, WhichA, WhichB>(pair, goal, tolerance, start, found);
  }
  return found;
}

}  // namespace

}  // namespace touchstone
