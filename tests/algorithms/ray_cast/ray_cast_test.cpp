// Ray casts that say that their verdicts are exact, against the oracle.
#include "algorithms/ray_cast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/core/nearest_float.h"
#include "algorithms/registry.h"
#include "harness/families/aimed_queries.h"
#include "harness/families/meshes.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

constexpr Precision scalars_of_casts[] = {Precision::float32, Precision::float64};

std::vector<RayHit> cast_by(const RayCastEntry& entry, Precision scalar, RayTask task,
                            const TriangleMesh& mesh, const std::vector<Ray>& rays) {
  const auto cast = entry.make({scalar});
  cast->bind(mesh);
  std::vector<RayHit> hits(rays.size());
  cast->cast(task, rays, hits);
  return hits;
}

std::vector<RayHit> exact_hits(Precision scalar, const TriangleMesh& mesh,
                               const std::vector<Ray>& rays) {
  return cast_by(*registry::find<RayCastEntry>("exact"), scalar, RayTask::closest, mesh, rays);
}

std::vector<const RayCastEntry*> exact_casts() {
  std::vector<const RayCastEntry*> all;
  for (const RayCastEntry& entry : registry::entries<RayCastEntry>()) {
    if (entry.exact_verdicts && entry.info.origin == Origin::ours) all.push_back(&entry);
  }
  return all;
}

Vec3d stored(const Vec3d& v, Precision scalar) {
  return scalar == Precision::float64 ? v : nearest_float(v);
}

// The hit's own point on the ray, and on the triangle, agree to a part of the way to its vertices.
void expect_point(const RayHit& hit, const Ray& ray, const TriangleMesh& mesh, Precision scalar) {
  const auto& [i, j, k] = mesh.triangles[hit.triangle];
  const Vec3d a = stored(mesh.vertices[i], scalar), b = stored(mesh.vertices[j], scalar),
              c = stored(mesh.vertices[k], scalar);
  const Vec3d origin = stored(ray.origin, scalar);
  const Vec3d at = origin + hit.t * stored(ray.direction, scalar);
  const double reach = (a - origin).norm() + (b - origin).norm() + (c - origin).norm() + at.norm();
  EXPECT_LE((a + hit.u * (b - a) + hit.v * (c - a) - at).norm(), 1e-7 * reach);
  EXPECT_GE(hit.t, 0);
  EXPECT_GE(std::min({hit.u, hit.v, 1 - hit.u - hit.v}), -1e-12);
}

struct Outcomes {
  int hits = 0, misses = 0;
};

void expect_exact(const TriangleMesh& mesh, const std::vector<Ray>& rays, Outcomes& outcomes) {
  for (const Precision scalar : scalars_of_casts) {
    const std::vector<RayHit> expected = exact_hits(scalar, mesh, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ++(expected[i].hit ? outcomes.hits : outcomes.misses);
      if (expected[i].hit) expect_point(expected[i], rays[i], mesh, scalar);
    }
    for (const RayCastEntry* entry : exact_casts()) {
      const bool has_levels = entry->info.name == "wide-bvh";
      for (const Isa level : has_levels ? isa_levels() : std::vector{isa_of_machine()}) {
        limit_isa(level);
        const auto closest = cast_by(*entry, scalar, RayTask::closest, mesh, rays);
        const auto any = cast_by(*entry, scalar, RayTask::any, mesh, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
          SCOPED_TRACE(entry->info.name + " " + std::string(to_string(scalar)) + " ray " +
                       std::to_string(i) + " " + std::string(to_string(level)));
          ASSERT_EQ(closest[i].status, Status::ok);
          ASSERT_EQ(closest[i].hit, expected[i].hit);
          ASSERT_EQ(closest[i].triangle, expected[i].triangle);
          ASSERT_EQ(any[i].hit, expected[i].hit);
          if (!expected[i].hit) continue;
          const double reach =
              std::abs(expected[i].t) + 1e-3 / rays[i].direction.lpNorm<Eigen::Infinity>();
          ASSERT_NEAR(closest[i].t, expected[i].t, 1e-9 * reach);
          ASSERT_LE(closest[i].t, rays[i].t_max * (1 + 1e-6));
          ASSERT_GE(any[i].t, expected[i].t - 1e-9 * reach);
          expect_point(closest[i], rays[i], mesh, scalar);
          expect_point(any[i], rays[i], mesh, scalar);
        }
      }
      limit_isa(isa_of_machine());
    }
  }
}

TEST(RayCasts, AimedAtVerticesEdgesAndFacesAreExact) {
  Outcomes outcomes;
  for (const auto& [name, mesh] : families::ray_meshes()) {
    SCOPED_TRACE(name);
    const double most = drawn(24, 4);
    const double share =
        most / static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1));
    expect_exact(mesh, families::aimed_rays(mesh, share, 11), outcomes);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(outcomes.hits, 1000 / one_in);
  EXPECT_GT(outcomes.misses, 1000 / one_in);
}

