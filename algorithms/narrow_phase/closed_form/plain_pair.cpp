// The nearest points of points, segments, boxes, cylinders and cones. plain_core.h proves the answers.
#include "algorithms/narrow_phase/closed_form/plain_pair.h"

#include <algorithm>
#include <cmath>

#include "algorithms/narrow_phase/closed_form/plain_core.h"

namespace touchstone {
namespace {

using namespace plain;

// `centre` is that of core b, here and below.
Nearest of_points(const Vec& centre, double size) {
  return {{0, 0, 0}, centre, centre, dot(centre, centre), 0, size};
}

// A point and the segment around `centre` with this half.
Nearest of_point_and_segment(const Vec& centre, const Vec& half, double size) {
  const double square = dot(half, half);
  const double t = square > 0 ? clamp(-dot(centre, half) / square, -1, 1) : 0;
  const Vec point = centre + t * half;
  return {{0, 0, 0}, point, point, dot(point, centre), std::abs(dot(point, half)), size};
}

// The segments of these halves, one around the origin, one around `centre` (Ericson, Real-Time
// Collision Detection, 2005, section 5.1.9). Divisions do not wait for one another.
Nearest of_segments(const Vec& half_a, const Vec& centre, const Vec& half_b, double size) {
  const double aa = dot(half_a, half_a), bb = dot(half_b, half_b), ab = dot(half_a, half_b);
  const double ac = dot(half_a, centre), bc = dot(half_b, centre);
  const double over_aa = aa > 0 ? 1 / aa : 0, over_bb = bb > 0 ? 1 / bb : 0;
  const double determinant = aa * bb - ab * ab;
  const double over = determinant > 1e-12 * aa * bb ? 1 / determinant : 0;
  double s = clamp((ac * bb - ab * bc) * over, -1, 1);
  const double t = clamp((s * ab - bc) * over_bb, -1, 1);
  s = clamp((t * ab + ac) * over_aa, -1, 1);
  const Vec on_a = s * half_a, on_b = centre + t * half_b;
  const Vec between = on_b - on_a;
  return {on_a,
          on_b,
          between,
          dot(between, centre),
          std::abs(dot(between, half_a)) + std::abs(dot(between, half_b)),
          size};
}

// A point and the box around `centre`.
Nearest of_point_and_box(const Vec& centre, const Mat3d& matrix, const Vec3d& half, double size) {
  const Vec x = column(matrix, 0), y = column(matrix, 1), z = column(matrix, 2);
  const auto local = [&](const Vec& axis, int k) {
    return clamp(-dot(axis, centre), -half[k], half[k]);
  };
  const Vec point = centre + local(x, 0) * x + local(y, 1) * y + local(z, 2) * z;
  const double extent = half[0] * std::abs(dot(point, x)) + half[1] * std::abs(dot(point, y)) +
                        half[2] * std::abs(dot(point, z));
  return {{0, 0, 0}, point, point, dot(point, centre), extent, size};
}

// A point and the cylinder or cone around `centre`: the nearest place is in the half plane through the
// point and the axis, in a rectangle or a triangle.
Nearest of_point_and_revolved(const Vec& centre, const Mat3d& matrix, const Shape& solid,
                              double size) {
  const Vec x = column(matrix, 0), y = column(matrix, 1), z = column(matrix, 2);
  const double at_x = -dot(x, centre), at_y = -dot(y, centre), at_z = -dot(z, centre);
  const double radius = solid.radius, half = solid.half_length;
  const double from_axis = std::sqrt(at_x * at_x + at_y * at_y), from_rim = from_axis - radius;
  const double from_base = at_z + half;
  const bool cone = solid.kind == ShapeKind::cone;
  double out = std::min(from_axis, radius), up = clamp(at_z, -half, half);
  const bool nearest_on_slant =
      from_base < 0 ? from_rim > 0 : 2 * half * from_rim + radius * from_base > 0;
  if (cone && nearest_on_slant) {
    // This part of the way from the rim to the tip.
    const double square = radius * radius + 4 * half * half;
    const double along = 2 * half * from_base - radius * from_rim;
    const double part = square > 0 ? clamp(along / square, 0, 1) : 0;
    out = (1 - part) * radius;
    up = (2 * part - 1) * half;
  }
  const double inward = from_axis > out ? out / from_axis : 1;
  const Vec point = centre + inward * at_x * x + inward * at_y * y + up * z;
  const double along_x = dot(point, x), along_y = dot(point, y), along_z = dot(point, z);
  const double round = radius * std::sqrt(along_x * along_x + along_y * along_y);
  const double extent =
      cone ? std::max(half * along_z + round, -half * along_z) : half * std::abs(along_z) + round;
  return {{0, 0, 0}, point, point, dot(point, centre), extent, size};
}

// Whether a ball around the origin meets the box around `centre`: in the box's own axes, which must
// be those of a rotation up to `skew`. `unknown` if they are not, or rounding leaves it open.
Answer ball_meets_box(double radius, const Vec& centre, const Mat3d& matrix, const Vec3d& half) {
  constexpr double skew = 1e-14;
  const Vec x = column(matrix, 0), y = column(matrix, 1), z = column(matrix, 2);
  const double off = std::max(std::max(std::max(std::abs(dot(x, x) - 1), std::abs(dot(y, y) - 1)),
                                       std::max(std::abs(dot(z, z) - 1), std::abs(dot(x, y)))),
                              std::max(std::abs(dot(y, z)), std::abs(dot(z, x))));
  const auto beyond = [&](const Vec& axis, int k) {
    return std::max(std::abs(dot(axis, centre)) - half[k], 0.0);
  };
  const Vec out{beyond(x, 0), beyond(y, 1), beyond(z, 2)};
  const double square = dot(out, out);
  const double size = std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z) + half[0] +
                      half[1] + half[2] + radius;
  const double error = (rounding + 8 * skew) * size;
  const double inner = radius - error, outer = radius + error;
  const bool in_range = size > 1e-130 && size < 1e130 && off <= skew;
  if (in_range && square > outer * outer) return Answer::separated;
  if (in_range && inner > 0 && square < inner * inner) return Answer::overlapping;
  return Answer::unknown;
}

constexpr int of_kinds(ShapeKind a, ShapeKind b) {
  return 8 * static_cast<int>(a) + static_cast<int>(b);
}

}  // namespace

