// Part of sat: the axis that separated two polytopes in the previous frame; it is tested first.
// Includes kernels/sat.
//
// The axis is stored in the coordinates of each body, so that a face normal stays a face normal as
// the body rotates. Any axis with a gap proves that the bodies are apart, so a wrong axis costs
// only its test.
// Paper:   Gregorius, "The Separating Axis Test between Convex Polyhedra", GDC 2013 (the axis of
//          the previous frame).
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/kernels/sat/separating_axis.h"

namespace touchstone {

struct CachedAxis {
  enum class Seen : std::uint32_t { not_at_all, by_a, by_b };

  Seen seen = Seen::not_at_all;         // the body whose coordinates separated last; zero: no axis
  std::array<float, 3> of_a{}, of_b{};  // body coordinates, from a to b

  template <class Scalar>
  void keep(const PolytopePair<Scalar>& pair, const Vec3<Scalar>& normal);
  // Returns true and sets `axis` if a stored axis separates. Adds the number of tested axes to
  // `tested`.
  template <class Scalar>
  bool separates(const PolytopePair<Scalar>& pair, bool boxes, Axis<Scalar>& axis, int& tested);
};

extern template void CachedAxis::keep(const PolytopePair<float>&, const Vec3<float>&);
extern template void CachedAxis::keep(const PolytopePair<double>&, const Vec3<double>&);
extern template bool CachedAxis::separates(const PolytopePair<float>&, bool, Axis<float>&, int&);
extern template bool CachedAxis::separates(const PolytopePair<double>&, bool, Axis<double>&, int&);

}  // namespace touchstone
