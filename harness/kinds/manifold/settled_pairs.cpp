// Makes pairs of bodies that lie face on face, by family.
#include "harness/kinds/manifold/manifold_kind.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/random.h"
#include "harness/base/reproducible_math.h"

namespace touchstone::kinds {
namespace {

// The recipe of a family: unit scale unless it says otherwise.
struct Recipe {
  SettledFamily family;
  bool hull_a = false, hull_b = false;
  double tilt = 0;            // radians, about a random line across the normal
  double scale = 1, far = 0;  // metres
  enum class Place : std::uint8_t { anywhere, same, inside, corner, edge };
  Place place = Place::anywhere;
};

constexpr std::array recipes = {
    Recipe{.family = {"boxes", "boxes of other sizes, turned about the normal"}},
    Recipe{.family = {"hulls", "faces of random hulls"}, .hull_a = true, .hull_b = true},
    Recipe{.family = {"hull-on-box", "the face of a random hull on a box"}, .hull_b = true},
    Recipe{.family = {"stack", "boxes of the same size, exactly on each other"},
           .place = Recipe::Place::same},
    Recipe{.family = {"inside", "a small box's face inside of a large one"},
           .place = Recipe::Place::inside},
    Recipe{.family = {"corner", "boxes that share a corner of their faces"},
           .place = Recipe::Place::corner},
    Recipe{.family = {"sliver", "boxes that share a strip of 1e-6 of their faces"},
           .place = Recipe::Place::edge},
    Recipe{.family = {"tilt-1e-1", "boxes, tilted by 0.1"}, .tilt = 1e-1},
    Recipe{.family = {"tilt-1e-2", "boxes, tilted by 1e-2"}, .tilt = 1e-2},
    Recipe{.family = {"tilt-1e-4", "boxes, tilted by 1e-4"}, .tilt = 1e-4},
    Recipe{.family = {"tilt-1e-6", "boxes, tilted by 1e-6"}, .tilt = 1e-6},
    Recipe{.family = {"tilt-1e-9", "boxes, tilted by 1e-9"}, .tilt = 1e-9},
    Recipe{.family = {"tilt-1e-12", "boxes, tilted by 1e-12"}, .tilt = 1e-12},
    Recipe{.family = {"hull-tilt-1e-3", "hulls, tilted by 1e-3"},
           .hull_a = true,
           .hull_b = true,
           .tilt = 1e-3},
    Recipe{.family = {"scale-1e-6", "boxes of a micrometre"}, .scale = 1e-6},
    Recipe{.family = {"scale-1e6", "boxes of a thousand kilometres"}, .scale = 1e6},
    Recipe{.family = {"hull-scale-1e-6", "hulls of a micrometre"},
           .hull_a = true,
           .hull_b = true,
           .scale = 1e-6},
    Recipe{.family = {"far-1e7", "boxes, 1e7 metres from the origin"}, .far = 1e7},
};

// A body with the face that it lies on: the face's middle and outward normal, body coordinates.
struct Resting {
  Shape shape;
  Vec3d middle, normal;
  double reach;  // approximate extent of the face
};

Resting resting_box(const Vec3d& half, double side) {
  Resting body;
  body.shape.kind = ShapeKind::box;
  body.shape.half_extents = half;
  body.normal = {0, 0, side};
  body.middle = {0, 0, side * half.z()};
  body.reach = std::min(half.x(), half.y());
  return body;
}

// Returns a hull that lies on its largest face.
Resting resting_hull(double scale, base::Random& random) {
  std::vector<Vec3d> points(8 + random.below(17));
  const Vec3d radii{random.uniform(0.4, 1), random.uniform(0.4, 1), random.uniform(0.3, 1)};
  for (Vec3d& point : points) point = scale * random.on_sphere().cwiseProduct(radii);
  // The bottom is cut flat, so that one face has many corners.
  const double floor = -0.6 * scale * radii.z();
  for (Vec3d& point : points) point.z() = std::max(point.z(), floor);
  Resting body;
  body.shape.kind = ShapeKind::hull;
  body.shape.hull = make_hull(points);
  double greatest = -1;
  for (const Hull::Face& face : body.shape.hull->faces) {
    const auto corner = [&](std::size_t k) { return body.shape.hull->vertices[face.loop[k]]; };
    Vec3d area = Vec3d::Zero(), sum = corner(0);
    for (std::size_t k = 1; k < face.loop.size(); ++k) {
      sum += corner(k);
      area += (corner(k - 1) - corner(0)).cross(corner(k) - corner(0));
    }
    if (area.norm() <= greatest) continue;
    greatest = area.norm();
    body.normal = area.normalized();
    body.middle = sum / static_cast<double>(face.loop.size());
    body.reach = 0.5 * std::sqrt(greatest / 2);
  }
  return body;
}

Vec3d random_tangent(const Vec3d& normal, base::Random& random) {
  for (;;) {
    const Vec3d direction = random.on_sphere();
    const Vec3d part = direction - direction.dot(normal) * normal;
    if (part.norm() > 0.1) return part.normalized();
  }
}

Vec3d random_half(base::Random& random) {
  return {random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)};
}

// Returns the lowest corner of a turned box or hull, body coordinates.
Vec3d lowest_corner(const Shape& shape, const Mat3d& turn, const Vec3d& up) {
  Vec3d lowest = Vec3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Vec3d& corner) {
    const double height = up.dot(turn * corner);
    if (height >= least) return;
    least = height;
    lowest = corner;
  };
  if (shape.kind == ShapeKind::hull) {
    for (const Vec3d& vertex : shape.hull->vertices) offer(vertex);
    return lowest;
  }
  for (int k = 0; k < 8; ++k) {
    const Vec3d sides((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    offer(sides.cwiseProduct(shape.half_extents));
  }
  return lowest;
}

// Returns the place of b's middle on a's face, relative to a's middle. For boxes, b not turned.
Vec3d place_on(Recipe::Place place, const Vec3d& a, const Vec3d& b, base::Random& random) {
  switch (place) {
    case Recipe::Place::inside:
      return {random.uniform(-1, 1) * (a.x() - b.x()), random.uniform(-1, 1) * (a.y() - b.y()), 0};
    case Recipe::Place::corner: return {a.x() + b.x() - 1e-3, a.y() + b.y() - 1e-3, 0};
    case Recipe::Place::edge: return {a.x() + b.x() - 1e-6, random.uniform(-0.1, 0.1), 0};
    case Recipe::Place::same:
    case Recipe::Place::anywhere: break;
  }
  return Vec3d::Zero();
}

}  // namespace

std::span<const SettledFamily> settled_families() {
  static const std::vector<SettledFamily> families = [] {
    std::vector<SettledFamily> list;
    for (const Recipe& recipe : recipes) list.push_back(recipe.family);
    return list;
  }();
  return families;
}

files::Case settled_pair(const SettledFamily& family, std::uint64_t seed, std::uint64_t index) {
  const auto number = static_cast<std::size_t>(&family - settled_families().data());
  const Recipe& recipe = recipes[number];
  using Place = Recipe::Place;
  base::Random random(seed, number << 32 | index);
  const Vec3d half_a = random_half(random);
  Vec3d half_b = recipe.place == Place::same ? half_a : random_half(random);
  if (recipe.place == Place::inside) half_b = half_a.cwiseProduct(Vec3d(0.3, 0.4, 0.5));
  const Resting a =
      recipe.hull_a ? resting_hull(recipe.scale, random) : resting_box(recipe.scale * half_a, 1);
  const Resting b =
      recipe.hull_b ? resting_hull(recipe.scale, random) : resting_box(recipe.scale * half_b, -1);
  const double least_depth = recipe.place == Place::edge ? 1e-8 : 1e-6;
  const double depth =
      recipe.scale * random.magnitude(least_depth, recipe.place == Place::edge ? 1e-7 : 1e-3);

  files::Case c;
  c.id = fmt::format("{}/{}", family.name, index);
  c.shape_a = a.shape;
  c.shape_b = b.shape;
  // In a's frame b's face lies against a's, turned about the normal and tilted about its lowest
  // point.
  Mat3d turn = base::rotation_between(b.normal, -a.normal);
  Vec3d offset = recipe.scale * place_on(recipe.place, half_a, half_b, random);
  if (recipe.place == Place::anywhere) {
    turn = Eigen::AngleAxisd(random.uniform(0, 6.28), a.normal).toRotationMatrix() * turn;
    offset = random.uniform(0, 0.7) * (a.reach + b.reach) * random_tangent(a.normal, random);
    if (recipe.tilt > 0)
      offset = random.uniform(0, 0.6) * a.reach * random_tangent(a.normal, random);
  }
  if (recipe.tilt > 0) {
    turn =
        Eigen::AngleAxisd(recipe.tilt, random_tangent(a.normal, random)).toRotationMatrix() * turn;
  }
  // A tilted body stands on a's face with its lowest corner.
  const Vec3d foot = recipe.tilt > 0 ? lowest_corner(b.shape, turn, a.normal) : b.middle;
  Vec3d at = a.middle + offset - turn * foot;
  at -= depth * a.normal;

  // Stacks stand upright, as in a scene; other pairs have a random pose.
  const bool upright = recipe.place == Place::same;
  const Mat3d world = upright ? Mat3d(Mat3d::Identity()) : random.rotation();
  Vec3d from = recipe.scale * random.on_sphere();
  if (recipe.far > 0) from = recipe.far * random.on_sphere();
  c.pose_a = {world, from};
  c.pose_b = {world * turn, from + world * at};
  return c;
}

}  // namespace touchstone::kinds
