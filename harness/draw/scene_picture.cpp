// Draws bodies as polytopes or by their triangles, half-spaces as squares.
#include "harness/draw/scene_picture.h"

#include <algorithm>
#include <array>
#include <memory>

#include "harness/geometry/tessellation.h"

namespace touchstone::draw {
namespace {

constexpr int polytope_level = 2;

Colour colour_of(BodyState state) {
  switch (state) {
    case BodyState::apart: return {0x9a, 0xa0, 0xa6};
    case BodyState::possible: return {0xe8, 0xb0, 0x4a};
    case BodyState::overlapping: return {0xd2, 0x3c, 0x32};
  }
  return {128, 128, 128};
}

std::array<Vec3d, 8> corners(const Aabb& box) {
  std::array<Vec3d, 8> points;
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      points[i][static_cast<int>(axis)] = (i >> axis & 1) == 0 ? box.min[axis] : box.max[axis];
    }
  }
  return points;
}

void draw_box(Canvas& canvas, const Aabb& box, Colour colour) {
  const std::array<Vec3d, 8> p = corners(box);
  constexpr std::size_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& face : faces) {
    canvas.polygon(std::array{p[face[0]], p[face[1]], p[face[2]], p[face[3]]}, colour);
  }
}

void draw_hull(Canvas& canvas, const Hull& hull, const Pose& pose, Colour colour) {
  std::vector<Vec3d> loop;
  for (const Hull::Face& face : hull.faces) {
    loop.clear();
    for (const std::uint32_t vertex : face.loop) loop.push_back(pose(hull.vertices[vertex]));
    canvas.polygon(loop, colour);
  }
  if (!hull.faces.empty()) return;
  // Flat hulls have no faces, so every triangle of their few points is drawn.
  loop.clear();
  for (const Vec3d& vertex : hull.vertices) loop.push_back(pose(vertex));
  for (const Vec3d& point : loop) canvas.dot(point, colour);
  for (std::size_t i = 1; i + 1 < std::min<std::size_t>(loop.size(), 32); ++i) {
    for (std::size_t j = i + 1; j < std::min<std::size_t>(loop.size(), 32); ++j) {
      canvas.polygon(std::array{loop[0], loop[i], loop[j]}, colour);
    }
  }
}

void draw_mesh(Canvas& canvas, const geometry::Mesh& mesh, const Pose& pose, Colour colour) {
  for (const auto& [a, b, c] : mesh.triangles) {
    canvas.polygon(
        std::array{pose(mesh.vertices[a]), pose(mesh.vertices[b]), pose(mesh.vertices[c])}, colour);
  }
}

// Draws the part of a half-space's face around the other bodies.
void draw_halfspace(Canvas& canvas, const Shape& shape, const Pose& pose, const Vec3d& centre,
                    double reach, Colour colour) {
  const double length = shape.normal.stableNorm();
  const Vec3d normal = pose.rotation * shape.normal / length;
  const Vec3d on_face = pose.translation + normal * (shape.offset / length);
  const Vec3d middle = centre - normal * normal.dot(centre - on_face);
  const Vec3d u = normal.unitOrthogonal() * reach;
  const Vec3d v = normal.cross(u);
  canvas.polygon(
      std::array<Vec3d, 4>{middle - u - v, middle + u - v, middle + u + v, middle - u + v}, colour);
}

}  // namespace

void draw_scene(Canvas& canvas, const scene::Scene& scene, std::span<const Pose> poses,
                std::span<const Aabb> boxes, std::span<const BodyState> states) {
  const auto bounded = [&](std::size_t i) {
    return poses.empty() || scene.shapes[scene.bodies[i].shape].kind != ShapeKind::halfspace;
  };
  std::vector<Vec3d> points;
  Vec3d low = Vec3d::Constant(1e300);
  Vec3d high = -low;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!bounded(i) || boxes[i].is_empty()) continue;
    for (const Vec3d& corner : corners(boxes[i])) {
      points.push_back(corner);
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  if (points.empty()) low = high = Vec3d::Zero();
  canvas.fit(points);

  std::vector<Shape> drawn = scene.shapes;
  for (Shape& shape : drawn) {
    if (shape.kind != ShapeKind::halfspace) shape = geometry::as_polytope(shape, polytope_level);
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Colour colour = colour_of(states[i]);
    canvas.next_body();
    if (poses.empty()) {
      if (!boxes[i].is_empty()) draw_box(canvas, boxes[i], colour);
      continue;
    }
    const Shape& shape = drawn[scene.bodies[i].shape];
    if (shape.kind == ShapeKind::halfspace) {
      draw_halfspace(canvas, shape, poses[i], (low + high) / 2, (high - low).norm() / 2 + 1e-9,
                     colour);
    } else if (scene.concave_of(scene.bodies[i].shape) != nullptr) {
      draw_mesh(canvas, *scene.mesh_of(scene.bodies[i].shape), poses[i], colour);
    } else {
      draw_hull(canvas, *shape.hull, poses[i], colour);
    }
  }
}

}  // namespace touchstone::draw
