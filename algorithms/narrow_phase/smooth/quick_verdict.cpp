// Gauges, support points and planes of quick_verdict.h.
#include "algorithms/narrow_phase/smooth/quick_verdict.h"

#include <algorithm>
#include <cmath>

#include "algorithms/narrow_phase/smooth/smooth_pair.h"

namespace touchstone {
namespace {

// Parts of a length by which a plane must be beyond a body, and lines in bodies must overlap: far
// above rounding, and above what a matrix is off a rotation.
constexpr double plane_margin = 1e-13, gauge_margin = 1e-11;

// A direction in the axes of a core, and how far the core reaches along it, times its length.
struct Sight {
  Vec3d along;
  double flat = 0;  // the length of the part across z, where the core has a disc
  double height = 0;
};

Sight look(const RoundShape& body, const Vec3d& d) {
  Sight sight{.along = d};
  switch (body.core) {
    case SupportCore::point: break;
    case SupportCore::segment: sight.height = body.z * std::abs(d.z()); break;
    case SupportCore::cylinder:
      sight.flat = std::sqrt(d.x() * d.x() + d.y() * d.y());
      sight.height = body.x * sight.flat + body.z * std::abs(d.z());
      break;
    case SupportCore::cone:
      sight.flat = std::sqrt(d.x() * d.x() + d.y() * d.y());
      sight.height = std::max(body.x * sight.flat - body.z * d.z(), body.z * d.z());
      break;
    default: {
      const double x = body.x * d.x(), y = body.y * d.y(), z = body.z * d.z();
      sight.height = std::sqrt(x * x + y * y + z * z);
    }
  }
  return sight;
}

// The factor by which the body grows around its middle until the vector from there ends on its
// surface, or more. `length` is the vector's.
double gauge(const RoundShape& body, const Sight& sight, double length) {
  const Vec3d& d = sight.along;
  switch (body.core) {
    case SupportCore::point: return length * body.per_x;
    // A capsule has a ball and a cylinder inside.
    case SupportCore::segment: {
      const double flat = std::sqrt(d.x() * d.x() + d.y() * d.y());
      return std::min(length * body.per_x,
                      std::max(flat * body.per_x, std::abs(d.z()) * body.per_z));
    }
    case SupportCore::cylinder:
      return std::max(sight.flat * body.per_x, std::abs(d.z()) * body.per_z);
    case SupportCore::cone: {
      const double rise = d.z() * body.per_z;
      return std::max(-2 * rise, (2.0 / 3) * (2 * sight.flat * body.per_x + rise));
    }
    default: {
      const double x = d.x() * body.per_x, y = d.y() * body.per_y, z = d.z() * body.per_z;
      return std::sqrt(x * x + y * y + z * z);
    }
  }
}

// The point of the core that is furthest in the direction, in body coordinates.
Vec3d furthest(const RoundShape& body, const Sight& sight) {
  const Vec3d& d = sight.along;
  const double rim = sight.flat > 1e-150 ? body.x / sight.flat : 0;
  switch (body.core) {
    case SupportCore::point: return Vec3d::Zero();
    case SupportCore::segment: return {0, 0, std::copysign(body.z, d.z())};
    case SupportCore::cylinder: return {rim * d.x(), rim * d.y(), std::copysign(body.z, d.z())};
    case SupportCore::cone:
      if (2 * body.z * d.z() > body.x * sight.flat) return {0, 0, body.z};
      return {rim * d.x(), rim * d.y(), -body.z};
    default: {
      if (!(sight.height > 1e-150)) return Vec3d::Zero();
      const double scale = 1 / sight.height;
      return {scale * body.x * body.x * d.x(), scale * body.y * body.y * d.y(),
              scale * body.z * body.z * d.z()};
    }
  }
}

// Returns true if no entry of a matrix is far above those of a rotation, so that the margins hold.
bool is_bounded(const Mat3d& m) { return m.squaredNorm() < 3.1; }

double sum_of_sizes(const Vec3d& v) { return std::abs(v.x()) + std::abs(v.y()) + std::abs(v.z()); }

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
  const auto has_gauge = [](double length) { return length > 1e-150 && length < 1e150; };
  is_solid = has_gauge(x) && (shape.kind == ShapeKind::sphere || (has_gauge(y) && has_gauge(z)));
  size = x + y + z + radius;
  middle = core == SupportCore::cone ? -z / 2 : 0;
  per_x = 1 / x;
  per_y = 1 / y;
  per_z = 1 / z;
}

QuickVerdict quick_verdict(const RoundShape& a, const Pose& pose_a, const RoundShape& b,
                           const Pose& pose_b) {
  constexpr int most_planes = 3;
  const Vec3d offset = pose_b.translation - pose_a.translation;
  const double radius = a.radius + b.radius;
  const double least = plane_margin * (sum_of_sizes(offset) + a.size + b.size);
  QuickVerdict found;
  if (!is_bounded(pose_a.rotation) || !is_bounded(pose_b.rotation)) return found;
  Vec3d normal = offset;
  if (a.middle != 0) normal -= a.middle * pose_a.rotation.col(2);
  if (b.middle != 0) normal += b.middle * pose_b.rotation.col(2);
  Vec3d last = normal;
  for (;;) {
    ++found.planes;
    const double greatest = sum_of_sizes(normal);
    // Lengths with squares outside of these may have lost digits.
    if (!(greatest > 1e-130) || !(greatest < 1e130)) return found;
    const Sight to_a = look(a, pose_a.rotation.transpose() * normal);
    const Sight to_b = look(b, -(pose_b.rotation.transpose() * normal));
    const double length = radius > 0 || found.planes == 1 ? std::sqrt(normal.squaredNorm()) : 0;
    const double gap =
        normal.dot(offset) - (to_a.height + to_b.height + radius * length) - least * greatest;
    if (gap > 0) {
      found.answer = Answer::separated;
      found.normal = normal;
      found.gap = gap;
      return found;
    }
    if (found.planes == 1) {
      if (!is_rotation(pose_a.rotation) || !is_rotation(pose_b.rotation)) return found;
      if (a.is_solid && b.is_solid) {
        const double of_a = gauge(a, to_a, length), of_b = gauge(b, to_b, length);
        if (of_a * of_b < (of_a + of_b) * (1 - gauge_margin)) {
          found.answer = Answer::overlapping;
          return found;
        }
      }
    }
    if (found.planes == most_planes) return found;
    const Vec3d between =
        offset + (pose_b.rotation * furthest(b, to_b) - pose_a.rotation * furthest(a, to_a));
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
