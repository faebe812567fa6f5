// The peers' ray casts, and moller-trumbore: on rays in any direction they agree with the oracle but
// for rays near edges.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "algorithms/registry.h"
#include "harness/families/aimed_queries.h"
#include "harness/families/meshes.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

std::vector<RayHit> asked(const RayCastEntry& entry, Precision scalar, RayTask task,
                          const TriangleMesh& mesh, const std::vector<Ray>& rays) {
  const auto cast = entry.make({scalar});
  cast->bind(mesh);
  std::vector<RayHit> hits(rays.size());
  cast->cast(task, rays, hits);
  return hits;
}

TEST(ApproximateRayCasts, AgreeOnRaysInAnyDirection) {
  for (const RayCastEntry& entry : registry::entries<RayCastEntry>()) {
    if (entry.exact_verdicts || !is_built(entry.info)) continue;
    for (const auto& [name, mesh] : families::ray_meshes()) {
      // Only of these are all triangles such that every library takes them.
      if (name != "none" && name != "one" && name != "ball" && name != "terrain") continue;
      SCOPED_TRACE(entry.info.name + " " + name);
      const auto rays = families::random_rays(mesh, drawn(1000, 100), 23);
      for (const Precision scalar : entry.scalars) {
        const auto exact =
            asked(*registry::find<RayCastEntry>("exact"), scalar, RayTask::closest, mesh, rays);
        for (const RayTask task : entry.tasks) {
          const auto hits = asked(entry, scalar, task, mesh, rays);
          int found = 0, missed = 0, wrong = 0;
          for (std::size_t i = 0; i < rays.size(); ++i) {
            ++(exact[i].hit ? found : missed);
            const bool is_same = hits[i].hit == exact[i].hit &&
                                 (task == RayTask::any || hits[i].triangle == exact[i].triangle);
            if (!is_same) {
              ++wrong;
            } else if (exact[i].hit && task == RayTask::closest) {
              EXPECT_NEAR(hits[i].t, exact[i].t, 1e-4 * (1 + exact[i].t)) << i;
              EXPECT_NEAR(hits[i].u, exact[i].u, 1e-2) << i;
              EXPECT_NEAR(hits[i].v, exact[i].v, 1e-2) << i;
            }
          }
          EXPECT_LE(wrong, static_cast<int>(rays.size()) / 200);
          if (mesh.triangles.size() > 1) {
            EXPECT_GT(found, 20 / one_in);
            EXPECT_GT(missed, 20 / one_in);
          }
        }
      }
    }
  }
}

TEST(ApproximateRayCasts, AreBoundAgain) {
  const std::vector<Ray> down = {{{0.25, 0.25, 9}, {0, 0, -1}}};
  for (const RayCastEntry& entry : registry::entries<RayCastEntry>()) {
    if (!is_built(entry.info)) continue;
    const auto cast = entry.make({entry.scalars.front()});
    RayHit hit;
    for (const bool is_there : {true, false, true}) {
      const TriangleMesh mesh = is_there ? families::terrain_mesh(3, 1, 5) : TriangleMesh{};
      cast->bind(mesh);
      cast->cast(RayTask::closest, down, {&hit, 1});
      EXPECT_EQ(hit.hit, is_there) << entry.info.name;
    }
  }
}

}  // namespace
}  // namespace touchstone
