// Stores a simplex by corner indices, and places it at the bodies' new poses.
#include "algorithms/kernels/gjk/warm_start.h"

#include <cmath>

namespace touchstone {

template <class Scalar>
void WarmStart::keep(const Simplex<Scalar>& simplex, const Vec3<Scalar>& unit_direction) {
  size = static_cast<std::uint32_t>(simplex.size);
  for (int i = 0; i < simplex.size; ++i) {
    corners[i] = simplex.corners[i];
    if (corners[i].a == no_corner || corners[i].b == no_corner) size = 0;
  }
  for (int axis = 0; axis < 3; ++axis) direction[axis] = static_cast<float>(unit_direction[axis]);
}

template <class Scalar>
void WarmStart::place(SupportPair<Scalar>& pair, Simplex<Scalar>& simplex) const {
  simplex.size = 0;
  if (size == 0 || size > 4) return;
  for (std::uint32_t i = 0; i < size; ++i) {
    if (!pair.a().has_corner(corners[i].a) || !pair.b().has_corner(corners[i].b)) return;
  }
  for (std::uint32_t i = 0; i < size; ++i) {
    const Vec3<Scalar> on_a = pair.a().corner(corners[i].a);
    const Vec3<Scalar> on_b = pair.b().corner(corners[i].b) + pair.centre_b();
    simplex.points[i] = {on_a - on_b, on_a, on_b};
    simplex.corners[i] = corners[i];
  }
  simplex.size = static_cast<int>(size);
}

template <class Scalar>
Vec3<Scalar> WarmStart::unit_direction() const {
  const Vec3<Scalar> kept{static_cast<Scalar>(direction[0]), static_cast<Scalar>(direction[1]),
                          static_cast<Scalar>(direction[2])};
  const Scalar squared = kept.squaredNorm();
  const bool usable = squared > Scalar{0.5} && squared < Scalar{2};
  return usable ? Vec3<Scalar>(kept / std::sqrt(squared)) : Vec3<Scalar>::Zero();
}

template void WarmStart::keep(const Simplex<float>&, const Vec3<float>&);
template void WarmStart::keep(const Simplex<double>&, const Vec3<double>&);
template void WarmStart::place(SupportPair<float>&, Simplex<float>&) const;
template void WarmStart::place(SupportPair<double>&, Simplex<double>&) const;
template Vec3<float> WarmStart::unit_direction() const;
template Vec3<double> WarmStart::unit_direction() const;

}  // namespace touchstone
