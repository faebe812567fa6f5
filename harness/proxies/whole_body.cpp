// Splits a body into convex solids and closed surfaces.
#include "harness/proxies/whole_body.h"

#include "algorithms/hull/convex_hull.h"
#include "harness/proxies/union_volume.h"

namespace touchstone::proxies {

WholeBody::WholeBody(const LocalBody& body, const Mat3d& turn) {
  if (body.mesh.triangles.empty()) {
    convex.emplace_back(body.shape, Pose{}, turn);
    surface = convex.front().surface();
    return;
  }
  for (geometry::MeshPiece& piece : geometry::pieces_of(body.mesh)) {
    for (Vec3d& v : piece.mesh.vertices) v = turn * v;
    std::vector<geometry::Triangle> triangles = geometry::triangles_of(piece.mesh);
    surface.insert(surface.end(), triangles.begin(), triangles.end());
    if (piece.closed) {
      closed.insert(closed.end(), triangles.begin(), triangles.end());
      continue;
    }
    Shape hull;
    hull.kind = ShapeKind::hull;
    hull.hull = make_reduced_hull(piece.mesh.vertices);
    convex.emplace_back(hull, Pose{});
  }
}

double WholeBody::volume() const {
  if (closed.empty() && convex.size() == 1) return convex.front().volume();
  return overlap_of(convex, closed, {}).body;
}

}  // namespace touchstone::proxies
