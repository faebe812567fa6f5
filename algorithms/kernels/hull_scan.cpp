#include "algorithms/kernels/hull_scan.h"

namespace touchstone::hull_scan {

template <class Scalar>
std::uint32_t furthest(std::span<const VertexBlock<Scalar>> blocks, const Vec3<Scalar>& direction) {
  switch (isa()) {
    case Isa::avx512: return avx512::furthest(blocks, direction);
    case Isa::avx2: return avx2::furthest(blocks, direction);
    default: return baseline::furthest(blocks, direction);
  }
}

template std::uint32_t furthest(std::span<const VertexBlock<float>>, const Vec3<float>&);
template std::uint32_t furthest(std::span<const VertexBlock<double>>, const Vec3<double>&);

}  // namespace touchstone::hull_scan
