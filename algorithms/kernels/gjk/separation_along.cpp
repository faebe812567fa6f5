// The gap between two bodies along a direction: calls the copy of separation_at
// (separation_along.inl) that is compiled for this processor.
#include "algorithms/kernels/gjk/separation_along.h"

#include <cmath>

#include "algorithms/kernels/minkowski/hull_scan.h"

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_NAMESPACE hull_scan
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/gjk/separation_along.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

template <class Scalar>
Scalar separation_along(SupportPair<Scalar>& pair, const Vec3<Scalar>& direction) {
  pair.count_support();
  switch (isa()) {
    case Isa::avx512: return avx512::separation_at(pair, direction);
    case Isa::avx2: return avx2::separation_at(pair, direction);
    default: return baseline::separation_at(pair, direction);
  }
}

template float separation_along(SupportPair<float>&, const Vec3<float>&);
template double separation_along(SupportPair<double>&, const Vec3<double>&);

}  // namespace touchstone
