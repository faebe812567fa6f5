// CGAL's AABB tree with rays and segments.
// Paper:   Alliez, Tayeb, Wormser, "3D fast intersection and distance computation", CGAL 5.5,
//          AABB_tree::first_intersection and do_intersect; the kernel has exact predicates and
//          inexact constructions (EPICK). CGAL is under the GNU General Public License, and so is a
//          program with this file in it; TOUCHSTONE_WITH_CGAL=OFF leaves it out.
// Departs: the ray's second point is origin + direction, rounded; with t_max, `any` asks for a segment,
//          and `closest` leaves out what is found beyond. Degenerate triangles, which CGAL does not
//          allow, are left out. Points, and so t, u and v, are constructed in doubles.
// Fails:   where t is nearly the same for two triangles, rounded points decide which is first.
// Cost:    O(log n) a ray where triangles are small; a binary tree.
#include "algorithms/ray_cast.h"
#ifdef TOUCHSTONE_HAS_CGAL
#include <algorithm>
#include <cmath>

#include "algorithms/peers/cgal_trees.h"
#include "algorithms/peers/rays/segment_rays.h"

namespace touchstone {
namespace {

using namespace cgal;

Vec3d from_cgal(const Point& p) { return {p.x(), p.y(), p.z()}; }

class CgalRayCast final : public RayCast {
 public:
  void bind(const TriangleMesh& mesh) override {
    mesh_ = &mesh;
    tree_.clear();
    triangles_.clear();
    numbers_.clear();
    for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
      const auto& [a, b, c] = mesh.triangles[k];
      Kernel::Triangle_3 triangle(to_point(mesh.vertices[a]), to_point(mesh.vertices[b]),
                                  to_point(mesh.vertices[c]));
      if (triangle.is_degenerate()) continue;
      triangles_.push_back(triangle);
      numbers_.push_back(k);
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }

  void cast(RayTask task, std::span<const Ray> rays, std::span<RayHit> hits) override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits[i] = task == RayTask::any ? any(rays[i]) : closest(rays[i]);
    }
  }

 private:
  RayHit any(const Ray& ray) const {
    RayHit hit;
    hit.status = Status::not_reported;
    const Point from = to_point(ray.origin);
    if (std::isinf(ray.t_max)) {
      hit.hit = tree_.do_intersect(Kernel::Ray_3(from, to_point(ray.origin + ray.direction)));
    } else {
      const Vec3d end = ray.origin + ray.t_max * ray.direction;
      hit.hit = tree_.do_intersect(Kernel::Segment_3(from, to_point(end)));
    }
    return hit;
  }

  RayHit closest(const Ray& ray) const {
    RayHit hit;
    hit.status = Status::not_reported;
    const auto found = tree_.first_intersection(
        Kernel::Ray_3(to_point(ray.origin), to_point(ray.origin + ray.direction)));
    if (!found) return hit;
    double t = std::numeric_limits<double>::infinity();
    const auto take = [&](const Point& p) {
      t = std::min(t, (from_cgal(p) - ray.origin).dot(ray.direction) / ray.direction.squaredNorm());
    };
    if (const auto* point = boost::get<Point>(&found->first)) {
      take(*point);
    } else if (const auto* part = boost::get<Kernel::Segment_3>(&found->first)) {
      take(part->source());
      take(part->target());
    }
    if (!(t <= ray.t_max)) return hit;
    hit.hit = true;
    hit.t = t;
    hit.triangle = numbers_[static_cast<std::size_t>(found->second - triangles_.begin())];
    set_weights(*mesh_, ray, hit);
    return hit;
  }

  const TriangleMesh* mesh_ = nullptr;
  Triangles triangles_;
  std::vector<std::uint32_t> numbers_;  // of the triangles, in the mesh
  Tree tree_;
};

std::unique_ptr<RayCast> make_cast(const RayCastSettings&) {
  return std::make_unique<CgalRayCast>();
}

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<RayCastEntry> peers_cgal_ray_cast() {
  return {{.info = {.name = "cgal-aabb-tree",
                    .citation = "CGAL 5.5, AABB_tree::first_intersection and do_intersect, EPICK "
                                "(Alliez, Tayeb, Wormser)",
                    .origin = Origin::peer,
                    .known_defect = "leaves out degenerate triangles; the ray's second point, and "
                                    "t, are rounded"},
           .tasks = {RayTask::closest, RayTask::any},
           .scalars = {Precision::float64},
           .make = make_cast}};
}

}  // namespace touchstone::entries
