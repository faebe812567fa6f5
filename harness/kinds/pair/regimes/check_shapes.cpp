// Draws random shapes of every kind.
#include "harness/kinds/pair/regimes/check_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/reproducible_math.h"

namespace touchstone::kinds {
namespace {

Shape hull_shape(std::shared_ptr<const Hull> hull) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::move(hull);
  return shape;
}

Shape random_halfspace(const ShapeStyle& style, base::Random& random) {
  Shape shape;
  shape.kind = ShapeKind::halfspace;
  const double length = random.below(2) == 0 ? 1 : random.magnitude(0.1, 10);
  if (random.below(2) == 0) {
    shape.normal = length * random.on_sphere();
  } else {
    shape.normal = Vec3d::Zero();
    shape.normal[static_cast<int>(random.below(3))] = random.below(2) == 0 ? length : -length;
  }
  if (random.below(2) == 0) shape.offset = length * style.size * random.uniform(-1, 1);
  return shape;
}

}  // namespace

Vec3d random_sides(const ShapeStyle& style, base::Random& random) {
  const double longest = style.size * random.uniform(0.5, 1);
  std::array<double, 3> half = {longest, longest * random.uniform(0.25, 1),
                                longest * random.uniform(0.25, 1)};
  if (style.form == Proportions::needle) half[1] /= style.aspect;
  if (style.form != Proportions::compact) half[2] /= style.aspect;
  for (std::size_t i = 2; i > 0; --i) std::swap(half[i], half[random.below(i + 1)]);
  return {half[0], half[1], half[2]};
}

ShapeKind random_kind(base::Random& random) {
  constexpr std::array<std::pair<ShapeKind, std::uint64_t>, 7> weights = {
      {{ShapeKind::box, 25},
       {ShapeKind::hull, 25},
       {ShapeKind::sphere, 14},
       {ShapeKind::capsule, 14},
       {ShapeKind::cylinder, 8},
       {ShapeKind::cone, 7},
       {ShapeKind::ellipsoid, 7}}};
  std::uint64_t draw = random.below(100);
  for (const auto& [kind, weight] : weights) {
    if (draw < weight) return kind;
    draw -= weight;
  }
  return ShapeKind::box;
}

Shape random_shape(ShapeKind kind, const ShapeStyle& style, std::uint64_t seed,
                   base::Random& random) {
  Shape shape;
  shape.kind = kind;
  switch (kind) {
    case ShapeKind::sphere: shape.radius = style.size * random.uniform(0.5, 1); return shape;
    case ShapeKind::hull: {
      const std::uint64_t entries =
          style.form == Proportions::compact && style.size == 1 ? 160 : 48;
      return hull_shape(pooled_hull(seed, random.below(entries), style));
    }
    case ShapeKind::halfspace: return random_halfspace(style, random);
    default: break;
  }
  const Vec3d half = random_sides(style, random);
  const double least = half.minCoeff(), greatest = half.maxCoeff();
  const double middle =
      std::max(std::min(half.x(), half.y()), std::min(std::max(half.x(), half.y()), half.z()));
  switch (kind) {
    case ShapeKind::box: shape.half_extents = half; break;
    case ShapeKind::ellipsoid: shape.radii = half; break;
    case ShapeKind::capsule:
      shape.radius = least;
      shape.half_length = greatest - least;
      break;
    default:  // cylinder, cone
      shape.radius = style.form == Proportions::needle ? least : middle;
      shape.half_length = style.form == Proportions::plate ? least : greatest;
      break;
  }
  return shape;
}

Shape mirrored(const Shape& hull) { return hull_shape(mirrored_hull(*hull.hull)); }

Shape box_as_hull(const Vec3d& half_extents) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back(
        half_extents.cwiseProduct(Vec3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  }
  return hull_of(std::move(points));
}

Vec3d inner_point(const Shape& shape) {
  if (shape.kind == ShapeKind::cone) return {0, 0, -shape.half_length / 2};
  if (shape.kind != ShapeKind::hull) return Vec3d::Zero();
  Vec3d sum = Vec3d::Zero();
  for (const Vec3d& v : shape.hull->vertices) sum += v;
  return sum / static_cast<double>(shape.hull->vertices.size());
}

double support_value(const Shape& shape, const Vec3d& n) {
  const double norm = base::length(n);
  const double disc = shape.radius * std::sqrt(n.x() * n.x() + n.y() * n.y());
  const double along = shape.half_length * std::abs(n.z());
  switch (shape.kind) {
    case ShapeKind::sphere: return shape.radius * norm;
    case ShapeKind::capsule: return along + shape.radius * norm;
    case ShapeKind::box: return base::inner(n.cwiseAbs(), shape.half_extents);
    case ShapeKind::cylinder: return along + disc;
    case ShapeKind::cone:
      return std::max(shape.half_length * n.z(), disc - shape.half_length * n.z());
    case ShapeKind::ellipsoid: return base::length(n.cwiseProduct(shape.radii));
    case ShapeKind::hull: {
      double greatest = -std::numeric_limits<double>::infinity();
      for (const Vec3d& v : shape.hull->vertices) greatest = std::max(greatest, base::inner(n, v));
      return greatest;
    }
    case ShapeKind::halfspace: break;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace touchstone::kinds
