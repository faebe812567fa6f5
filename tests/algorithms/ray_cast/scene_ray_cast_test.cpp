// Ray casts at scenes against the oracle: every kind of shape, compounds and meshes, under poses.
#include "algorithms/scene_ray_cast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "algorithms/registry.h"
#include "harness/families/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

std::vector<SceneRayHit> cast_by(const std::string& name, RayTask task,
                                 const std::vector<SceneBody>& bodies,
                                 const std::vector<Ray>& rays) {
  const auto cast = registry::find<SceneRayCastEntry>(name)->make();
  cast->bind(bodies);
  std::vector<SceneRayHit> hits(rays.size());
  cast->cast(task, rays, hits);
  return hits;
}

Shape shape_of(ShapeKind kind, reference::Random& random) {
  Shape shape;
  shape.kind = kind;
  shape.radius = random.uniform(0.2, 1);
  shape.half_length = random.uniform(0.2, 1.5);
  shape.half_extents = Vec3d::Constant(0.1) + random.vector(1).cwiseAbs();
  shape.radii = Vec3d::Constant(0.1) + random.vector(1).cwiseAbs();
  shape.normal = random.direction();
  shape.offset = random.uniform(-1, 1);
  if (kind == ShapeKind::hull) {
    std::vector<Vec3d> points;
    for (int i = 0; i < 12; ++i) points.push_back(random.vector(1));
    shape.hull = make_hull(points);
  }
  return shape;
}

Pose pose_of(reference::Random& random) {
  const Vec3d axis = random.direction();
  return {Eigen::AngleAxisd(random.uniform(0, 6), axis).toRotationMatrix(), random.vector(4)};
}

SceneBody body_of(const Shape& shape, const Pose& pose) {
  SceneBody body;
  body.body.parts.push_back({.shape = shape, .pose = {}});
  body.pose = pose;
  return body;
}

// Rays at points in and about the bodies.
std::vector<Ray> rays_at(const std::vector<SceneBody>& bodies, int count,
                         reference::Random& random) {
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const auto& at =
        bodies[static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())))];
    Ray ray{random.vector(8), Vec3d::UnitX(), i % 3 == 0 ? random.uniform(0, 2) : inf};
    ray.direction = at.pose.translation + random.vector(i % 2 == 0 ? 0.3 : 1.5) - ray.origin;
    if (i % 7 == 0) ray.origin = at.pose.translation;
    if (i % 11 == 0) ray.direction = {0, 0, i % 2 == 0 ? 1.0 : -2.0};
    rays.push_back(ray);
  }
  return rays;
}

struct SceneOutcomes {
  int hits = 0, misses = 0, unknown = 0, normals = 0;
};

void expect_as_exact(const std::vector<SceneBody>& bodies, const std::vector<Ray>& rays,
                     SceneOutcomes& outcomes) {
  const auto exact = cast_by("exact", RayTask::closest, bodies, rays);
  const auto closest = cast_by("wide-bvh", RayTask::closest, bodies, rays);
  const auto any = cast_by("wide-bvh", RayTask::any, bodies, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    SCOPED_TRACE("ray " + std::to_string(i));
    ASSERT_EQ(closest[i].status, Status::ok);
    if (exact[i].status != Status::ok) {
      ++outcomes.unknown;
      continue;
    }
    ++(exact[i].hit ? outcomes.hits : outcomes.misses);
    ASSERT_EQ(closest[i].hit, exact[i].hit);
    ASSERT_EQ(any[i].hit, exact[i].hit);
    if (!exact[i].hit) continue;
    const double reach = exact[i].t + 1e-3 / rays[i].direction.norm();
    ASSERT_NEAR(closest[i].t, exact[i].t, 1e-7 * reach);
    if (closest[i].t > 0) {
      // Points and segments have no normal.
      if (std::isnan(closest[i].normal[0])) continue;
      ++outcomes.normals;
      ASSERT_NEAR(closest[i].normal.norm(), 1, 1e-12);
      ASSERT_LE(closest[i].normal.dot(rays[i].direction), 1e-6 * rays[i].direction.norm());
    } else {
      ASSERT_EQ(exact[i].t, 0);
    }
  }
}

