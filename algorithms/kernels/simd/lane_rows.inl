// The numbers of pairs, one pair a lane, for casts in lanes. box_lanes.inl, round_lanes.inl and portal_lanes.inl
// include this file for each level of vector instructions.
#include "algorithms/kernels/simd/vector3.inl"

// A pair is a struct of doubles alone. Lanes without a pair repeat the last one.
template <class Pair, std::size_t numbers>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void load_rows(const Pair* pairs, std::size_t count,
                                                   double (&rows)[numbers][Simd<double>::width]) {
  static_assert(sizeof(Pair) == numbers * sizeof(double));
  for (std::size_t lane = 0; lane < Simd<double>::width; ++lane) {
    const auto* const from = reinterpret_cast<const double*>(pairs + std::min(lane, count - 1));
    for (std::size_t k = 0; k < numbers; ++k) rows[k][lane] = from[k];
  }
}

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<double> three_rows(
    const double (*rows)[Simd<double>::width]) {
  return {Simd<double>::load(rows[0]), Simd<double>::load(rows[1]), Simd<double>::load(rows[2])};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Simd<double>::Vector length_of(
    const Vector3<double>& v) {
  return Simd<double>::sqrt(dot<double>(v, v));
}
