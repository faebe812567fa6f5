// Point queries against the oracle.
#include "algorithms/point_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/registry.h"
#include "harness/families/aimed_queries.h"
#include "harness/families/meshes.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

std::vector<PointAnswer> answers_of(const PointQueryEntry& entry, PointTask task,
                                    const TriangleMesh& mesh, const std::vector<Vec3d>& points) {
  const auto query = entry.make();
  query->bind(mesh);
  std::vector<PointAnswer> answers(points.size());
  query->query(task, points, answers);
  return answers;
}

const PointQueryEntry& oracle_of_points() { return *registry::find<PointQueryEntry>("exact"); }

TEST(PointQueries, KnowTheirSideOfASurface) {
  std::array<int, 3> sides{};
  for (const auto& [name, mesh] : families::closed_meshes()) {
    SCOPED_TRACE(name);
    const double most = drawn(20, 4);
    const auto points = families::tried_points(
        mesh, most / static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1)), 3);
    const auto exact = answers_of(oracle_of_points(), PointTask::side, mesh, points);
    for (const PointAnswer& answer : exact) ++sides.at(static_cast<std::size_t>(answer.side));
    for (const PointQueryEntry& entry : registry::entries<PointQueryEntry>()) {
      if (entry.info.origin == Origin::peer) continue;
      for (const Isa level : isa_levels()) {
        limit_isa(level);
        const auto found = answers_of(entry, PointTask::side, mesh, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
          ASSERT_EQ(found[i].status, Status::ok) << entry.info.name << i;
          ASSERT_EQ(found[i].side, exact[i].side)
              << entry.info.name << ' ' << i << ' ' << points[i].transpose();
        }
        limit_isa(isa_of_machine());
        if (entry.info.origin == Origin::oracle) break;
      }
    }
  }
  for (const int count : sides) EXPECT_GT(count, 100 / one_in);
}

// The answer is near the exact one, and its point is one of its triangle.
void expect_closest(const TriangleMesh& mesh, const Vec3d& point, const PointAnswer& found,
                    const PointAnswer& exact) {
  ASSERT_EQ(found.status, Status::ok);
  if (mesh.triangles.empty()) {
    EXPECT_TRUE(std::isnan(found.distance));
    return;
  }
  ASSERT_LT(found.triangle, mesh.triangles.size());
  double size = point.norm();
  for (const std::uint32_t k : mesh.triangles[found.triangle]) {
    size = std::max(size, mesh.vertices[k].norm());
  }
  ASSERT_NEAR(found.distance, exact.distance, 4e-15 * size);
  ASSERT_NEAR((point - found.closest).norm(), found.distance, 1e-15 * size);
  const TriangleMesh one{mesh.vertices, {mesh.triangles[found.triangle]}};
  ASSERT_NEAR(answers_of(oracle_of_points(), PointTask::closest, one, {found.closest})[0].distance,
              0, 4e-15 * size);
}

TEST(PointQueries, FindTheClosestPoint) {
  int near = 0, far = 0;
  for (const auto& [name, mesh] : families::ray_meshes()) {
    SCOPED_TRACE(name);
    const double most = drawn(12, 2);
    const auto points = families::tried_points(
        mesh, most / static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1)), 5);
    const auto exact = answers_of(oracle_of_points(), PointTask::closest, mesh, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::isnan(exact[i].distance)) continue;
      EXPECT_NEAR((exact[i].closest - points[i]).stableNorm(), exact[i].distance,
                  4e-15 * (points[i].stableNorm() + exact[i].distance));
    }
    for (const PointQueryEntry& entry : registry::entries<PointQueryEntry>()) {
      if (entry.info.origin != Origin::ours) continue;
      for (const Isa level : isa_levels()) {
        limit_isa(level);
        const auto found = answers_of(entry, PointTask::closest, mesh, points);
        limit_isa(isa_of_machine());
        for (std::size_t i = 0; i < points.size(); ++i) {
          expect_closest(mesh, points[i], found[i], exact[i]);
          ++(exact[i].distance < 1e-2 ? near : far);
        }
      }
    }
  }
  EXPECT_GT(near, 100 / one_in);
  EXPECT_GT(far, 100 / one_in);
}

