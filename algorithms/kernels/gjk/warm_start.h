// The memory of GJK for a pair of bodies, from one frame to the next. Used by gjk.
//
// Corners are stored by their indices, so that their points follow the bodies. Whatever the
// indices, these are points of the difference, and a result from them is as right as from any other
// start. The same holds for a direction: any plane with the difference on its far side proves that
// the bodies are apart.
// Paper:   van den Bergen, "A fast and robust GJK implementation for collision detection of convex
//          objects", J. Graphics Tools 4(2), 1999 (the next frame begins at the last separating
//          axis or simplex).
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

// One layout serves both scalars. All zeros mean that nothing is known.
struct WarmStart {
  std::uint32_t size = 0;  // corners of the last simplex; 0: unknown, or round cores
  // Four corners if the origin was inside.
  std::array<CornerPair, 4> corners;
  std::array<float, 3> direction{};  // from a to b, world axes, unit length; zero: unknown

  template <class Scalar>
  void keep(const Simplex<Scalar>& simplex, const Vec3<Scalar>& unit_direction);

  // Places the simplex at its corners' current positions. Its size is 0 if there is none or if the
  // indices do not belong to these cores.
  template <class Scalar>
  void place(SupportPair<Scalar>& pair, Simplex<Scalar>& simplex) const;
  // Unit length, or zero.
  template <class Scalar>
  Vec3<Scalar> unit_direction() const;
};

extern template void WarmStart::keep(const Simplex<float>&, const Vec3<float>&);
extern template void WarmStart::keep(const Simplex<double>&, const Vec3<double>&);
extern template void WarmStart::place(SupportPair<float>&, Simplex<float>&) const;
extern template void WarmStart::place(SupportPair<double>&, Simplex<double>&) const;
extern template Vec3<float> WarmStart::unit_direction() const;
extern template Vec3<double> WarmStart::unit_direction() const;

}  // namespace touchstone
