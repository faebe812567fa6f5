// The axis that separated two polytopes in the frame before, to be tried first.
//
// It is kept as each body sees it: where it is a face's normal, it goes on being that as the body
// turns. Any axis along which there is a gap proves the bodies apart, so a wrong one costs its test
// and nothing else.
// Paper: Gregorius, "The Separating Axis Test between Convex Polyhedra", GDC 2013 (the axis of the
// frame before).
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/kernels/sat/separating_axis.h"

namespace touchstone {

struct CachedAxis {
  enum class Seen : std::uint32_t { not_at_all, by_a, by_b };

  Seen seen = Seen::not_at_all;  // whose view held the last time it was tried; zero: nothing known
  std::array<float, 3> of_a{}, of_b{};  // body coordinates, from a to b

  template <class Scalar>
  void keep(const PolytopePair<Scalar>& pair, const Vec3<Scalar>& normal);
  // True where an axis separates, which is then `axis`. `tested` is raised by the number of axes.
  template <class Scalar>
  bool separates(const PolytopePair<Scalar>& pair, bool boxes, Axis<Scalar>& axis, int& tested);
};

extern template void CachedAxis::keep(const PolytopePair<float>&, const Vec3<float>&);
extern template void CachedAxis::keep(const PolytopePair<double>&, const Vec3<double>&);
extern template bool CachedAxis::separates(const PolytopePair<float>&, bool, Axis<float>&, int&);
extern template bool CachedAxis::separates(const PolytopePair<double>&, bool, Axis<double>&, int&);

}  // namespace touchstone
