// Draws scenes and rays.
#include "harness/families/ray_scenes.h"

#include <memory>
#include <utility>

#include "harness/families/meshes.h"
#include "harness/families/moving_pairs.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/geometry/signed_permutation.h"
#include "harness/geometry/tessellation.h"

namespace touchstone::families {
namespace {

constexpr std::array bounded_kinds = {ShapeKind::sphere,   ShapeKind::capsule, ShapeKind::box,
                                      ShapeKind::cylinder, ShapeKind::cone,    ShapeKind::ellipsoid,
                                      ShapeKind::hull};

ConcaveBody body_of(Shape shape) { return {nullptr, {{std::move(shape), {}, 0}}}; }

ConcaveBody body_of(TriangleMesh mesh) {
  return {std::make_shared<const TriangleMesh>(std::move(mesh)), {}};
}

Shape floor_shape(const Vec3d& normal) {
  Shape shape;
  shape.kind = ShapeKind::halfspace;
  shape.normal = normal;
  return shape;
}

Pose pose_anywhere(Draws& draws) { return {draws.rotation(), on_grid(draws.vector(3))}; }

// A ball, a box beside it, and a surface.
ConcaveBody any_compound(Draws& draws, const Mat3d& turn) {
  ConcaveBody body = body_of(round_shape(ShapeKind::sphere, 0.5, 0));
  body.parts.push_back({box_shape({0.25, 0.5, 0.75}), {turn, {1, 0, 0}}, 0});
  geometry::add_surface(std::make_shared<const TriangleMesh>(box_mesh(0.5, 0.25, 0.5)),
                        {turn, {-1, draws.below(3) / 2.0, 0}}, {}, body);
  return body;
}

std::vector<SceneBody> mixed_bodies(Draws& draws) {
  std::vector<SceneBody> bodies;
  const auto add = [&](ConcaveBody body) {
    bodies.push_back({std::move(body), pose_anywhere(draws)});
  };
  for (const ShapeKind kind : bounded_kinds) add(body_of(random_shape(kind, draws)));
  add(body_of(ellipsoid_mesh({1, 2, 1}, 8, 6)));
  add(body_of(torus(8, 4, 0.75, 0.25)));
  add(body_of(
      moved(soup_mesh(16, static_cast<std::uint64_t>(draws.below(1000))), 0.25, {0, 0, 0})));
  add(any_compound(draws, draws.rotation()));
  bodies.push_back(
      {body_of(floor_shape(Vec3d(0, 0, 1) + draws.vector(0.25))), {draws.rotation(), {0, 0, -4}}});
  return bodies;
}

// Sizes and places are multiples of a quarter.
std::vector<SceneBody> bodies_on_a_grid(Draws& draws) {
  std::vector<SceneBody> bodies;
  const auto turns = geometry::signed_permutations();
  const auto add = [&](ConcaveBody body) {
    const auto half = [&] { return draws.below(9) / 2.0 - 2; };
    const double x = half(), y = half();
    const auto turn = static_cast<std::size_t>(draws.below(static_cast<int>(turns.size())));
    bodies.push_back({std::move(body), {turns[turn].matrix(), {x, y, half()}}});
  };
  for (const ShapeKind kind : bounded_kinds) {
    if (kind == ShapeKind::box) {
      add(body_of(box_shape({0.25, 0.5, 0.75})));
    } else if (kind == ShapeKind::hull) {
      add(body_of(hull_shape(
          {{0.5, 0, 0}, {-0.5, 0, 0}, {0, 0.5, 0}, {0, -0.5, 0}, {0, 0, 1}, {0, 0, -1}})));
    } else if (kind == ShapeKind::ellipsoid) {
      Shape shape;
      shape.kind = kind;
      shape.radii = {0.25, 0.5, 0.75};
      add(body_of(shape));
    } else {
      add(body_of(round_shape(kind, 0.5, 0.5)));
    }
  }
  add(body_of(box_mesh(0.5, 0.75, 0.25)));
  add(body_of(moved(terrain_mesh(4, 0, 1), 0.5, {-1, -1, 0})));
  add(any_compound(draws, turns[static_cast<std::size_t>(draws.below(24))].matrix()));
  bodies.push_back({body_of(floor_shape({0, 0, 1})), {Mat3d::Identity(), {0, 0, -3}}});
  return bodies;
}

std::vector<SceneBody> crowd(Draws& draws) {
  std::vector<SceneBody> bodies;
  for (std::size_t i = 0; i < 60; ++i) {
    const ShapeKind kind = bounded_kinds[i % bounded_kinds.size()];
    const double scale = draws.uniform(0.125, 0.5);
    const Shape shape = geometry::scaled_shape(random_shape(kind, draws), scale);
    bodies.push_back({body_of(shape), pose_anywhere(draws)});
  }
  return bodies;
}

std::vector<SceneBody> coincident_bodies(Draws& draws) {
  std::vector<SceneBody> bodies = mixed_bodies(draws), twice;
  for (std::size_t i = 0; i < bodies.size(); i += 2) {
    for (int k = 0; k < 2 + draws.below(2); ++k) twice.push_back(bodies[i]);
  }
  return twice;
}

// A point in or near a part of the body, in the world.
Vec3d point_near(const SceneBody& of, Draws& draws) {
  const ConcaveBody& body = of.body;
  const auto below = [&](std::size_t count) {
    return static_cast<std::size_t>(draws.below(static_cast<int>(count)));
  };
  if (body.mesh) {
    const auto& corners = body.mesh->triangles[below(body.mesh->triangles.size())];
    Vec3d sum = Vec3d::Zero();
    double weights = 0;
    for (const std::uint32_t corner : corners) {
      const double weight = draws.below(5);
      sum += weight * body.mesh->vertices[corner];
      weights += weight;
    }
    return of.pose(weights > 0 ? Vec3d(sum / weights) : body.mesh->vertices[corners[0]]);
  }
  const ConvexPart& part = body.parts[below(body.parts.size())];
  Vec3d middle = draws.vector(part.shape.kind == ShapeKind::halfspace ? 3 : 0.6);
  if (part.shape.kind == ShapeKind::hull) {
    const auto& vertices = part.shape.hull->vertices;
    middle = 0.5 * (vertices[below(vertices.size())] + vertices[below(vertices.size())]);
  }
  return of.pose(part.pose(middle));
}

// Near a point of a body, and so far off that rounding does not decide whether an outline is met.
Vec3d target_near(std::span<const SceneBody> bodies, Draws& draws) {
  const auto number = static_cast<std::size_t>(draws.below(static_cast<int>(bodies.size())));
  return on_grid(point_near(bodies[number], draws));
}

// Zeros of either sign, and 1 or -2.
Vec3d axis_direction(Draws& draws) {
  Vec3d direction;
  for (int k = 0; k < 3; ++k) direction[k] = draws.below(2) == 0 ? 0.0 : -0.0;
  direction[draws.below(3)] = draws.below(2) == 0 ? 1 : -2;
  return direction;
}

Ray ray_on_a_grid(Draws& draws) {
  Ray ray;
  for (int k = 0; k < 3; ++k) {
    ray.origin[k] = draws.below(33) / 4.0 - 4;
    ray.direction[k] = draws.below(3) - 1;
  }
  if (ray.direction.isZero(0)) ray.direction = axis_direction(draws);
  if (draws.below(3) == 0) ray.t_max = draws.below(17) / 4.0;
  return ray;
}

}  // namespace

std::string_view to_string(RayScene scene) {
  constexpr std::array<std::string_view, all_ray_scenes.size()> names = {
      "mixed", "inside", "short", "axis", "far", "on-a-grid", "crowd", "coincident"};
  return names[static_cast<std::size_t>(scene)];
}

std::vector<SceneBody> bodies_of(RayScene scene, Draws& draws) {
  switch (scene) {
    case RayScene::on_a_grid: return bodies_on_a_grid(draws);
    case RayScene::crowd: return crowd(draws);
    case RayScene::coincident: return coincident_bodies(draws);
    default: return mixed_bodies(draws);
  }
}

Ray ray_at(RayScene scene, std::span<const SceneBody> bodies, Draws& draws) {
  if (scene == RayScene::on_a_grid) return ray_on_a_grid(draws);
  const Vec3d target = target_near(bodies, draws);
  Ray ray;
  ray.origin = on_grid(draws.vector(6));
  if (scene == RayScene::far) ray.origin = on_grid(Vec3d(target + 1e5 * draws.direction()));
  ray.direction = target - ray.origin;
  switch (scene) {
    case RayScene::inside:
      ray.origin = target;
      ray.direction = draws.vector(1);
      break;
    case RayScene::axis:
      ray.direction = axis_direction(draws);
      ray.origin = target - 8 * ray.direction;
      break;
    case RayScene::short_rays: ray.t_max = draws.uniform(0, 1.5); break;
    default: break;
  }
  if (ray.direction.isZero(0)) ray.direction = Vec3d::UnitX();
  return ray;
}

Ray ray_from(double distance, std::span<const SceneBody> bodies, Draws& draws) {
  Ray ray;
  const Vec3d target = target_near(bodies, draws);
  ray.origin = target + distance * draws.direction();
  ray.direction = target - ray.origin;
  return ray;
}

}  // namespace touchstone::families
