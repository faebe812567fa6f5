// Part of sat: stores and tests the axis of cached_axis.h.
#include "algorithms/narrow_phase/sat/cached_axis.h"

#include <cmath>

#include "algorithms/kernels/sat/box_box.h"

namespace touchstone {
namespace {

template <class Scalar>
std::array<float, 3> seen_by(const PlacedPolytope<Scalar>& body, const Vec3<Scalar>& normal) {
  const Vec3<float> own = (body.matrix.transpose() * normal).template cast<float>();
  return {own.x(), own.y(), own.z()};
}

// Returns a unit vector, or zero if the numbers hold no direction.
template <class Scalar>
Vec3<Scalar> in_world(const PlacedPolytope<Scalar>& body, const std::array<float, 3>& own) {
  const Vec3<Scalar> normal =
      body.matrix * Vec3<float>{own[0], own[1], own[2]}.template cast<Scalar>();
  const Scalar length = normal.norm();
  const bool usable = length > Scalar{0.125} && length < Scalar{8};
  return usable ? Vec3<Scalar>(normal / length) : Vec3<Scalar>::Zero();
}

}  // namespace

template <class Scalar>
void CachedAxis::keep(const PolytopePair<Scalar>& pair, const Vec3<Scalar>& normal) {
  if (seen == Seen::not_at_all) seen = Seen::by_a;
  of_a = seen_by(pair.a(), normal);
  of_b = seen_by(pair.b(), normal);
}

template <class Scalar>
bool CachedAxis::separates(const PolytopePair<Scalar>& pair, bool boxes, Axis<Scalar>& axis,
                           int& tested) {
  if (seen != Seen::by_a && seen != Seen::by_b) return false;
  for (int attempt = 0; attempt < 2; ++attempt) {
    const bool by_a = seen == Seen::by_a;
    const Vec3<Scalar> normal = by_a ? in_world(pair.a(), of_a) : in_world(pair.b(), of_b);
    if (!normal.isZero(0)) {
      ++tested;
      axis = boxes ? box_axis_along(pair, normal) : pair.axis_along(normal);
      if (pair.separates(axis)) {
        if (by_a) {
          of_b = seen_by(pair.b(), normal);
        } else {
          of_a = seen_by(pair.a(), normal);
        }
        return true;
      }
    }
    seen = by_a ? Seen::by_b : Seen::by_a;
  }
  return false;
}

template void CachedAxis::keep(const PolytopePair<float>&, const Vec3<float>&);
template void CachedAxis::keep(const PolytopePair<double>&, const Vec3<double>&);
template bool CachedAxis::separates(const PolytopePair<float>&, bool, Axis<float>&, int&);
template bool CachedAxis::separates(const PolytopePair<double>&, bool, Axis<double>&, int&);

}  // namespace touchstone
