// Selects the instruction level for the loops in face_planes.inl.
#include "algorithms/kernels/epa/face_planes.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/minkowski/simplex.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone::face_planes {
namespace {

using simd::Quad;

// Rounding r of the corners tilts a plane by r / h, where h is the triangle's least height. The
// nearest point moves accordingly, and its distance changes by r^2 / h^2. That is a sixteenth of
// the rounding if h^2 has this value.
template <class Scalar>
constexpr Scalar uncertain = 16 * SupportPair<Scalar>::rounding;

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/epa/face_planes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

template <class Scalar>
ConePlanes<Scalar>::ConePlanes(std::size_t most) {
  for (auto* column : {&x, &y, &z, &distance, &key, &margin}) column->resize(most + overhang);
}

template <class Scalar>
int least_key(std::span<const Block<Scalar>> blocks) {
  switch (isa()) {
    case Isa::avx512: return avx512::least_key_at(blocks);
    case Isa::avx2: return avx2::least_key_at(blocks);
    default: return baseline::least_key_at(blocks);
  }
}

template <class Scalar>
void seen_from(std::span<const Block<Scalar>> blocks, const Vec3<Scalar>& point, Scalar above,
               std::uint64_t* seen) {
  switch (isa()) {
    case Isa::avx512: return avx512::seen_from_at(blocks, point, above, seen);
    case Isa::avx2: return avx2::seen_from_at(blocks, point, above, seen);
    default: return baseline::seen_from_at(blocks, point, above, seen);
  }
}

template <class Scalar>
bool planes_through(const Cone<Scalar>& cone, Scalar inside, Scalar furthest,
                    ConePlanes<Scalar>& planes) {
  // Rings are short: with more than eight lanes most would be empty.
  constexpr bool is_wide = avx2::Simd<Scalar>::width >= 8;
  const Isa level = isa();
  switch (is_wide && level == Isa::avx512 ? Isa::avx2 : level) {
    case Isa::avx512: return avx512::planes_through_at(cone, inside, furthest, planes);
    case Isa::avx2: return avx2::planes_through_at(cone, inside, furthest, planes);
    default: return baseline::planes_through_at(cone, inside, furthest, planes);
  }
}

template struct ConePlanes<float>;
template struct ConePlanes<double>;
template int least_key(std::span<const Block<float>>);
template int least_key(std::span<const Block<double>>);
template void seen_from(std::span<const Block<float>>, const Vec3<float>&, float, std::uint64_t*);
template void seen_from(std::span<const Block<double>>, const Vec3<double>&, double,
                        std::uint64_t*);
template bool planes_through(const Cone<float>&, float, float, ConePlanes<float>&);
template bool planes_through(const Cone<double>&, double, double, ConePlanes<double>&);

}  // namespace touchstone::face_planes