// From so far away that floats do not tell triangles from each other, and from where they overflow.
TEST(PointQueries, FindTheClosestPointFromAfar) {
  const TriangleMesh mesh = families::ellipsoid_mesh({2, 2, 2}, 8, 6);
  const std::vector<Vec3d> points = {{1e6, 2e5, -3e6},  {1e9, 0, 1},        {-1e13, 1e13, 0},
                                     {0, 1e30, 0},      {1e100, 0, -1e100}, {1e160, 0, 0},
                                     {0, -1e200, 1e150}};
  const auto exact = answers_of(oracle_of_points(), PointTask::closest, mesh, points);
  for (const PointQueryEntry& entry : registry::entries<PointQueryEntry>()) {
    if (entry.info.origin != Origin::ours) continue;
    const auto found = answers_of(entry, PointTask::closest, mesh, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(found[i].status, Status::ok);
      EXPECT_NEAR(found[i].distance, exact[i].distance, 4e-15 * points[i].stableNorm()) << i;
    }
  }
}

// The oracle of the whole mesh knows what that of each triangle alone does.
TEST(ExactPointQuery, LeavesOutNoTriangleThatIsNearest) {
  for (const auto& [name, mesh] : families::ray_meshes()) {
    if (mesh.triangles.empty()) continue;
    SCOPED_TRACE(name);
    const auto points =
        families::tried_points(mesh, drawn(4, 1) / static_cast<double>(mesh.triangles.size()), 7);
    std::vector<double> least(points.size(), std::numeric_limits<double>::infinity());
    for (const auto& triangle : mesh.triangles) {
      const TriangleMesh one{mesh.vertices, {triangle}};
      const auto answers = answers_of(oracle_of_points(), PointTask::closest, one, points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        least[i] = std::min(least[i], answers[i].distance);
      }
    }
    const auto whole = answers_of(oracle_of_points(), PointTask::closest, mesh, points);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(whole[i].distance, least[i]) << i;
  }
}

TEST(PeersPointQueries, AgreeButForRounding) {
  const TriangleMesh mesh = families::ellipsoid_mesh({2, 1, 1.5}, 24, 16);
  std::vector<Vec3d> points = families::tried_points(mesh, 0.2, 11);
  const auto near = answers_of(oracle_of_points(), PointTask::closest, mesh, points);
  const auto sides = answers_of(oracle_of_points(), PointTask::side, mesh, points);
  int inside = 0, outside = 0;
  for (const PointQueryEntry& entry : registry::entries<PointQueryEntry>()) {
    if (entry.info.origin != Origin::peer || !is_built(entry.info)) continue;
    const auto found = answers_of(entry, PointTask::closest, mesh, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(found[i].distance, near[i].distance, 1e-5 * (1 + points[i].norm()))
          << entry.info.name << i;
    }
    if (std::ranges::count(entry.tasks, PointTask::side) == 0) continue;
    const auto found_sides = answers_of(entry, PointTask::side, mesh, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(found_sides[i].side, sides[i].side) << entry.info.name << i;
      ++(sides[i].side == PointSide::inside ? inside : outside);
    }
  }
  if (const auto* cgal = registry::find<PointQueryEntry>("cgal-aabb-tree");
      cgal && is_built(cgal->info)) {
    EXPECT_GT(inside, 0);
    EXPECT_GT(outside, 0);
  }
}

TEST(PointQueries, SayWhatPointsAreNone) {
  const TriangleMesh mesh = families::ellipsoid_mesh({2, 2, 2}, 8, 6);
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const PointQueryEntry& entry : registry::entries<PointQueryEntry>()) {
    if (!is_built(entry.info)) continue;
    for (const PointTask task : entry.tasks) {
      const auto answers = answers_of(entry, task, mesh, {{0, inf, 0}, {std::nan(""), 0, 0}});
      for (const PointAnswer& answer : answers) {
        EXPECT_EQ(answer.status, Status::degenerate);
        EXPECT_EQ(answer.side, PointSide::unknown);
        EXPECT_TRUE(std::isnan(answer.distance));
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
