// The memory of GJK for a pair of bodies, from one frame to the next. Used by gjk, gjk-lanes,
// ellipsoid and smooth.
//
// Corners are stored by their indices, so that their points follow the bodies. Whatever the
// indices, these are points of the difference, and a result from them is as right as from any other
// start. The plane that parted the bodies is carried by both (carried_plane.h).
// Paper:   van den Bergen, "A fast and robust GJK implementation for collision detection of convex
//          objects", J. Graphics Tools 4(2), 1999 (the next frame begins at the last separating
//          axis or simplex).
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/kernels/gjk/carried_plane.h"
#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

// One layout serves both scalars. All zeros mean that nothing is known.
struct WarmStart {
  struct Corners {
    std::uint16_t a, b;
  };
  CarriedPlane plane;
  std::uint32_t size = 0;  // corners of the last simplex; 0: unknown, or round cores
  // Four corners if the origin was inside.
  std::array<Corners, 4> corners{};

  // Keeps the corners, unless one has no index or one of more than 16 bits.
  template <class Scalar>
  void keep(const Simplex<Scalar>& simplex);

  // Places the simplex at its corners' current positions. Its size is 0 if there is none or if the
  // indices do not belong to these cores.
  template <class Scalar>
  void place(SupportPair<Scalar>& pair, Simplex<Scalar>& simplex) const;
};

// Appends the point of two corners of the cores.
template <class Scalar>
void place_corner(SupportPair<Scalar>& pair, const CornerPair& corners, Simplex<Scalar>& simplex) {
  const Vec3<Scalar> on_a = pair.a().corner(corners.a);
  const Vec3<Scalar> on_b = pair.b().corner(corners.b) + pair.centre_b();
  const auto place = static_cast<std::size_t>(simplex.size++);
  simplex.points[place] = {on_a - on_b, on_a, on_b};
  simplex.corners[place] = corners;
}

// Greatest distance of a point of the body from its origin, in metres.
template <class Scalar>
double radius_of(const SupportShape<Scalar>& shape) {
  return shape.centre.norm() + shape.size + shape.radius;
}

// What the frame before left for a query.
template <class Scalar>
struct LastFrame {
  const WarmStart& kept;
  Vec3<Scalar> direction;  // the carried plane's normal in the world: unit length, or zero
};

extern template void WarmStart::keep(const Simplex<float>&);
extern template void WarmStart::keep(const Simplex<double>&);
extern template void WarmStart::place(SupportPair<float>&, Simplex<float>&) const;
extern template void WarmStart::place(SupportPair<double>&, Simplex<double>&) const;

}  // namespace touchstone
