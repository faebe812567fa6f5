// Exact: rays against triangles in integers, behind the contract of ray casts.
// Paper:   none; textbook geometry in integers without a bound on their length (ray_triangle).
// Steps:   1. Leave out the triangles that the ray passes for certain (box_tree).
//          2. Ask ray_triangle for the first point of the ray in each of the others.
//          3. Compare the fractions, and keep the least, of the lowest number.
// Departs: it shares no code with the algorithms that it judges.
// Fails:   never; t, u and v are rounded once.
// Cost:    O(log n) a ray where triangles are small, and some microseconds for each that may be hit.
#include "algorithms/core/nearest_float.h"
#include "algorithms/oracle/rays/box_tree.h"
#include "algorithms/oracle/rays/ray_triangle.h"
#include "algorithms/ray_cast.h"

namespace touchstone {
namespace {

class ExactRayCast final : public RayCast {
 public:
  explicit ExactRayCast(Precision scalar) : scalar_(scalar) {}

  void bind(const TriangleMesh& mesh) override {
    triangles_ = &mesh.triangles;
    vertices_ = mesh.vertices;
    for (Vec3d& v : vertices_) v = rounded(v);
    tree_.build(vertices_, mesh.triangles);
  }

  void cast(RayTask, std::span<const Ray> rays, std::span<RayHit> hits) override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest(rays[i]);
  }

 private:
  Vec3d rounded(const Vec3d& v) const {
    return scalar_ == Precision::float64 ? v : nearest_float(v);
  }

  RayHit closest(const Ray& ray) {
    const Vec3d origin = rounded(ray.origin), direction = rounded(ray.direction);
    const double t_max = scalar_ == Precision::float64 ? ray.t_max : nearest_float(ray.t_max);
    RayHit hit;
    const bool finite = origin.allFinite() && direction.allFinite();
    if (!finite || direction.isZero(0) || !(t_max >= 0 || t_max < 0)) {
      hit.status = Status::degenerate;
      return hit;
    }
    hit.status = Status::ok;
    if (!(t_max >= 0)) return hit;
    std::optional<oracle::RayPoint> best;
    tree_.meet_ray(origin, direction, asked_);
    for (const std::uint32_t k : asked_) {
      const auto& [a, b, c] = (*triangles_)[k];
      auto point =
          oracle::first_point(origin, direction, {vertices_[a], vertices_[b], vertices_[c]});
      if (!point) continue;
      if (t_max <= std::numeric_limits<double>::max() && compare_t(*point, t_max) > 0) continue;
      if (best && compare_t(*point, *best) >= 0) continue;
      best = std::move(point);
      hit.triangle = k;
    }
    if (!best) return hit;
    hit.hit = true;
    hit.t = oracle::quotient(best->top, best->bottom);
    hit.u = best->u;
    hit.v = best->v;
    return hit;
  }

  Precision scalar_;
  const std::vector<std::array<std::uint32_t, 3>>* triangles_ = nullptr;
  std::vector<Vec3d> vertices_;
  oracle::BoxTree tree_;
  std::vector<std::uint32_t> asked_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<RayCastEntry> oracle_exact_ray_cast() {
  return {{.info = {.name = "exact",
                    .citation = "Touchstone's oracle: rays and triangles in integers",
                    .origin = Origin::oracle},
           .tasks = {RayTask::closest, RayTask::any},
           .scalars = {Precision::float32, Precision::float64},
           .exact_verdicts = true,
           .make = [](const RayCastSettings& settings) {
             return std::make_unique<ExactRayCast>(settings.scalar);
           }}};
}

}  // namespace touchstone::entries
