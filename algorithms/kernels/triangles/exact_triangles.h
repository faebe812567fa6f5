// Triangles in integers: whether two of them share a point. Used where doubles prove nothing.
// Source: the signs of volumes and areas as in Guigue, Devillers, "Fast and robust
//         triangle-triangle overlap test using orientation predicates", JGT 8, 2003; the test by
//         edges is our own.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <span>

#include "algorithms/core/pose.h"

namespace touchstone {

// Of any length; up to 1,024 bits need no heap memory.
using ExactInteger = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<1024, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked,
                                           std::allocator<boost::multiprecision::limb_type>>,
    boost::multiprecision::et_off>;
using ExactPoint = std::array<ExactInteger, 3>;

// A point of a body and its body's pose, in which every number is taken literally: rotation times
// point plus translation.
struct PlacedPoint {
  const Vec3d* point;
  const Pose* pose;
};

// Writes the world coordinates of all points as integers times one power of two, so that signs of
// volumes, areas and differences are those of the exact points. All numbers are finite.
void place_exactly(std::span<const PlacedPoint> points, ExactPoint* placed);

using ExactTriangle = std::array<ExactPoint, 3>;

// True if the closed triangles share a point. Both may be degenerate.
bool share_a_point(const ExactTriangle& a, const ExactTriangle& b);

// The sign of the volume of the tetrahedron a b c d.
int volume_sign(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& d);

using TriangleCorners = std::array<Vec3d, 3>;  // in body coordinates

// The same for triangles of two placed bodies.
bool share_a_point(const TriangleCorners& a, const Pose& pose_a, const TriangleCorners& b,
                   const Pose& pose_b);

}  // namespace touchstone
