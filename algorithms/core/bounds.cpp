// The tight and loose boxes of bodies of each kind, rounded outward by a bound on the error.
#include "algorithms/core/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

Vec3d support_in_body(const Shape& s, const Vec3d& d) {
  const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
  const double across = std::sqrt(d.x() * d.x() + d.y() * d.y());
  const Vec3d rim =
      across > 0 ? Vec3d(s.radius * d.x() / across, s.radius * d.y() / across, 0) : Vec3d(0, 0, 0);
  switch (s.kind) {
    case ShapeKind::sphere: return s.radius * d.normalized();
    case ShapeKind::capsule:
      return s.radius * d.normalized() + Vec3d(0, 0, sign(d.z()) * s.half_length);
    case ShapeKind::box:
      return {sign(d.x()) * s.half_extents.x(), sign(d.y()) * s.half_extents.y(),
              sign(d.z()) * s.half_extents.z()};
    case ShapeKind::cylinder: return rim + Vec3d(0, 0, sign(d.z()) * s.half_length);
    case ShapeKind::cone: {
      const Vec3d tip(0, 0, s.half_length), base = rim - tip;
      return d.dot(tip) > d.dot(base) ? tip : base;
    }
    case ShapeKind::ellipsoid: {
      const Vec3d e = s.radii.cwiseProduct(d);
      const double length = e.norm();
      return length > 0 ? Vec3d(s.radii.cwiseProduct(e / length)) : Vec3d(0, 0, 0);
    }
    case ShapeKind::hull: {
      Vec3d best = s.hull->vertices[0];
      for (const Vec3d& v : s.hull->vertices) {
        if (d.dot(v) > d.dot(best)) best = v;
      }
      return best;
    }
    case ShapeKind::halfspace: break;
  }
  return Vec3d::Zero();
}

constexpr double inf = std::numeric_limits<double>::infinity();
// Each extent is a sum of at most four products of a few factors: fewer than 16 roundings, each of
// at most half an ulp of a partial sum, and each partial sum is at most the sum of magnitudes.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

// The length of a vector, without overflow. std::hypot is not used, because its last bit differs
// between platforms.
double length(const Vec3d& v) {
  const double greatest = v.cwiseAbs().maxCoeff();
  if (!(greatest > 0)) return 0;
  const Vec3d scaled = v / greatest;
  return greatest *
         std::sqrt(scaled.x() * scaled.x() + scaled.y() * scaled.y() + scaled.z() * scaled.z());
}

struct Interval {
  double low, high;
};

// The extent along a world axis of {row . x : x in the shape}, where row is that axis' row of the
// rotation. `magnitude` becomes a bound on the sum of magnitudes that went into it.
Interval extent(const Shape& shape, const Vec3d& row, double& magnitude) {
  const auto symmetric = [&](double half) {
    magnitude = half;
    return Interval{-half, half};
  };
  // The radius of a disc across the body's axis, along the world axis.
  const auto disc_extent = [&] { return shape.radius * length({row.x(), row.y(), 0}); };
  const double along = shape.half_length * row.z();
  switch (shape.kind) {
    case ShapeKind::sphere: return symmetric(shape.radius);
    case ShapeKind::capsule: return symmetric(std::abs(along) + shape.radius);
    case ShapeKind::box: return symmetric(row.cwiseAbs().dot(shape.half_extents));
    case ShapeKind::cylinder: return symmetric(std::abs(along) + disc_extent());
    case ShapeKind::ellipsoid: return symmetric(length(row.cwiseProduct(shape.radii)));
    case ShapeKind::cone: {
      const double disc = disc_extent();
      magnitude = std::abs(along) + disc;
      return {std::min(along, -along - disc), std::max(along, -along + disc)};
    }
    case ShapeKind::hull: {
      Interval range{inf, -inf};
      magnitude = 0;
      for (const Vec3d& vertex : shape.hull->vertices) {
        const double value = row.dot(vertex);
        range = {std::min(range.low, value), std::max(range.high, value)};
        magnitude = std::max(magnitude, row.cwiseAbs().dot(vertex.cwiseAbs()));
      }
      return range;
    }
    case ShapeKind::halfspace: break;
  }
  return {-inf, inf};
}

