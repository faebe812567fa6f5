// Turns shapes into a module's.
#include "harness/modules/module_shapes.h"

#include <algorithm>

namespace touchstone::modules {
namespace {

void copy(const Vec3d& from, double* to) { std::copy_n(from.data(), 3, to); }

}  // namespace

ModuleShapes::ModuleShapes(std::span<const Shape> shapes) : shapes_(shapes.size()) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Shape& shape = shapes[i];
    TouchstoneModuleShape& made = shapes_[i];
    pointers_.push_back(&made);
    made.struct_size = sizeof made;
    made.kind = static_cast<std::uint32_t>(shape.kind);
    made.radius = shape.radius;
    made.half_length = shape.half_length;
    copy(shape.half_extents, made.half_extents);
    copy(shape.radii, made.radii);
    copy(shape.normal, made.normal);
    made.offset = shape.offset;
    if (shape.kind != ShapeKind::hull) continue;
    const Hull& hull = *shape.hull;
    made.vertex_count = static_cast<std::uint32_t>(hull.vertices.size());
    made.dimension = static_cast<std::uint32_t>(hull.dimension);
    made.vertices = hull.vertices.front().data();
    Lists& lists = *lists_.emplace_back(std::make_unique<Lists>());
    const auto end_of = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    if (hull.neighbours.size() == hull.vertices.size()) {
      lists.neighbour_starts.push_back(0);
      for (const auto& of_vertex : hull.neighbours) {
        lists.neighbours.insert(lists.neighbours.end(), of_vertex.begin(), of_vertex.end());
        lists.neighbour_starts.push_back(end_of(lists.neighbours));
      }
      made.neighbour_starts = lists.neighbour_starts.data();
      made.neighbours = lists.neighbours.data();
    }
    if (hull.faces.empty()) continue;
    lists.face_starts.push_back(0);
    for (const Hull::Face& face : hull.faces) {
      lists.face_vertices.insert(lists.face_vertices.end(), face.loop.begin(), face.loop.end());
      lists.face_starts.push_back(end_of(lists.face_vertices));
      lists.face_normals.insert(lists.face_normals.end(), face.normal.begin(), face.normal.end());
    }
    made.face_count = static_cast<std::uint32_t>(hull.faces.size());
    made.face_starts = lists.face_starts.data();
    made.face_vertices = lists.face_vertices.data();
    made.face_normals = lists.face_normals.data();
  }
}

}  // namespace touchstone::modules
