// Wide BVH: the nearest of eight boxes at once, and the side of a surface by exact signs.
// Paper:   Wald, Benthin, Boulos, "Getting rid of packets", RT 2008 (wide nodes); Ericson, "Real-time
//          collision detection", 2005, 5.1 (closest points); Edelsbrunner, Muecke, "Simulation of
//          simplicity", TOG 9, 1990; Shewchuk, DCG 18, 1997.
// Steps:   1. `bind` builds the tree that wide-bvh casts rays with (kernels/rays).
//          2. `closest` walks the nodes from near to far while a box is nearer than the best point. Of a leaf's
//             eight triangles, floats find near points, and planes across the way to them that prove how far
//             the triangles are; what is left is decided in doubles (nearest_walk).
//          3. `side` knows points outside of the mesh's box. For others it counts the triangles above the
//             point that turn up less those that turn down: by floats where they are certain, by signs that
//             are filtered in doubles where they are not, and exactly where that decides nothing
//             (winding_walk, winding_query).
// Fails:   the distance is that of a rounded point, off by up to 4e-15 of the coordinates' size. The
//          status of `side` is `degenerate` where numbers beyond 2^-120 or 2^120 are in doubt.
// Cost:    O(log n) a point near the surface; more where much of it is equally far.
#include <algorithm>
#include <optional>
#include <vector>

#include "algorithms/kernels/rays/points/nearest_walk.h"
#include "algorithms/kernels/rays/points/winding_query.h"
#include "algorithms/kernels/rays/ray_walk.h"
#include "algorithms/point_query.h"

namespace touchstone {
namespace {

using ray_tree::RayMesh;

class WideBvhPoints final : public PointQuery {
 public:
  void bind(const TriangleMesh& mesh) override {
    mesh_.emplace(mesh, Precision::float64);
    low_ = high_ = mesh.vertices.empty() ? Vec3d(Vec3d::Zero()) : mesh.vertices.front();
    for (const Vec3d& vertex : mesh.vertices) {
      low_ = low_.cwiseMin(vertex);
      high_ = high_.cwiseMax(vertex);
    }
  }

  void query(PointTask task, std::span<const Vec3d> points,
             std::span<PointAnswer> answers) override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      answers[i] = {};
      answers[i].status = points[i].allFinite() ? Status::ok : Status::degenerate;
      if (task == PointTask::closest && answers[i].status == Status::ok && mesh_->triangles() > 0) {
        const ray_tree::Nearest found = ray_tree::nearest_of(*mesh_, points[i]);
        answers[i].triangle = found.triangle;
        answers[i].closest = found.closest;
        answers[i].distance = (points[i] - found.closest).stableNorm();
      }
    }
    if (task == PointTask::side) find_sides(points, answers);
  }

 private:
  // Points that are finite: those outside of the mesh's box at once, and others by the triangles above
  // them, block by block.
  void find_sides(std::span<const Vec3d> points, std::span<PointAnswer> answers) const {
    std::vector<WindingQuery> queries;
    std::vector<PointAnswer*> asked;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool is_outside =
          (points[i].array() < low_.array()).any() || (points[i].array() > high_.array()).any();
      if (answers[i].status == Status::ok && is_outside) {
        answers[i].side = PointSide::outside;
      } else if (answers[i].status == Status::ok) {
        queries.emplace_back(points[i]);
        asked.push_back(&answers[i]);
      }
      if (queries.size() == ray_tree::RayBlock::most ||
          (i + 1 == points.size() && !queries.empty())) {
        if (mesh_->triangles() > 0) ray_tree::wind_each(*mesh_, queries);
        for (std::size_t k = 0; k < queries.size(); ++k) {
          if (queries[k].is_undecided()) {
            asked[k]->status = Status::degenerate;
          } else {
            asked[k]->side = queries[k].is_on_surface()  ? PointSide::surface
                             : queries[k].winding() != 0 ? PointSide::inside
                                                         : PointSide::outside;
          }
        }
        queries.clear();
        asked.clear();
      }
    }
  }

  std::optional<RayMesh> mesh_;
  Vec3d low_ = Vec3d::Zero(), high_ = Vec3d::Zero();  // of the box around its vertices
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<PointQueryEntry> point_query_wide_bvh_points() {
  return {{.info = {.name = "wide-bvh",
                    .citation = "Wald, Benthin, Boulos, RT 2008; Ericson 2005; Edelsbrunner, "
                                "Muecke, TOG 9, 1990; exact by Shewchuk's expansions"},
           .tasks = {PointTask::closest, PointTask::side},
           .make = [] { return std::make_unique<WideBvhPoints>(); }}};
}

}  // namespace touchstone::entries