TEST(RayCasts, TogetherAreExact) {
  Outcomes outcomes;
  for (const auto& [name, mesh] : families::ray_meshes()) {
    SCOPED_TRACE(name);
    expect_exact(mesh, families::rays_in_sixteens(mesh, drawn(8, 2), 23), outcomes);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(outcomes.hits, 500 / one_in);
  EXPECT_GT(outcomes.misses, 200 / one_in);
}

TEST(RayCasts, InAnyDirectionAreExact) {
  Outcomes outcomes;
  for (const auto& [name, mesh] : families::ray_meshes()) {
    SCOPED_TRACE(name);
    expect_exact(mesh, families::random_rays(mesh, drawn(300, 30), 13), outcomes);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(outcomes.hits, 1000 / one_in);
  EXPECT_GT(outcomes.misses, 1000 / one_in);
}

// A closed surface is hit from inside wherever it is aimed at: at each vertex, pole and edge.
TEST(RayCasts, NoneSlipsOutOfAClosedMesh) {
  TriangleMesh mesh = families::ellipsoid_mesh({3, 2, 1}, 160, 80);
  for (const bool rounded : {true, false}) {
    // Scaled by a third, no coordinate is a float.
    if (!rounded) mesh = families::moved(mesh, 1 / 3.0, {0, 0, 0});
    std::vector<Ray> rays;
    families::RandomDraws random(17);
    for (const auto& triangle : mesh.triangles) {
      if (random.below(5 * one_in) != 0) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d from = random.vector(0.1);
        const Vec3d& a = mesh.vertices[triangle[k]];
        const Vec3d& b = mesh.vertices[triangle[(k + 1) % 3]];
        const double s = random.uniform(0, 1);
        rays.push_back({from, a - from});
        rays.push_back({from, a + s * (b - a) - from});
      }
    }
    for (const Precision scalar : scalars_of_casts) {
      for (const RayTask task : {RayTask::closest, RayTask::any}) {
        for (const RayHit& hit :
             cast_by(*registry::find<RayCastEntry>("wide-bvh"), scalar, task, mesh, rays)) {
          ASSERT_TRUE(hit.hit);
        }
      }
    }
  }
}

TEST(RayCasts, SayWhatRaysAreNone) {
  const TriangleMesh mesh = families::ellipsoid_mesh({2, 2, 2}, 8, 6);
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Ray> improper = {{{0, 0, 0}, {0, 0, 0}},   {{nan, 0, 0}, {1, 0, 0}},
                                     {{0, 0, 0}, {1, nan, 0}}, {{inf, 0, 0}, {1, 0, 0}},
                                     {{0, 0, 0}, {0, inf, 0}}, {{0, 0, 0}, {1, 0, 0}, nan}};
  const std::vector<Ray> behind = {{{0, 0, 0}, {1, 0, 0}, -1}, {{0, 0, 0}, {1, 0, 0}, -inf}};
  for (const RayCastEntry& entry : registry::entries<RayCastEntry>()) {
    if (!entry.exact_verdicts) continue;
    for (const RayHit& hit : cast_by(entry, Precision::float64, RayTask::closest, mesh, improper)) {
      EXPECT_FALSE(hit.hit) << entry.info.name;
      EXPECT_EQ(hit.status, Status::degenerate) << entry.info.name;
      EXPECT_TRUE(std::isnan(hit.t));
    }
    for (const RayHit& hit : cast_by(entry, Precision::float64, RayTask::any, mesh, behind)) {
      EXPECT_FALSE(hit.hit) << entry.info.name;
      EXPECT_EQ(hit.status, Status::ok) << entry.info.name;
    }
  }
}

// Sizes from 2^-90 to 2^90, alone and within one mesh; and beyond those, a status.
TEST(RayCasts, OfAnySizeAreExact) {
  Outcomes outcomes;
  for (const double scale : {0x1p-90, 0x1p-40, 1e9, 0x1p90}) {
    const TriangleMesh mesh =
        families::moved(families::ellipsoid_mesh({2, 2, 2}, 8, 6), scale, {0, 0, 0});
    std::vector<Ray> rays;
    for (Ray ray : families::aimed_rays(families::ellipsoid_mesh({2, 2, 2}, 8, 6), 0.2, 19)) {
      ray.origin *= scale;
      if (ray.t_max > 1) ray.direction *= scale;
      rays.push_back(ray);
    }
    expect_exact(mesh, rays, outcomes);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(outcomes.hits, 100 / one_in);
  EXPECT_GT(outcomes.misses, 100 / one_in);
  // A vertex straight ahead, in numbers whose products vanish.
  const TriangleMesh tiny =
      families::moved(families::ellipsoid_mesh({2, 2, 2}, 8, 6), 0x1p-400, {0, 0, 0});
  const std::vector<Ray> ahead = {{{0, 0, 0}, {0, 0, 1}}};
  EXPECT_TRUE(exact_hits(Precision::float64, tiny, ahead)[0].hit);
  for (const RayCastEntry* entry : exact_casts()) {
    const RayHit hit = cast_by(*entry, Precision::float64, RayTask::closest, tiny, ahead)[0];
    EXPECT_TRUE(hit.hit || hit.status == Status::degenerate) << entry->info.name;
  }
}

}  // namespace
}  // namespace touchstone
