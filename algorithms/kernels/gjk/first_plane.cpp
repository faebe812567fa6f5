// Selects the level of vector instructions of first_plane.inl.
#include "algorithms/kernels/gjk/first_plane.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "algorithms/kernels/minkowski/hull_scan.h"

namespace touchstone {
namespace {

using simd::Quad;

#define TOUCHSTONE_TARGET_NAMESPACE hull_scan
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/gjk/first_plane.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

template <class Scalar>
FirstPlane first_plane(const CentreOffset& offset, const SupportShape<Scalar>& a,
                       const Pose& pose_a, const SupportShape<Scalar>& b, const Pose& pose_b) {
  switch (isa()) {
    case Isa::avx512: return avx512::first_plane_at(offset, a, pose_a, b, pose_b);
    case Isa::avx2: return avx2::first_plane_at(offset, a, pose_a, b, pose_b);
    case Isa::baseline: break;
  }
  return baseline::first_plane_at(offset, a, pose_a, b, pose_b);
}

template FirstPlane first_plane(const CentreOffset&, const SupportShape<float>&, const Pose&,
                                const SupportShape<float>&, const Pose&);
template FirstPlane first_plane(const CentreOffset&, const SupportShape<double>&, const Pose&,
                                const SupportShape<double>&, const Pose&);

}  // namespace touchstone
