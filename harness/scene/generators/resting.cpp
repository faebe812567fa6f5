// Places of bodies that rest on each other, for the generator `pairs`.
#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/base/reproducible_math.h"
#include "harness/scene/generators/pairs.h"

namespace touchstone::scene {
namespace {

// The turn that brings a unit vector of the body to the vertical, up or down.
Mat3d turned_upright(const Vec3d& n, double side) {
  const Vec3d up = side * n;
  int least = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(up[k]) < std::abs(up[least])) least = k;
  }
  const Vec3d first = base::unit(base::outer(Vec3d::Unit(least), up));
  const Vec3d second = base::outer(up, first);
  Mat3d turn;
  for (int k = 0; k < 3; ++k) {
    turn(0, k) = first[k];
    turn(1, k) = second[k];
    turn(2, k) = up[k];
  }
  return turn;
}

// The turn that lays a hull on one of its faces, or puts that on top; other bodies stand as they are.
Mat3d face_turn(const Shape& shape, double side, base::Random& random) {
  if (shape.kind != ShapeKind::hull || shape.hull->faces.empty()) return Mat3d::Identity();
  const auto& loop = shape.hull->faces[random.below(shape.hull->faces.size())].loop;
  const auto corner = [&](std::size_t k) -> const Vec3d& { return shape.hull->vertices[loop[k]]; };
  const Vec3d normal = base::unit(base::outer(corner(1) - corner(0), corner(2) - corner(0)));
  return turned_upright(normal, side);
}

// The extent of a box or hull around the body's origin, along the axes of the world, and the middle
// of its top or bottom.
struct Extent {
  Vec3d low, high;
  Vec3d top = Vec3d::Zero(), bottom = Vec3d::Zero();
};

Extent extent_of_box(const Vec3d& half, const Mat3d& rotation) {
  Extent extent{Vec3d::Zero(), Vec3d::Zero()};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) extent.high[i] += std::abs(rotation(i, k)) * half[k];
  }
  extent.low = -extent.high;
  return extent;
}

// The mean of the vertices that are at a height, but for rounding.
Vec3d middle_at(const std::vector<Vec3d>& vertices, double height, double rounding) {
  Vec3d sum = Vec3d::Zero();
  double count = 0;
  for (const Vec3d& vertex : vertices) {
    if (std::abs(vertex.z() - height) > rounding) continue;
    sum += vertex;
    ++count;
  }
  return sum / count;
}

Extent extent_of(const Shape& shape, const Mat3d& rotation) {
  if (shape.kind == ShapeKind::box) return extent_of_box(shape.half_extents, rotation);
  std::vector<Vec3d> turned;
  for (const Vec3d& vertex : shape.hull->vertices) {
    turned.push_back(base::times(rotation, vertex));
  }
  Extent extent{turned[0], turned[0]};
  for (const Vec3d& vertex : turned) {
    extent.low = extent.low.cwiseMin(vertex);
    extent.high = extent.high.cwiseMax(vertex);
  }
  const double rounding = 1e-12 * (extent.high - extent.low).maxCoeff();
  extent.top = middle_at(turned, extent.high.z(), rounding);
  extent.bottom = middle_at(turned, extent.low.z(), rounding);
  return extent;
}

}  // namespace

void snap_boxes(Scene& scene) {
  constexpr double parts = 64;  // of a metre
  for (Shape& shape : scene.shapes) {
    if (shape.kind != ShapeKind::box) continue;
    for (double& half : shape.half_extents) half = std::max(1.0, std::round(half * parts)) / parts;
  }
}

void place_resting(Rest rest, double gap, base::Random& random, Scene& scene, Body& a, Body& b) {
  const Mat3d common = a.pose.rotation;  // at random
  const auto about_vertical = [&] {
    return base::rotation_over(Vec3d::UnitZ(), random.uniform(0, 6));
  };
  const Shape &shape_a = scene.shapes[a.shape], &shape_b = scene.shapes[b.shape];
  a.pose.rotation = face_turn(shape_a, rest == Rest::floor ? -1 : 1, random);
  if (rest == Rest::turned || rest == Rest::floor) {
    a.pose.rotation = base::product(about_vertical(), a.pose.rotation);
  }
  const Extent of_a = extent_of(shape_a, a.pose.rotation);
  if (rest == Rest::floor) {
    b.pose = {Mat3d::Identity(), a.pose.translation};
    a.pose.translation.z() += gap - of_a.low.z();
    return;
  }
  b.pose.rotation = face_turn(shape_b, -1, random);
  if (rest == Rest::turned) b.pose.rotation = base::product(about_vertical(), b.pose.rotation);
  const Extent of_b = extent_of(shape_b, b.pose.rotation);
  // The axes on which they touch: the vertical, or in a wall any of them.
  const std::uint64_t touched = rest == Rest::wall ? 1 + random.below(7) : 4;
  Vec3d offset = of_a.top - of_b.bottom;
  double lift = gap;  // on the first of these axes
  for (int k = 0; k < 3; ++k) {
    const bool touches = (touched >> k & 1) != 0;
    const bool below = rest == Rest::wall && random.below(2) == 0;
    if (!touches) continue;
    offset[k] = below ? of_a.low[k] - of_b.high[k] - lift : of_a.high[k] - of_b.low[k] + lift;
    lift = 0;
  }
  if (rest == Rest::tumbled) {
    a.pose.rotation = base::product(common, a.pose.rotation);
    b.pose.rotation = base::product(common, b.pose.rotation);
    offset = base::times(common, offset);
  }
  b.pose.translation = a.pose.translation + offset;
}

}  // namespace touchstone::scene
