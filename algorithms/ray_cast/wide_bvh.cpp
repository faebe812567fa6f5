// Wide BVH: a tree with eight children a node, eight triangles a leaf, one ray at a time.
// Paper:   Wald, Benthin, Boulos, "Getting rid of packets", RT 2008 (wide nodes); Woop, Benthin, Wald,
//          "Watertight ray/triangle intersection", JCGT 2, 2013; Ize, "Robust BVH ray traversal",
//          JCGT 2, 2013; Shewchuk, DCG 18, 1997 (expansions).
// Steps:   1. `bind` builds the tree by surface area, and copies the triangles of each leaf side by
//             side, in floats of a frame in which the mesh is about 1 in size (ray_mesh).
//          2. A ray is brought to that frame, its origin to where it comes near (ray_walk.cpp).
//          3. A node's eight boxes are met at once; children are walked from near to far (ray_walk.inl).
//          4. A leaf's eight triangles are sheared at once. A bound on the rounding of floats leaves
//             those out that are missed for certain, or too far.
//          5. Each other one is tested in doubles with a bound of its own, and by expansions where
//             that decides nothing (kernels/rays).
// Departs: the papers' tests are watertight, so that no ray slips between triangles, but wrong by
//          roundings about which triangle is hit and where a mesh ends. Here no verdict is wrong.
// Fails:   the status is `degenerate` where numbers beyond 2^-120 or 2^120 are in doubt. From 2^30
//          times the mesh's size away, every triangle is tested.
// Cost:    O(log n) a ray where triangles are small; a ray at an edge or a vertex costs some
//          microseconds more. 46 bytes a triangle besides the mesh.
#include <algorithm>
#include <array>
#include <optional>

#include "algorithms/kernels/rays/ray_walk.h"
#include "algorithms/ray_cast.h"

namespace touchstone {
namespace {

class WideBvhCast final : public RayCast {
 public:
  explicit WideBvhCast(Precision scalar) : scalar_(scalar) {}

  void bind(const TriangleMesh& mesh) override { mesh_.emplace(mesh, scalar_); }

  void cast(RayTask task, std::span<const Ray> rays, std::span<RayHit> hits) override {
    constexpr std::size_t most = ray_tree::RayBlock::most;
    std::array<Ray, most> rounded;
    for (std::size_t first = 0; first < rays.size(); first += most) {
      std::span<const Ray> some = rays.subspan(first, std::min(most, rays.size() - first));
      if (scalar_ == Precision::float32) {
        std::ranges::transform(some, rounded.begin(), rounded_to_float);
        some = std::span(rounded).first(some.size());
      }
      ray_tree::cast_each(*mesh_, task, some, hits.subspan(first, some.size()));
    }
  }

 private:
  Precision scalar_;
  std::optional<ray_tree::RayMesh> mesh_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<RayCastEntry> ray_cast_wide_bvh() {
  return {{.info = {.name = "wide-bvh",
                    .citation = "Wald, Benthin, Boulos, \"Getting rid of packets\", RT 2008; Woop, "
                                "Benthin, Wald, JCGT 2, 2013; exact by Shewchuk's expansions"},
           .tasks = {RayTask::closest, RayTask::any},
           .scalars = {Precision::float32, Precision::float64},
           .exact_verdicts = true,
           .make = [](const RayCastSettings& settings) {
             return std::make_unique<WideBvhCast>(settings.scalar);
           }}};
}

}  // namespace touchstone::entries
