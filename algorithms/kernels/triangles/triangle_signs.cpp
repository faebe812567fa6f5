// Fifteen signs in lanes: the bound on their rounding, and the choice of the instruction level.
//
// Let D be the greatest difference of two corners' coordinates on one axis, u half an epsilon, and
// every coordinate off by at most `error`. A difference is then off by at most e = 2 error + u D. A
// volume is the sum of three products of a difference and a number x y - z w of four differences.
// Such a number is at most 2 D^2, and off by at most 4 D e + 2 e^2 + 4 u D^2. A product is off by at
// most D (4 D e + 4 u D^2) + 2 D^2 e + 2 u D^3 and smaller terms, and two sums add 12 u D^3:
//     3 (6 D^2 e + 6 u D^3) + 12 u D^3 = 18 D^2 e + 30 u D^3 = 36 D^2 error + 48 u D^3.
// With the terms in e^2 that is at most 40 D^2 error + 64 u D^3 while e is below D / 10. The bound
// has 128 in place of 40, so that for any greater e it is above 6 D^3, which no volume exceeds. Its
// last term is for what underflows: that loses less than 1e-322 D, and where D is above 1e40 the
// other terms are far above it. NaN and infinity compare so that they leave the pair open.
#include "algorithms/kernels/triangles/triangle_signs.h"

#include <limits>

#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

struct VolumeBound {
  static constexpr double of_error = 128;
  static constexpr double of_rounding = 32 * std::numeric_limits<double>::epsilon();
  static constexpr double of_underflow = 1e-280;
};

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/triangles/triangle_signs.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

template <class Scalar>
bool compare(const TriangleBlockOf<Scalar>& a, unsigned lanes_a, const TriangleBlock& b,
             unsigned lanes_b, double error, BlockSigns& signs) {
  switch (isa()) {
    case Isa::avx512: return avx512::compare_blocks(a, lanes_a, b, lanes_b, error, signs);
    case Isa::avx2: return avx2::compare_blocks(a, lanes_a, b, lanes_b, error, signs);
    case Isa::baseline: break;
  }
  return baseline::compare_blocks(a, lanes_a, b, lanes_b, error, signs);
}
template bool compare(const FloatTriangleBlock&, unsigned, const TriangleBlock&, unsigned, double,
                      BlockSigns&);
template bool compare(const TriangleBlock&, unsigned, const TriangleBlock&, unsigned, double,
                      BlockSigns&);

}  // namespace touchstone
