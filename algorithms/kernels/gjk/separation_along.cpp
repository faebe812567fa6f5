// Selects the instruction level for the gap in separation_along.inl.
#include "algorithms/kernels/gjk/separation_along.h"

#include <cmath>

#include "algorithms/kernels/minkowski/hull_scan.h"

namespace touchstone {
namespace {

#define TOUCHSTONE_LANES hull_scan
#define TOUCHSTONE_LOOPS "algorithms/kernels/gjk/separation_along.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

template <class Scalar>
Scalar gap_along(SupportPair<Scalar>& pair, const Vec3<Scalar>& direction) {
  pair.count_support();
  switch (isa()) {
    case Isa::avx512: return avx512::gap_at(pair, direction);
    case Isa::avx2: return avx2::gap_at(pair, direction);
    default: return baseline::gap_at(pair, direction);
  }
}

template float gap_along(SupportPair<float>&, const Vec3<float>&);
template double gap_along(SupportPair<double>&, const Vec3<double>&);

}  // namespace touchstone
