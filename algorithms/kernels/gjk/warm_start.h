// What GJK keeps of a pair of bodies from one frame to the next, and what it makes of it.
//
// Corners are kept by their numbers, so that the points made of them are where the bodies are now:
// whatever the numbers, they are points of the difference, and what is found from them is as right
// as from any other start. The same for a direction: any plane that has the difference on its far
// side proves that the bodies are apart.
// Paper: van den Bergen, "A fast and robust GJK implementation for collision detection of convex
// objects", J. Graphics Tools 4(2), 1999 (the last separating axis, and the last simplex, are where
// the next frame begins).
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

// The same for both scalars; all zeros: nothing is known.
struct WarmStart {
  std::uint32_t size = 0;  // corners of the last simplex; 0: not known, or round cores
  // Four, where the origin was inside.
  std::array<CornerPair, 4> corners;
  std::array<float, 3> direction{};  // from a to b, world axes, unit length; zero: not known

  template <class Scalar>
  void keep(const Simplex<Scalar>& simplex, const Vec3<Scalar>& unit_direction);

  // Puts the simplex where its corners are now; of size 0 where there is none, or it is not one of
  // these cores.
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
