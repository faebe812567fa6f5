// Bodies and numbers as JSON for the page.
#include "harness/report/body_view.h"

#include <cmath>

#include "algorithms/hull/convex_hull.h"

namespace touchstone::report {

using files::OrderedJson;

OrderedJson number(double x) { return std::isfinite(x) ? OrderedJson(x) : OrderedJson(nullptr); }

OrderedJson triple(const Vec3d& v) {
  if (!v.allFinite()) return nullptr;
  return {v.x(), v.y(), v.z()};
}

OrderedJson shape_view(const Shape& shape) {
  OrderedJson view;
  view["type"] = to_string(shape.kind);
  switch (shape.kind) {
    case ShapeKind::sphere: view["radius"] = shape.radius; break;
    case ShapeKind::box: view["half_extents"] = triple(shape.half_extents); break;
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      view["radius"] = shape.radius;
      view["half_length"] = shape.half_length;
      break;
    case ShapeKind::ellipsoid: view["radii"] = triple(shape.radii); break;
    case ShapeKind::halfspace:
      view["normal"] = triple(shape.normal);
      view["offset"] = shape.offset;
      break;
    case ShapeKind::hull: {
      std::shared_ptr<const Hull> hull = shape.hull;
      if (hull->faces.empty() && hull->dimension == 3) hull = make_hull(hull->vertices);
      OrderedJson vertices = OrderedJson::array(), faces = OrderedJson::array();
      for (const Vec3d& vertex : hull->vertices) vertices.push_back(triple(vertex));
      for (const auto& face : hull->faces) faces.push_back(face.loop);
      view["vertices"] = std::move(vertices);
      view["faces"] = std::move(faces);
      break;
    }
  }
  return view;
}

OrderedJson mesh_view(const geometry::Mesh& mesh) {
  OrderedJson view = {{"type", to_string(ShapeKind::hull)}};
  OrderedJson vertices = OrderedJson::array(), faces = OrderedJson::array();
  for (const Vec3d& vertex : mesh.vertices) vertices.push_back(triple(vertex));
  for (const auto& triangle : mesh.triangles) faces.push_back(triangle);
  view["vertices"] = std::move(vertices);
  view["faces"] = std::move(faces);
  return view;
}

OrderedJson body_view(const Shape& shape, const Pose& pose) {
  OrderedJson matrix = OrderedJson::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix.push_back(pose.rotation(row, column));
  }
  return {{"shape", shape_view(shape)},
          {"matrix", std::move(matrix)},
          {"translation", triple(pose.translation)}};
}

}  // namespace touchstone::report
