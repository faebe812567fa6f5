// Gauges, support points and planes of quick_verdict.h.
#include "algorithms/narrow_phase/smooth/quick_verdict.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

// Parts of a length by which a plane must be beyond a body, and lines in bodies must overlap: far
// above rounding, and above what a matrix is off a rotation.
constexpr double plane_margin = 1e-13, gauge_margin = 1e-11;

// The factor by which the body grows until the vector ends on its surface, or more.
double gauge(const RoundShape& body, const Vec3d& d, double length) {
  const double flat = std::sqrt(d.x() * d.x() + d.y() * d.y()), up = std::abs(d.z());
  switch (body.core) {
    case SupportCore::point: return length / body.radius;
    // A capsule has a ball and a cylinder inside.
    case SupportCore::segment:
      return std::min(length / body.radius, std::max(flat / body.radius, up / body.z));
    case SupportCore::cylinder: return std::max(flat / body.x, up / body.z);
    case SupportCore::cone: {
      const double rise = d.z() / body.z;
      return std::max(-rise, 2 * flat / body.x + rise);
    }
    default: {
      const double x = d.x() / body.x, y = d.y() / body.y, z = d.z() / body.z;
      return std::sqrt(x * x + y * y + z * z);
    }
  }
}

// The point of the core that is furthest along d, in body coordinates.
Vec3d furthest(const RoundShape& body, const Vec3d& d) {
  const double flat = std::sqrt(d.x() * d.x() + d.y() * d.y());
  const double rim = flat > 1e-150 ? body.x / flat : 0;
  switch (body.core) {
    case SupportCore::point: return Vec3d::Zero();
    case SupportCore::segment: return {0, 0, std::copysign(body.z, d.z())};
    case SupportCore::cylinder: return {rim * d.x(), rim * d.y(), std::copysign(body.z, d.z())};
    case SupportCore::cone:
      if (2 * body.z * d.z() > body.x * flat) return {0, 0, body.z};
      return {rim * d.x(), rim * d.y(), -body.z};
    default: {
      const Vec3d w(body.x * d.x(), body.y * d.y(), body.z * d.z());
      const double reach = std::sqrt(w.squaredNorm());
      if (!(reach > 1e-150)) return Vec3d::Zero();
      return Vec3d(body.x * w.x(), body.y * w.y(), body.z * w.z()) / reach;
    }
  }
}

}  // namespace

RoundShape::RoundShape(const Shape& shape)
    : core(SupportCore::point),
      x(shape.radius),
      y(shape.radius),
      z(shape.half_length),
      radius(shape.kind <= ShapeKind::capsule ? shape.radius : 0) {
  switch (shape.kind) {
    case ShapeKind::capsule: core = SupportCore::segment; break;
    case ShapeKind::cylinder: core = SupportCore::cylinder; break;
    case ShapeKind::cone: core = SupportCore::cone; break;
    case ShapeKind::ellipsoid:
      core = SupportCore::ellipsoid;
      x = shape.radii.x();
      y = shape.radii.y();
      z = shape.radii.z();
      break;
    default: break;
  }
  is_solid = shape.kind == ShapeKind::sphere ? x > 0 : x > 0 && y > 0 && z > 0;
}

QuickVerdict quick_verdict(const RoundShape& a, const Pose& pose_a, const RoundShape& b,
                           const Pose& pose_b) {
  constexpr int most_planes = 3;
  const Vec3d centre = pose_b.translation - pose_a.translation;
  const double radius = a.radius + b.radius;
  QuickVerdict found;
  Vec3d normal = centre, last = centre;
  for (;;) {
    ++found.planes;
    const Vec3d to_a = pose_a.rotation.transpose() * normal;
    const Vec3d to_b = -(pose_b.rotation.transpose() * normal);
    const Vec3d p = furthest(a, to_a), q = furthest(b, to_b);
    const double length = std::sqrt(normal.squaredNorm());
    const double along = normal.dot(centre);
    const double reach = p.dot(to_a) + q.dot(to_b) + radius * length;
    // Lengths with squares outside of these may have lost digits.
    if (!(length > 1e-130) || !(length < 1e130)) return found;
    const double lost =
        plane_margin * length *
        (std::sqrt(centre.squaredNorm()) + a.x + a.y + a.z + b.x + b.y + b.z + radius);
    if (along - reach > lost) {
      found.answer = Answer::separated;
      return found;
    }
    if (found.planes == 1 && a.is_solid && b.is_solid) {
      const double of_a = gauge(a, to_a, length), of_b = gauge(b, to_b, length);
      if (of_a * of_b < (of_a + of_b) * (1 - gauge_margin)) {
        found.answer = Answer::overlapping;
        return found;
      }
    }
    if (found.planes == most_planes) return found;
    const Vec3d between = centre + (pose_b.rotation * q - pose_a.rotation * p);
    normal = between;
    if (found.planes > 1) {
      // The point of the segment from `last` to `between` that is nearest to the origin.
      const Vec3d edge = between - last;
      const double part = -last.dot(edge) / edge.squaredNorm();
      if (part > 0 && part < 1) normal = last + part * edge;
    }
    last = between;
  }
}

}  // namespace touchstone
