// Part of closed-form: the signed gap of two cores, in any scalar. Includes kernels.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/core/vec.h"
#include "algorithms/kernels/sat/segment.h"

namespace touchstone {

// The relation of two cores (the bodies without their radii), relative to the centre of body a in
// the pair's unit. The gap is signed; on_b - on_a is gap * normal. It lies between the bounds,
// which differ by more than rounding only if a box's matrix is not a rotation.
template <class Scalar>
struct CoreGap {
  Scalar gap, lower, upper;
  Vec3<Scalar> normal;  // unit vector from a to b
  Vec3<Scalar> on_a, on_b;
};

template <class Scalar>
constexpr Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();

template <class Scalar>
Vec3<Scalar> part_across(const Vec3<Scalar>& v, const Vec3<Scalar>& along) {
  return v - v.dot(along) / along.squaredNorm() * along;
}

// Returns true if the directions of two segments differ by more than rounding.
template <class Scalar>
bool are_crossed(const Vec3<Scalar>& p, const Vec3<Scalar>& q) {
  return p.cross(q).norm() > rounding<Scalar> * p.norm() * q.norm();
}

// Returns a unit vector orthogonal to both segments, or to those that have a direction.
template <class Scalar>
Vec3<Scalar> across(const Vec3<Scalar>& p, const Vec3<Scalar>& q) {
  // The cross product of almost parallel vectors has an error along them.
  if (are_crossed(p, q)) return part_across<Scalar>(p.cross(q), p).normalized();
  const Vec3<Scalar>& longer = p.squaredNorm() < q.squaredNorm() ? q : p;
  return longer.squaredNorm() > 0 ? longer.unitOrthogonal() : Vec3<Scalar>::UnitX();
}

template <class Scalar>
CoreGap<Scalar> segment_gap(const Segment<Scalar>& a, const Segment<Scalar>& b) {
  const SegmentPoints<Scalar> closest = closest_points(a, b);
  const Vec3<Scalar> between = closest.second - closest.first;
  // The normal must be orthogonal to segments whose interior the points are in; rounding may tilt
  // it.
  const auto inside = [](Scalar s, const Segment<Scalar>& segment) {
    return s > 0 && s < 1 && segment.along.squaredNorm() > 0;
  };
  const bool inside_a = inside(closest.s, a), inside_b = inside(closest.t, b);
  Vec3<Scalar> normal = between;
  if (inside_a && inside_b && are_crossed(a.along, b.along)) {
    const Vec3<Scalar> direction = across(a.along, b.along);
    normal = between.dot(direction) * direction;
  } else if (inside_a) {
    normal = part_across(between, a.along);
  } else if (inside_b) {
    normal = part_across(between, b.along);
  }
  const Scalar length = normal.norm();
  normal = length > rounding<Scalar> ? Vec3<Scalar>(normal / length) : across(a.along, b.along);
  // If the points coincide, the direction's sign is arbitrary.
  if (normal.dot(between) < 0) normal = -normal;
  const Scalar gap = normal.dot(between);
  return {gap, gap, gap, normal, closest.first, closest.second};
}

// The gap between a point, body a's centre, and a box with these half extents around `centre`.
template <class Scalar>
CoreGap<Scalar> point_box_gap(const Vec3<Scalar>& centre, const Mat3<Scalar>& matrix,
                              const Vec3<Scalar>& half) {
  Mat3<Scalar> normals;  // cofactors: outward normals of the faces, up to their length
  for (int k = 0; k < 3; ++k) {
    normals.col(k) = matrix.col((k + 1) % 3).cross(matrix.col((k + 2) % 3));
  }
  const Scalar determinant = matrix.col(0).dot(normals.col(0));
  const Vec3<Scalar> point = -(normals.transpose() * centre) / determinant;
  const Vec3<Scalar> closest = point.cwiseMax(-half).cwiseMin(half);
  const Vec3<Scalar> outward = matrix * (point - closest);
  const Scalar distance = outward.norm();
  if (distance > 0) {
    const Vec3<Scalar> normal = -outward / distance;
    // If the matrix skews the box, `closest` is not the closest point, but it is in the box: its
    // distance bounds from above, the plane through it from below.
    const Scalar upper = std::max(distance, (centre + matrix * closest).norm());
    const Scalar lower = normal.dot(centre) - (matrix.transpose() * normal).cwiseAbs().dot(half);
    return {distance, std::min(distance, lower), upper,
            normal,   Vec3<Scalar>::Zero(),      distance * normal};
  }
  // The point is inside: the shortest way out is through the nearest face.
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  const Vec3<Scalar> none = Vec3<Scalar>::Zero();
  CoreGap<Scalar> best{-infinity, -infinity, -infinity, none, none, none};
  for (int k = 0; k < 3; ++k) {
    const Scalar length = normals.col(k).norm();
    const Scalar gap = (std::abs(point[k]) - half[k]) * std::abs(determinant) / length;
    if (!(gap > best.gap)) continue;
    const Scalar sign = (point[k] < 0) == (determinant < 0) ? Scalar{-1} : Scalar{1};
    best.gap = best.lower = best.upper = gap;
    best.normal = sign * normals.col(k) / length;
  }
  best.on_b = best.gap * best.normal;
  return best;
}

}  // namespace touchstone
