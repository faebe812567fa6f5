// Draws shapes without volume, or almost without, and hulls with redundant points.
#include <algorithm>
#include <cmath>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/reproducible_math.h"
#include "harness/geometry/tessellation.h"
#include "harness/kinds/pair/regimes/regime_draws.h"

namespace touchstone::kinds {
namespace {

using Points = std::vector<Vec3d>;

Vec3d in_cube(base::Random& random) {
  const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
  return {x, y, random.uniform(-1, 1)};
}

// Draws points in the plane z = 0, or in a tilted plane, where they are coplanar up to rounding.
Points flat_points(base::Random& random) {
  Points points;
  const std::uint64_t count = random.below(2) == 0 ? 3 : 4 + random.below(13);
  const bool grid = random.below(2) == 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    Vec3d p = in_cube(random);
    if (grid) p = (4 * p).array().round().matrix() / 4;
    points.emplace_back(p.x(), p.y(), 0);
  }
  if (grid) points.insert(points.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  if (random.below(2) == 0) {
    const Mat3d turn = random.rotation();
    for (Vec3d& p : points) p = base::times(turn, p);
  }
  return points;
}

Points segment_points(base::Random& random) {
  const Vec3d a = in_cube(random), b = in_cube(random);
  Points points = {a, b};
  if (random.below(2) == 0) points.push_back((a + b) / 2);
  if (random.below(4) == 0) points.push_back(a);
  return points;
}

// Draws a solid's points and a third as many redundant ones: copies, midpoints of two or three
// points, and points inside.
Points redundant_points(base::Random& random) {
  Points points;
  const std::uint64_t count = 4 + random.below(13);
  if (random.below(2) == 0) {
    points = box_as_hull(in_cube(random).cwiseAbs() + Vec3d::Constant(0.1)).hull->vertices;
  } else {
    for (std::uint64_t i = 0; i < count; ++i) points.push_back(random.on_sphere());
  }
  const auto any = [&] { return points[random.below(points.size())]; };
  for (std::uint64_t more = 2 + count / 3; more > 0; --more) {
    const Vec3d p = any(), q = any(), r = any();
    switch (random.below(4)) {
      case 0: points.push_back(p); break;
      case 1: points.push_back((p + q) / 2); break;
      case 2: points.push_back((p + q + 2 * r) / 4); break;
      default: points.push_back(0.1 * p); break;
    }
  }
  return points;
}

// Draws a flat set or a tetrahedron, flattened to 1e-3 to 1e-12 of its size.
Points sliver_points(base::Random& random) {
  const double thickness = random.magnitude(1e-12, 1e-3);
  Points points;
  const std::uint64_t count = random.below(2) == 0 ? 4 : 5 + random.below(12);
  for (std::uint64_t i = 0; i < count; ++i) {
    Vec3d p = in_cube(random);
    p.z() *= thickness;
    points.push_back(p);
  }
  if (random.below(2) == 0) {
    const Mat3d turn = random.rotation();
    for (Vec3d& p : points) p = base::times(turn, p);
  }
  return points;
}

// Draws any kind but a hull, with one or more of its sizes zero.
Shape zero_sized(std::uint64_t seed, base::Random& random) {
  ShapeKind kind = ShapeKind::hull;
  while (kind == ShapeKind::hull) kind = random_kind(random);
  Shape shape = random_shape(kind, {}, seed, random);
  const std::uint64_t axes = 1 + random.below(7);
  for (int i = 0; i < 3; ++i) {
    if ((axes >> i & 1) != 0) shape.half_extents[i] = shape.radii[i] = 0;
  }
  const std::uint64_t lengths = kind == ShapeKind::sphere ? 1 : 1 + random.below(3);
  if ((lengths & 1) != 0) shape.radius = 0;
  if ((lengths & 2) != 0) shape.half_length = 0;
  return shape;
}

Shape any_degenerate(std::uint64_t seed, base::Random& random) {
  switch (random.below(5)) {
    case 0: return hull_of(flat_points(random));
    case 1: return hull_of(segment_points(random));
    case 2: return hull_of({in_cube(random)});
    case 3: return hull_of(redundant_points(random));
    default: return zero_sized(seed, random);
  }
}

// Pairs the shape with one of any kind; half of the time with another of its own family.
template <class MakeShape>
RegimeCase pair_with(RegimeDraw& draw, MakeShape make_shape) {
  base::Random& random = draw.random;
  RegimeCase result;
  files::Case& c = result.pair;
  c.shape_a = make_shape();
  switch (random.below(8)) {
    case 0:
    case 1:
    case 2: c.shape_b = make_shape(); break;
    case 3: c.shape_b = random_shape(ShapeKind::halfspace, {}, draw.seed, random); break;
    default: c.shape_b = random_shape(random_kind(random), {}, draw.seed, random); break;
  }
  result.detail = place_by_amount(c, random_amount(random), random);
  swap_at_random(c, random);
  return result;
}

}  // namespace

RegimeCase draw_sliver(RegimeDraw& draw) {
  return pair_with(draw, [&] { return hull_of(sliver_points(draw.random)); });
}

RegimeCase draw_flat_hull(RegimeDraw& draw) {
  return pair_with(draw, [&] { return hull_of(flat_points(draw.random)); });
}

RegimeCase draw_segment(RegimeDraw& draw) {
  return pair_with(draw, [&] { return hull_of(segment_points(draw.random)); });
}

RegimeCase draw_point(RegimeDraw& draw) {
  return pair_with(draw, [&] {
    const Vec3d point = draw.random.below(2) == 0 ? Vec3d(Vec3d::Zero()) : in_cube(draw.random);
    return hull_of(Points(1 + draw.random.below(2), point));
  });
}

RegimeCase draw_zero_size(RegimeDraw& draw) {
  return pair_with(draw, [&] { return zero_sized(draw.seed, draw.random); });
}

RegimeCase draw_redundant_hull(RegimeDraw& draw) {
  return pair_with(draw, [&] { return hull_of(redundant_points(draw.random)); });
}

RegimeCase draw_scaled_degenerate(RegimeDraw& draw) {
  base::Random& random = draw.random;
  const double size = random.magnitude(1e-9, 1e9);
  RegimeCase result;
  files::Case& c = result.pair;
  c.shape_a = geometry::scaled_shape(any_degenerate(draw.seed, random), size);
  c.shape_b = geometry::scaled_shape(random.below(2) == 0
                                         ? any_degenerate(draw.seed, random)
                                         : random_shape(random_kind(random), {}, draw.seed, random),
                                     size);
  result.detail = place_by_amount(c, random_amount(random), random);
  swap_at_random(c, random);
  return result;
}

}  // namespace touchstone::kinds