TEST(SceneRayCasts, AtEveryKindOfShapeAreAsTheOracleSays) {
  reference::Random random(5);
  for (const ShapeKind kind : all_shape_kinds) {
    SCOPED_TRACE(std::string(to_string(kind)));
    SceneOutcomes outcomes;
    for (int k = 0; k < drawn(3, 1); ++k) {
      const std::vector<SceneBody> bodies = {body_of(shape_of(kind, random), pose_of(random))};
      expect_as_exact(bodies, rays_at(bodies, 30, random), outcomes);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(outcomes.hits, 15 / one_in);
    EXPECT_GT(outcomes.normals, 5 / one_in);
    if (kind != ShapeKind::halfspace) {
      EXPECT_GT(outcomes.misses, 8 / one_in);
    }
    EXPECT_LT(outcomes.unknown, kind == ShapeKind::halfspace ? 1 : 10);
  }
}

// Shapes without an inside, and without a size on some axis.
TEST(SceneRayCasts, AtFlatShapesAreAsTheOracleSays) {
  SceneOutcomes outcomes;
  std::vector<Shape> shapes(5);
  shapes[0].kind = ShapeKind::box;
  shapes[0].half_extents = {1, 0, 2};
  shapes[1].kind = ShapeKind::capsule;
  shapes[1].half_length = 1;
  shapes[1].radius = 0.5;
  shapes[2] = hull_of({{0, 0, 1}, {2, 0, 1}, {0, 2, 1}, {2, 2, 1}});
  shapes[3] = hull_of({{0, 0, 1}, {2, 0, 1}});
  shapes[4] = hull_of({{0, 0, 1}});
  for (const Shape& shape : shapes) {
    std::vector<Ray> rays;
    for (const double x : {0.0, 0.5, 1.0, 2.0, 2.5}) {
      for (const double y : {-1.0, 0.0, 1.0, 2.0}) {
        rays.push_back({{x, y, 8}, {0, 0, -1}});
        rays.push_back({{x, -8, 1}, {0, 1, 0}});
        rays.push_back({{-8, y, 1}, {2, 0, 0}, 4});
      }
    }
    expect_as_exact({body_of(shape, {})}, rays, outcomes);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(outcomes.hits, 50);
  EXPECT_GT(outcomes.misses, 50);
}

// To the last bit: on the plane, an ulp above it, along it, and with t_max at the hit and an ulp before.
TEST(SceneRayCasts, AtHalfSpacesTheOracleIsExact) {
  Shape below;
  below.kind = ShapeKind::halfspace;
  below.normal = {0, 0, 2};
  below.offset = 1;
  const std::vector<SceneBody> bodies = {body_of(below, {Mat3d::Identity(), {7, 7, -1}})};
  const double above = std::nextafter(-0.5, 0);
  const std::vector<Ray> rays = {{{0, 0, 1.5}, {0, 0, -4}},
                                 {{0, 0, 1.5}, {3, 1, -4}, 0.5},
                                 {{0, 0, 1.5}, {3, 1, -4}, std::nextafter(0.5, 0)},
                                 {{0, 0, -0.5}, {0, 0, 1}},
                                 {{0, 0, above}, {1, 0, 0}},
                                 {{0, 0, above}, {0, 0, 1}},
                                 {{0, 0, above}, {1, 0, -1e-300}}};
  const std::vector<double> times = {0.5, 0.5, -1, 0, -1, -1, (above + 0.5) / 1e-300};
  const auto hits = cast_by("exact", RayTask::closest, bodies, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    SCOPED_TRACE("ray " + std::to_string(i));
    EXPECT_EQ(hits[i].status, Status::ok);
    EXPECT_EQ(hits[i].hit, times[i] >= 0);
    if (hits[i].hit) {
      EXPECT_DOUBLE_EQ(hits[i].t, times[i]);
    }
  }
}

// Many bodies of all kinds, compounds and a mesh, before and after they move.
TEST(SceneRayCasts, AtWholeScenesAreAsTheOracleSays) {
  reference::Random random(9);
  std::vector<SceneBody> bodies;
  for (int i = 0; i < 20; ++i) {
    const ShapeKind kind = all_shape_kinds[static_cast<std::size_t>(i) % 7];
    bodies.push_back(body_of(shape_of(kind, random), pose_of(random)));
    bodies.back().body.parts.push_back(
        {.shape = shape_of(ShapeKind::box, random), .pose = {Mat3d::Identity(), {1, 0, 0}}});
  }
  bodies.push_back(body_of(shape_of(ShapeKind::halfspace, random), {}));
  bodies.back().body.parts[0].shape.offset = -9;
  bodies.emplace_back();  // without parts
  SceneBody mesh;
  mesh.body.mesh = std::make_shared<TriangleMesh>(families::ellipsoid_mesh({1, 2, 1}, 8, 6));
  mesh.pose = pose_of(random);
  bodies.push_back(mesh);
  SceneOutcomes outcomes;
  const std::vector<Ray> rays = rays_at(bodies, drawn(40, 20), random);
  expect_as_exact(bodies, rays, outcomes);
  if (HasFatalFailure()) return;
  EXPECT_GT(outcomes.hits, 5);

  const auto cast = registry::find<SceneRayCastEntry>("wide-bvh")->make();
  cast->bind(bodies);
  std::vector<Pose> poses;
  for (SceneBody& body : bodies) {
    body.pose = pose_of(random);
    poses.push_back(body.pose);
  }
  cast->place(poses);
  std::vector<SceneRayHit> moved(rays.size());
  cast->cast(RayTask::closest, rays, moved);
  const auto anew = cast_by("wide-bvh", RayTask::closest, bodies, rays);
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(moved[i].hit, anew[i].hit);
    if (!anew[i].hit) continue;
    EXPECT_EQ(moved[i].t, anew[i].t);
    seen.insert(moved[i].body);
  }
  EXPECT_GT(seen.size(), 5u);
}

// Meshes under any pose leave nothing unknown.
TEST(SceneRayCasts, AtPlacedMeshesTheOracleAlwaysKnows) {
  reference::Random random(11);
  std::vector<SceneBody> bodies(3);
  for (SceneBody& body : bodies) {
    body.body.mesh = std::make_shared<TriangleMesh>(
        families::ellipsoid_mesh(Vec3d::Constant(0.5) + random.vector(1).cwiseAbs(), 12, 8));
    body.pose = pose_of(random);
  }
  SceneOutcomes outcomes;
  expect_as_exact(bodies, rays_at(bodies, drawn(400, 60), random), outcomes);
  EXPECT_EQ(outcomes.unknown, 0);
  EXPECT_GT(outcomes.hits, 150 / one_in);
  EXPECT_GT(outcomes.misses, 20 / one_in);
}

// Where a pose rounds nothing, rays at a placed mesh are those at the mesh itself, to the last bit: also
// rays through its vertices and along its edges.
TEST(SceneRayCasts, AtAMeshUnderAPoseThatRoundsNothingAreThoseAtTheMesh) {
  SceneBody body;
  body.body.mesh = std::make_shared<TriangleMesh>(families::ellipsoid_mesh({1, 2, 1}, 8, 6));
  const TriangleMesh& mesh = *body.body.mesh;
  body.pose.rotation << 0, -1, 0, 0, 0, 1, -1, 0, 0;
  body.pose.translation = {0, 0, 0};
  std::vector<Ray> rays, local;
  const auto add = [&](const Vec3d& origin, const Vec3d& direction) {
    local.push_back({origin, direction});
    rays.push_back({body.pose.rotation * origin, body.pose.rotation * direction});
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d& v = mesh.vertices[a];
    add(2 * v, -v);
    add(v, mesh.vertices[b] - v);
    add(2 * v + Vec3d::UnitX(), Vec3d::UnitY());
    add({0, 0, 4}, 0.5 * (mesh.vertices[b] + mesh.vertices[c]) - Vec3d(0, 0, 4));
  }
  const auto hits = cast_by("exact", RayTask::closest, {body}, rays);
  const auto cast = registry::find<RayCastEntry>("exact")->make({});
  cast->bind(mesh);
  std::vector<RayHit> truths(local.size());
  cast->cast(RayTask::closest, local, truths);
  int found = 0, missed = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    SCOPED_TRACE("ray " + std::to_string(i));
    ASSERT_EQ(hits[i].status, Status::ok);
    ASSERT_EQ(hits[i].hit, truths[i].hit);
    ++(hits[i].hit ? found : missed);
    if (!hits[i].hit) continue;
    EXPECT_EQ(hits[i].t, truths[i].t);
    EXPECT_EQ(hits[i].part, truths[i].triangle);
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(missed, 20);
}

TEST(SceneRayCasts, SayWhatRaysAreNoneAndMissWhatIsEmpty) {
  for (const SceneRayCastEntry& entry : registry::entries<SceneRayCastEntry>()) {
    const auto cast = entry.make();
    cast->bind({});
    std::vector<SceneRayHit> hits(2);
    const std::vector<Ray> rays = {{{0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}};
    cast->cast(RayTask::closest, rays, hits);
    EXPECT_EQ(hits[0].status, Status::degenerate) << entry.info.name;
    EXPECT_EQ(hits[1].status, Status::ok) << entry.info.name;
    EXPECT_FALSE(hits[0].hit || hits[1].hit) << entry.info.name;
  }
}

}  // namespace
}  // namespace touchstone
