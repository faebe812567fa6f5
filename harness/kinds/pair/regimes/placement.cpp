// Places two bodies at a given gap or depth, with extended precision.
#include "harness/kinds/pair/regimes/features.h"

#include <algorithm>
#include <cmath>

#include "harness/base/reproducible_math.h"
#include "harness/grade/margins.h"
#include "harness/kinds/pair/regimes/check_shapes.h"

namespace touchstone::kinds {
namespace {

// Returns the matrix with columns n, u, n x u.
Mat3d frame(const Vec3d& n, const Vec3d& u) {
  Mat3d m;
  m.col(0) = n;
  m.col(1) = u;
  m.col(2) = base::outer(n, u);
  return m;
}

// Returns whether the difference of the bodies has one normal only where the features meet, so that
// a move along it changes the depth by its length.
bool have_one_normal(const Mat3d& rotation_a, const Mat3d& rotation_b, const Feature& a,
                     const Feature& b) {
  if (a.has_one_normal() || b.has_one_normal()) return true;
  if (!a.has_direction() || !b.has_direction()) return false;
  return base::length(base::outer(base::times(rotation_a, a.direction),
                                  base::times(rotation_b, b.direction))) > 0.05;
}

// Returns a point inside the body, relative to its translation, in world axes. For a half-space the
// point lies below `surface` (a point of the plane, in the same frame) by the size of the pair.
Vec3d inner_offset(const Shape& shape, const Mat3d& rotation, const Vec3d& surface, double size) {
  if (shape.kind == ShapeKind::halfspace) {
    return surface - size * base::times(rotation, base::unit(shape.normal));
  }
  return base::times(rotation, inner_point(shape));
}

double width(const Shape& shape, const Mat3d& rotation, const Vec3d& world_n) {
  const Vec3d n = base::transposed_times(rotation, world_n);
  return support_value(shape, n) + support_value(shape, Vec3d::Zero() - n);
}

// Sets translation b = translation a + offset.
void translate(files::Case& c, const DoubleDouble3& offset, bool fine) {
  if (fine) {
    c.pose_b.translation = offset.value();
    c.pose_a.translation = (base::exactly(c.pose_b.translation) - offset).value();
  } else {
    c.pose_b.translation = (base::exactly(c.pose_a.translation) + offset).value();
  }
}

}  // namespace

Mat3d facing(const Mat3d& rotation_a, const Feature& a, const Feature& b, bool aligned,
             base::Random& random) {
  const Vec3d n = base::unit(base::times(rotation_a, a.normal));
  const Vec3d wish = aligned ? base::times(rotation_a, a.direction) : random.on_sphere();
  const Vec3d own = b.has_direction() ? b.direction : random.on_sphere();
  const Mat3d to = frame(Vec3d::Zero() - n, base::beside(n, wish));
  return base::product(to, frame(b.normal, base::beside(b.normal, own)).transpose());
}

void place(files::Case& c, const Feature& a, const Feature& b, double gap, bool fine) {
  const Mat3d& rotation_a = c.pose_a.rotation;
  const Mat3d& rotation_b = c.pose_b.rotation;
  const DoubleDouble3 n = base::true_unit(base::times(rotation_a, a.normal));
  const DoubleDouble radii = DoubleDouble::sum(a.radius, b.radius);
  const DoubleDouble3 touching =
      base::times(rotation_a, a.point) + base::scaled(n, radii) - base::times(rotation_b, b.point);
  DoubleDouble3 offset = touching + base::scaled(n, {gap, 0});
  if (gap < 0) {
    const double size = grade::pair_size(c);
    const Vec3d surface = base::times(rotation_a, a.point).value();
    const Vec3d surface_b = base::times(rotation_b, b.point).value();
    const Vec3d inward = inner_offset(c.shape_a, rotation_a, surface, size) -
                         inner_offset(c.shape_b, rotation_b, surface_b, size) - touching.value();
    const double room = base::length(inward);
    const double narrow =
        std::min(width(c.shape_a, rotation_a, n.value()), width(c.shape_b, rotation_b, n.value()));
    if (-gap > 0.02 * narrow || !have_one_normal(rotation_a, rotation_b, a, b)) {
      offset = touching + base::scaled(base::true_unit(inward), {std::min(-gap, 0.9 * room), 0});
    }
  }
  translate(c, offset, fine);
}

void place_at_random(files::Case& c, base::Random& random) {
  const double size = grade::pair_size(c);
  const Mat3d& rotation_a = c.pose_a.rotation;
  const Mat3d& rotation_b = c.pose_b.rotation;
  Vec3d n = random.on_sphere();
  double share = random.uniform(0, 1.4);  // part of the offset at which they touch along n
  const auto planar = [](const Shape& shape) { return shape.kind == ShapeKind::halfspace; };
  if (planar(c.shape_a)) n = base::times(rotation_a, base::unit(c.shape_a.normal));
  if (planar(c.shape_b)) n = Vec3d::Zero() - base::times(rotation_b, base::unit(c.shape_b.normal));
  if (planar(c.shape_a) || planar(c.shape_b)) share = random.uniform(0.5, 1.5);
  const auto foot = [&](const Shape& shape, const Mat3d& rotation) -> Vec3d {
    if (!planar(shape)) return Vec3d::Zero();
    const double norm = base::length(shape.normal);
    return base::times(rotation, (shape.offset / norm) * (shape.normal / norm));
  };
  const Vec3d inner_a = inner_offset(c.shape_a, rotation_a, foot(c.shape_a, rotation_a), size);
  const Vec3d inner_b = inner_offset(c.shape_b, rotation_b, foot(c.shape_b, rotation_b), size);
  // Returns how far the body reaches along a direction from its inner point.
  const auto reach = [&](const Shape& shape, const Mat3d& rotation, const Vec3d& inner_point_,
                         const Vec3d& direction) {
    if (planar(shape)) return size;
    return support_value(shape, base::transposed_times(rotation, direction)) -
           base::inner(inner_point_, direction);
  };
  const double touching = reach(c.shape_a, rotation_a, inner_a, n) +
                          reach(c.shape_b, rotation_b, inner_b, Vec3d::Zero() - n);
  translate(c, base::exactly(inner_a - inner_b + (share * touching) * n), false);
}

}  // namespace touchstone::kinds