// The points are x = R p + t with n . p <= offset, so the half-space is cut along a world axis if
// and only if n is a multiple of that row of R; whatever R is. Asked for are multiples that are exact
// whatever the rounding: both along one axis of the body.
Aabb halfspace_box(const Shape& shape, const Pose& pose) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  Aabb box{{-infinite, -infinite, -infinite}, {infinite, infinite, infinite}};
  const auto is_along = [](const Vec3d& v, int k) {
    return v[k] != 0 && v[(k + 1) % 3] == 0 && v[(k + 2) % 3] == 0;
  };
  int along = 0;
  while (along < 3 && !is_along(shape.normal, along)) ++along;
  if (along == 3) return box;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d row = pose.rotation.row(axis);
    if (!is_along(row, along)) continue;
    const double ratio = shape.normal[along] / row[along], face = shape.offset / ratio;
    if (!std::isnormal(ratio)) continue;
    // A quotient that is no normal number is off by up to half the least number.
    const bool is_normal = shape.offset == 0 || std::isnormal(face);
    const double slack = rounding * (std::abs(face) + std::abs(pose.translation[axis])) +
                         (is_normal ? 0 : std::numeric_limits<double>::denorm_min());
    const double at = pose.translation[axis] + face;
    if (ratio > 0) box.max[axis] = round_up(at + slack);
    if (ratio < 0) box.min[axis] = round_down(at - slack);
  }
  return box;
}

Aabb bounded_box(const Shape& shape, const Pose& pose) {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    double magnitude = 0;
    const Interval range = extent(shape, pose.rotation.row(axis), magnitude);
    const double t = pose.translation[axis];
    const double slack =
        rounding * (magnitude + std::abs(t)) + std::numeric_limits<double>::denorm_min();
    box.min[axis] = round_down(t + range.low - slack);
    box.max[axis] = round_up(t + range.high + slack);
  }
  return box;
}

}  // namespace

Aabb tight_box(const Shape& shape, const Pose& pose) {
  return shape.kind == ShapeKind::halfspace ? halfspace_box(shape, pose) : bounded_box(shape, pose);
}

Aabb loose_box(double reach, const Vec3d& translation) {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const double t = translation[axis];
    const double slack = rounding * (reach + std::abs(t));
    box.min[axis] = round_down(t - reach - slack);
    box.max[axis] = round_up(t + reach + slack);
  }
  return box;
}

double loose_reach(const Shape& shape, const Mat3d& rotation) {
  double reach = 0;
  switch (shape.kind) {
    case ShapeKind::sphere: reach = shape.radius; break;
    case ShapeKind::capsule: reach = shape.half_length + shape.radius; break;
    case ShapeKind::box: reach = length(shape.half_extents); break;
    case ShapeKind::cylinder: reach = length({shape.half_length, shape.radius, 0}); break;
    case ShapeKind::cone: reach = length({shape.half_length, shape.radius, 0}); break;
    case ShapeKind::ellipsoid: reach = shape.radii.maxCoeff(); break;
    case ShapeKind::hull:
      for (const Vec3d& vertex : shape.hull->vertices) {
        reach = std::max(reach, length(vertex));
      }
      break;
    case ShapeKind::halfspace: return inf;
  }
  // |R|^2 is the greatest eigenvalue of R'R, which is at most 1 + |R'R - I|. The ball of a sphere
  // or capsule is not deformed by R, so its reach may be a little too great.
  const double stretch =
      std::sqrt(1 + (rotation.transpose() * rotation - Mat3d::Identity()).norm());
  return reach * stretch * (1 + rounding);
}

Vec3d support_point(const Shape& shape, const Pose& pose, const Vec3d& direction) {
  return pose(support_in_body(shape, pose.rotation.transpose() * direction));
}

}  // namespace touchstone
