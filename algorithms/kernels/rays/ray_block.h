// Up to sixteen rays in the frame of a tree, side by side: what is calculated once a ray is
// calculated in lanes.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "algorithms/kernels/rays/ray_mesh.h"
#include "algorithms/ray_cast.h"

namespace touchstone::ray_tree {

// In the frame a ray is origin + tau * direction. The direction's greatest component is 1 in magnitude,
// and the origin of a ray that begins far away has been moved to where the ray comes near the mesh.
// tau = t * per_t - moved. Where rounding could lose a box, the box is met: origins of planes differ for
// the near and the far ones by more than all errors of the ray's origin.
struct alignas(64) RayBlock {
  static constexpr std::size_t most = 16;
  template <class Number>
  using Each = std::array<Number, most>;

  std::size_t count = 0;
  // The rays that the numbers below are right for, as bits. Others are improper, have a t_max below
  // zero, or begin so far from the mesh (2^30 times its size) that doubles are too coarse.
  unsigned usable = 0;

  // The rays as they are cast, and their axes in the order x, y, z.
  std::array<Each<double>, 3> from, direction;
  Each<double> t_max;

  // For boxes.
  std::array<Each<float>, 3> near_origin, far_origin, inverse;
  std::array<unsigned, 3> backward;  // the rays that meet upper planes first, as bits

  // For triangles: the axes with the direction's greatest last; rays on them, as they are cast and in
  // the frame; and the shear.
  Each<std::uint32_t> greatest;
  std::array<Each<double>, 3> turned_from, turned_direction;
  std::array<Each<float>, 3> origin;
  Each<float> shear_x, shear_y, sign_z;
  // Bounds on the rounding of a sheared coordinate, and of a triangle's tau.
  Each<float> off, tau_off;
  // Nothing is at t or before it from tau_end on; all t between sure_begin and sure_end are within the
  // ray.
  Each<float> tau_end, sure_begin, sure_end;
  Each<double> per_t, moved;

  bool is_usable(std::size_t ray) const { return (usable >> ray & 1) != 0; }
  std::array<std::size_t, 3> axes(std::size_t ray) const {
    constexpr std::array<std::array<std::size_t, 3>, 3> turned = {
        {{1, 2, 0}, {2, 0, 1}, {0, 1, 2}}};
    return turned[greatest[ray]];
  }
  // A tau, rounded up, beyond which nothing is at t or before it.
  float tau_end_of(std::size_t ray, double t) const;
};

}  // namespace touchstone::ray_tree
