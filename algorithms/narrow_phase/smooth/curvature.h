// Part of smooth: the curvature of a support function. Includes core.
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone {

// A symmetric matrix: the Hessian of a support function, which is zero along its normal.
struct Curvature {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(double weight, const Vec3d& v) {
    const Vec3d w = weight * v;
    xx += w.x() * v.x();
    xy += w.x() * v.y();
    xz += w.x() * v.z();
    yy += w.y() * v.y();
    yz += w.y() * v.z();
    zz += w.z() * v.z();
  }
  Vec3d operator*(const Vec3d& v) const {
    return {xx * v.x() + xy * v.y() + xz * v.z(), xy * v.x() + yy * v.y() + yz * v.z(),
            xz * v.x() + yz * v.y() + zz * v.z()};
  }
  double trace() const { return xx + yy + zz; }
  // The determinant across the normal.
  double minors() const { return (xx * yy - xy * xy) + (xx * zz - xz * xz) + (yy * zz - yz * yz); }
};

}  // namespace touchstone
