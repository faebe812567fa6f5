// Selects the instruction level for the hull scan.
#include "algorithms/kernels/minkowski/hull_scan.h"

namespace touchstone::hull_scan {

template <class Scalar>
std::uint32_t furthest(const ScannedHull<Scalar>& hull, const Vec3<Scalar>& direction) {
  const Scalar x = direction.x(), y = direction.y(), z = direction.z();
  switch (isa()) {
    case Isa::avx512: return avx512::furthest_index(hull, x, y, z);
    case Isa::avx2: return avx2::furthest_index(hull, x, y, z);
    default: return baseline::furthest_index(hull, x, y, z);
  }
}

template <class Scalar>
Scalar greatest(std::span<const VertexBlock<Scalar>> blocks, const Vec3<Scalar>& direction) {
  const Scalar x = direction.x(), y = direction.y(), z = direction.z();
  switch (isa()) {
    case Isa::avx512: return avx512::furthest_at(blocks, x, y, z).value;
    case Isa::avx2: return avx2::furthest_at(blocks, x, y, z).value;
    default: return baseline::furthest_at(blocks, x, y, z).value;
  }
}

template std::uint32_t furthest(const ScannedHull<float>&, const Vec3<float>&);
template std::uint32_t furthest(const ScannedHull<double>&, const Vec3<double>&);
template float greatest(std::span<const VertexBlock<float>>, const Vec3<float>&);
template double greatest(std::span<const VertexBlock<double>>, const Vec3<double>&);

}  // namespace touchstone::hull_scan
