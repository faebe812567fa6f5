// CGAL's AABB tree with points: the closest point, and the side of a closed surface.
// Paper:   Alliez, Tayeb, Wormser, "3D fast intersection and distance computation", CGAL 5.5,
//          AABB_tree::closest_point_and_primitive, and Side_of_triangle_mesh; the kernel has exact predicates
//          and inexact constructions (EPICK). CGAL is under the GNU General Public License, and so is a
//          program with this file in it; TOUCHSTONE_WITH_CGAL=OFF leaves it out.
// Departs: degenerate triangles, which CGAL does not allow, are left out of `closest`. `side` takes closed
//          surfaces on which each edge has two triangles, none of them degenerate; others are
//          `unsupported`.
// Fails:   closest points are constructed in doubles. The side is by parity, so a point around which the surface
//          winds twice is outside.
// Cost:    O(log n) a point; a binary tree.
#include "algorithms/point_query.h"
#ifdef TOUCHSTONE_HAS_CGAL
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include "algorithms/peers/cgal_trees.h"

namespace touchstone {
namespace {

using namespace cgal;
using PointSurface = CGAL::Surface_mesh<Point>;

class CgalPointQuery final : public PointQuery {
 public:
  void bind(const TriangleMesh& mesh) override {
    tree_.clear();
    triangles_.clear();
    numbers_.clear();
    sides_.reset();
    surface_.clear();
    std::vector<PointSurface::Vertex_index> vertices;
    for (const Vec3d& v : mesh.vertices) vertices.push_back(surface_.add_vertex(to_point(v)));
    bool valid = true;
    for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
      const auto& [a, b, c] = mesh.triangles[k];
      const Kernel::Triangle_3 triangle(to_point(mesh.vertices[a]), to_point(mesh.vertices[b]),
                                        to_point(mesh.vertices[c]));
      if (triangle.is_degenerate()) {
        valid = false;
        continue;
      }
      triangles_.push_back(triangle);
      numbers_.push_back(k);
      valid = valid &&
              surface_.add_face(vertices[a], vertices[b], vertices[c]) != PointSurface::null_face();
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
    if (valid && !triangles_.empty() && CGAL::is_closed(surface_)) sides_.emplace(surface_);
  }

  void query(PointTask task, std::span<const Vec3d> points,
             std::span<PointAnswer> answers) override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      answers[i] = {};
      if (!points[i].allFinite()) {
        answers[i].status = Status::degenerate;
      } else if (task == PointTask::closest) {
        find_closest(points[i], answers[i]);
      } else if (sides_) {
        find_side(points[i], answers[i]);
      }
    }
  }

 private:
  void find_closest(const Vec3d& point, PointAnswer& answer) const {
    answer.status = Status::not_reported;
    if (triangles_.empty()) return;
    const auto [at, of] = tree_.closest_point_and_primitive(to_point(point));
    answer.closest = Vec3d(at.x(), at.y(), at.z());
    answer.triangle = numbers_[static_cast<std::size_t>(of - triangles_.begin())];
    answer.distance = (answer.closest - point).stableNorm();
  }

  void find_side(const Vec3d& point, PointAnswer& answer) const {
    answer.status = Status::not_reported;
    switch ((*sides_)(to_point(point))) {
      case CGAL::ON_BOUNDED_SIDE: answer.side = PointSide::inside; break;
      case CGAL::ON_BOUNDARY: answer.side = PointSide::surface; break;
      case CGAL::ON_UNBOUNDED_SIDE: answer.side = PointSide::outside; break;
    }
  }

  Triangles triangles_;
  std::vector<std::uint32_t> numbers_;  // of the triangles, in the mesh
  Tree tree_;
  PointSurface surface_;
  std::optional<CGAL::Side_of_triangle_mesh<PointSurface, Kernel>> sides_;
};

std::unique_ptr<PointQuery> make_cgal_points() { return std::make_unique<CgalPointQuery>(); }

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<PointQueryEntry> peers_cgal_point_query() {
  return {{.info = {.name = "cgal-aabb-tree",
                    .citation = "CGAL 5.5, AABB_tree::closest_point_and_primitive and "
                                "Side_of_triangle_mesh, EPICK (Alliez, Tayeb, Wormser)",
                    .origin = Origin::peer,
                    .known_defect = "leaves out degenerate triangles; closest points are rounded; "
                                    "the side is by parity"},
           .tasks = {PointTask::closest, PointTask::side},
           .make = make_cgal_points}};
}

}  // namespace touchstone::entries