bool solve_plain_pair(Task task, const Shape& a, const Pose& pose_a, const Shape& b,
                      const Pose& pose_b, Outcome& outcome, double margin) {
  const Vec centre = read(pose_b.translation) - read(pose_a.translation);
  const double size = length(centre);
  switch (of_kinds(a.kind, b.kind)) {
    case of_kinds(ShapeKind::sphere, ShapeKind::sphere):
      return answer(task, margin, of_points(centre, size), a.radius, b.radius, pose_a, outcome);
    case of_kinds(ShapeKind::sphere, ShapeKind::capsule): {
      const Vec half = half_of(b, pose_b);
      return answer(task, margin, of_point_and_segment(centre, half, size + length(half)), a.radius,
                    b.radius, pose_a, outcome);
    }
    case of_kinds(ShapeKind::sphere, ShapeKind::box): {
      if (task == Task::intersect) {
        const Answer found = ball_meets_box(a.radius, centre, pose_b.rotation, b.half_extents);
        if (found != Answer::unknown) write(found, outcome);
        if (found != Answer::unknown) return true;
      }
      const double extent = b.half_extents.sum() * pose_b.rotation.cwiseAbs().maxCoeff();
      return answer(task, margin,
                    of_point_and_box(centre, pose_b.rotation, b.half_extents, size + extent),
                    a.radius, 0, pose_a, outcome);
    }
    case of_kinds(ShapeKind::sphere, ShapeKind::cylinder):
    case of_kinds(ShapeKind::sphere, ShapeKind::cone): {
      const double extent = (2 * b.radius + b.half_length) * pose_b.rotation.cwiseAbs().maxCoeff();
      return answer(task, margin, of_point_and_revolved(centre, pose_b.rotation, b, size + extent),
                    a.radius, 0, pose_a, outcome);
    }
    case of_kinds(ShapeKind::capsule, ShapeKind::capsule): {
      const Vec half_a = half_of(a, pose_a), half_b = half_of(b, pose_b);
      return answer(task, margin,
                    of_segments(half_a, centre, half_b, size + length(half_a) + length(half_b)),
                    a.radius, b.radius, pose_a, outcome);
    }
    default: return false;
  }
}

}  // namespace touchstone
