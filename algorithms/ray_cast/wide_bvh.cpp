// Wide BVH: a tree with eight children a node, eight triangles a leaf; rays alone, or together.
// Paper:   Wald, Benthin, Boulos, "Getting rid of packets", RT 2008 (wide nodes); Woop, Benthin, Wald,
//          "Watertight ray/triangle intersection", JCGT 2, 2013; Ize, "Robust BVH ray traversal",
//          JCGT 2, 2013; Reshetov, Soupikov, Hurley, SIGGRAPH 2005 (rays together); Shewchuk, DCG 18, 1997
//          (expansions).
// Steps:   1. `bind` builds the tree by surface area, and copies the triangles of each leaf side by
//             side, in floats of a frame in which the mesh is about 1 in size (ray_mesh).
//          2. Sixteen rays are brought to that frame in lanes, their origins to where they come near
//             (ray_block).
//          3. Rays that go the same way walk the tree together: bounds on them meet a node's eight boxes at
//             once, then each child's box meets all rays, and so does a triangle. Few rays that are
//             left go on alone (ray_packet).
//          4. Other rays walk two in turn, since a step waits for the one before it: a node's eight boxes,
//             or a leaf's eight triangles, at once, from near to far (ray_walk).
//          5. A bound on the rounding of floats tells which triangles are missed, or hit, for certain, and
//             which hit is first. Where it does not, doubles with a bound of their own decide, and
//             expansions where that proves nothing (ray_query).
//          6. t, u and v of what is hit are calculated in doubles, in lanes (ray_finish).
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
