// Moves a body near the origin and to unit size, exactly.
#include "harness/proxies/local_body.h"

#include <algorithm>
#include <cmath>

#include "algorithms/core/bounds.h"

namespace touchstone::proxies {
namespace {

Vec3d scaled(const Vec3d& v, int exponent) {
  return {std::ldexp(v.x(), exponent), std::ldexp(v.y(), exponent), std::ldexp(v.z(), exponent)};
}

Vec3d half_extents(const Shape& s) {
  switch (s.kind) {
    case ShapeKind::sphere: return Vec3d::Constant(s.radius);
    case ShapeKind::capsule:
      return {s.radius, s.radius, (s.half_length + s.radius) * (1 + epsilon)};
    case ShapeKind::cylinder:
    case ShapeKind::cone: return {s.radius, s.radius, s.half_length};
    case ShapeKind::box: return s.half_extents;
    case ShapeKind::ellipsoid: return s.radii;
    default: return Vec3d::Zero();
  }
}

// The exponent that scales to about 1; 0 for a body without size.
int exponent_of(const Vec3d& v) {
  const double greatest = v.maxCoeff();
  return greatest > 0 ? std::ilogb(greatest) : 0;
}

}  // namespace

Shape scaled(Shape shape, int exponent) {
  shape.radius = std::ldexp(shape.radius, exponent);
  shape.half_length = std::ldexp(shape.half_length, exponent);
  shape.half_extents = scaled(shape.half_extents, exponent);
  shape.radii = scaled(shape.radii, exponent);
  if (shape.hull != nullptr) {
    auto hull = std::make_shared<Hull>(*shape.hull);
    for (Vec3d& v : hull->vertices) v = scaled(v, exponent);
    shape.hull = std::move(hull);
  }
  return shape;
}

LocalBody::LocalBody(const Shape& body, const geometry::Mesh* with) : has_mesh(with != nullptr) {
  if (body.kind != ShapeKind::hull) {
    half = half_extents(body);
    exponent_ = exponent_of(half);
    shape = scaled(body, -exponent_);
    half = half_extents(shape);
    size = half.norm() * (1 + 4 * epsilon);
    solid = half.minCoeff() > 0;
    return;
  }
  points = body.hull->vertices;
  if (has_mesh) points.insert(points.end(), with->vertices.begin(), with->vertices.end());
  Vec3d low = points.front(), high = low;
  for (const Vec3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3d extent = 0.5 * high - 0.5 * low;
  for (int k = 0; k < 3; ++k) {
    const double at = points.front()[k];
    if (std::abs(at) > 8 * extent[k]) shift_[k] = at;
  }
  exponent_ = exponent_of(extent) + 1;
  const auto local = [&](const Vec3d& p) { return scaled(Vec3d(p - shift_), -exponent_); };
  for (Vec3d& p : points) p = local(p);
  auto hull = std::make_shared<Hull>(*body.hull);
  for (Vec3d& v : hull->vertices) v = local(v);
  solid = hull->dimension == 3;
  shape = body;
  shape.hull = std::move(hull);
  if (has_mesh) {
    mesh.triangles = with->triangles;
    for (const Vec3d& v : with->vertices) mesh.vertices.push_back(local(v));
  }
  low = high = points.front();
  for (const Vec3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  middle = snap(0.5 * (low + high));
  // The exact difference is at most half a unit in the last place larger.
  half = (high - middle).cwiseMax(middle - low) * (1 + epsilon);
  for (const Vec3d& p : points) size = std::max(size, (p - middle).norm() * (1 + 8 * epsilon));
}

Vec3d LocalBody::snap(const Vec3d& centre) const {
  const Vec3d given = shift_ + scaled(centre, exponent_);
  return scaled(Vec3d(given - shift_), -exponent_);
}

Part LocalBody::placed(Part part) const {
  part.shape = scaled(std::move(part.shape), exponent_);
  part.pose.translation = shift_ + scaled(part.pose.translation, exponent_);
  return part;
}

Part LocalBody::localised(Part part) const {
  part.shape = scaled(std::move(part.shape), -exponent_);
  part.pose.translation = scaled(Vec3d(part.pose.translation - shift_), -exponent_);
  return part;
}

double LocalBody::length_as_given(double length) const { return std::ldexp(length, exponent_); }

}  // namespace touchstone::proxies
