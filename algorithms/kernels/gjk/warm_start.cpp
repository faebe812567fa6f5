// Stores a simplex by corner indices, and places it at the bodies' new poses.
#include "algorithms/kernels/gjk/warm_start.h"

#include <limits>

namespace touchstone {

template <class Scalar>
void WarmStart::keep(const Simplex<Scalar>& simplex) {
  constexpr std::uint32_t greatest = std::numeric_limits<std::uint16_t>::max();
  size = static_cast<std::uint32_t>(simplex.size);
  for (std::size_t i = 0; i < size; ++i) {
    const auto [a, b] = simplex.corners[i];
    if (a > greatest || b > greatest) {
      size = 0;
      return;
    }
    corners[i] = {static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b)};
  }
}

template <class Scalar>
void WarmStart::place(SupportPair<Scalar>& pair, Simplex<Scalar>& simplex) const {
  simplex.size = 0;
  if (size == 0 || size > 4) return;
  for (std::size_t i = 0; i < size; ++i) {
    if (!pair.a().has_corner(corners[i].a) || !pair.b().has_corner(corners[i].b)) return;
  }
  for (std::size_t i = 0; i < size; ++i) {
    place_corner(pair, {corners[i].a, corners[i].b}, simplex);
  }
}

template void WarmStart::keep(const Simplex<float>&);
template void WarmStart::keep(const Simplex<double>&);
template void WarmStart::place(SupportPair<float>&, Simplex<float>&) const;
template void WarmStart::place(SupportPair<double>&, Simplex<double>&) const;

}  // namespace touchstone
