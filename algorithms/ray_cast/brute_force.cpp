// Brute force: each ray is tested against every triangle.
// Paper:   the test of a triangle is that of kernels/rays: Woop, Benthin, Wald, JCGT 2, 2013, with a
//          bound on the rounding, and Shewchuk's expansions (1997) where it decides nothing.
// Steps:   1. Offer each triangle to the ray's query.
// Fails:   the status is `degenerate` where numbers beyond 2^-120 or 2^120 are in doubt.
// Cost:    O(n) a ray, about 30 ns a triangle; no build, no memory.
#include "algorithms/core/nearest_float.h"
#include "algorithms/kernels/rays/ray_query.h"
#include "algorithms/ray_cast.h"

namespace touchstone {
namespace {

class BruteForce final : public RayCast {
 public:
  explicit BruteForce(Precision scalar) : scalar_(scalar) {}

  void bind(const TriangleMesh& mesh) override {
    triangles_ = &mesh.triangles;
    vertices_ = mesh.vertices;
    if (scalar_ == Precision::float64) return;
    for (Vec3d& v : vertices_) v = nearest_float(v);
  }

  void cast(RayTask task, std::span<const Ray> rays, std::span<RayHit> hits) override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = answer(task, rays[i]);
  }

 private:
  RayHit answer(RayTask task, const Ray& given) const {
    const Ray ray = scalar_ == Precision::float64 ? given : rounded_to_float(given);
    if (!is_proper(ray)) return improper_hit();
    RayQuery query(ray);
    for (std::uint32_t k = 0; k < triangles_->size(); ++k) {
      const auto& [a, b, c] = (*triangles_)[k];
      const bool hit = query.offer(k, vertices_[a], vertices_[b], vertices_[c]);
      if (hit && task == RayTask::any) break;
    }
    return query.hit();
  }

  Precision scalar_;
  const std::vector<std::array<std::uint32_t, 3>>* triangles_ = nullptr;
  std::vector<Vec3d> vertices_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<RayCastEntry> ray_cast_brute_force() {
  return {
      {.info = {.name = "brute-force",
                .citation = "Every triangle, by Woop, Benthin, Wald's test (JCGT 2, 2013), exact "
                            "by Shewchuk's expansions"},
       .tasks = {RayTask::closest, RayTask::any},
       .scalars = {Precision::float32, Precision::float64},
       .exact_verdicts = true,
       .make = [](const RayCastSettings& settings) {
         return std::make_unique<BruteForce>(settings.scalar);
       }}};
}

}  // namespace touchstone::entries
