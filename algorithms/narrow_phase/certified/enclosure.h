// Part of certified: whether EPA's surface encloses the origin, whatever rounding did to its
// corners. Includes kernels and this folder.
//
// Where the determinant of a face's corners is positive, the face has a positive solid angle seen
// from the origin. If all faces of a closed surface do, it goes around the origin.
#pragma once

#include <array>
#include <limits>

#include "algorithms/kernels/epa/epa_hull.h"
#include "algorithms/narrow_phase/certified/proven_rounding.h"

namespace touchstone {

// Returns true if the determinant of three corners is positive beyond rounding. Each corner is off by
// `off`, which enters with the areas of the other two and the origin, and the products are off by 10
// half epsilons of |p| |q| |r|.
template <class Real>
bool is_surely_behind(const std::array<Vec3<Real>, 3>& corners, Real off) {
  const auto& [p, q, r] = corners;
  const Vec3<Real> across = q.cross(r);
  const Real areas = p.cross(q).norm() + across.norm() + r.cross(p).norm();
  const Real size_p = p.norm(), size_q = q.norm(), size_r = r.norm();
  constexpr Real rounding = 8 * std::numeric_limits<Real>::epsilon();
  const Real doubt = off * areas + rounding * size_p * size_q * size_r +
                     16 * off * off * (size_p + size_q + size_r);
  return p.dot(across) > doubt;
}

// The same for support points of a pair, which are off by 107 half epsilons: see proven_rounding.
inline bool is_surely_behind(const std::array<Vec3d, 3>& corners) {
  return is_surely_behind(corners, 0.5 * proven_rounding);
}

// The surface must be one that expand() left.
inline bool surely_encloses_origin(const EpaHull<double>& surface) {
  return surface.all_faces(
      [&](int face) { return is_surely_behind(surface.points(surface.corners(face))); });
}

}  // namespace touchstone
