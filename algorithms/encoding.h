// The encoding in which an algorithm gets a pair of bodies, and so the exact problem against which
// its own arithmetic is judged.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

enum class Encoding : std::uint8_t {
  as_given,          // doubles as given; any later rounding is the algorithm's own error
  float32,           // each number of the shapes and of the poses rounded to float; the normal of a
                     // half-space has been made unit in double
  relative,          // doubles after a subtraction: hulls are about the mean of their vertices, and
                     // the pair is about the first body's centre (offset_between)
  float32_relative,  // relative, and then each number rounded to float
  quaternion,        // the rotation turned into a quaternion in double (to_quaternion)
  quaternion_float32,  // float32, and then the rotation turned into a quaternion in float
};
inline constexpr std::array<Encoding, 6> all_encodings = {
    Encoding::as_given,         Encoding::float32,    Encoding::relative,
    Encoding::float32_relative, Encoding::quaternion, Encoding::quaternion_float32};

inline std::string_view to_string(Encoding encoding) {
  switch (encoding) {
    case Encoding::as_given: return "as_given";
    case Encoding::float32: return "float32";
    case Encoding::relative: return "relative";
    case Encoding::float32_relative: return "float32_relative";
    case Encoding::quaternion: return "quaternion";
    case Encoding::quaternion_float32: return "quaternion_float32";
  }
  return "?";
}

// The conversions in doubles. Adapters and the checker both use these, so that the exact problem
// has the very bits that the library got.

// Returns the mean of a hull's vertices, or the origin of any other shape; body coordinates.
inline Vec3d encoding_centre(const Shape& shape) {
  Vec3d centre = Vec3d::Zero();
  if (shape.kind != ShapeKind::hull) return centre;
  const std::vector<Vec3d>& vertices = shape.hull->vertices;
  for (const Vec3d& v : vertices) centre += v / static_cast<double>(vertices.size());
  return centre;
}

// Returns the vector from the centre of a to that of b, in world axes, and sets `origin` to the
// centre of a in the world.
inline Vec3d offset_between(const Pose& pose_a, const Vec3d& centre_a, const Pose& pose_b,
                            const Vec3d& centre_b, Vec3d& origin) {
  origin = pose_a(centre_a);
  return pose_b(centre_b) - origin;
}

// The half-space n.x <= offset with n of about unit length, always computed by these operations.
struct UnitHalfspace {
  Vec3d normal;
  double offset;

  explicit UnitHalfspace(const Shape& shape);
};

// Returns the rotation as a quaternion, which is not normalised.
template <class Scalar>
Eigen::Quaternion<Scalar> to_quaternion(const Mat3<Scalar>& rotation) {
  return Eigen::Quaternion<Scalar>(rotation);
}

}  // namespace touchstone
