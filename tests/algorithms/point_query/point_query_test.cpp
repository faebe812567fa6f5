// Point queries against the oracle.
#include "algorithms/point_query.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/registry.h"
#include "harness/families/meshes.h"
#include "harness/families/tried_points.h"
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

const PointQueryEntry& oracle_of_points() { return *find_point_query("exact"); }

TEST(PointQueries, KnowTheirSideOfASurface) {
  std::array<int, 3> sides{};
  for (const auto& [name, mesh] : families::closed_meshes()) {
    SCOPED_TRACE(name);
    const double most = drawn(20, 4);
    const auto points = families::tried_points(
        mesh, most / static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1)), 3);
    const auto exact = answers_of(oracle_of_points(), PointTask::side, mesh, points);
    for (const PointAnswer& answer : exact) ++sides.at(static_cast<std::size_t>(answer.side));
    for (const PointQueryEntry& entry : point_queries()) {
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

TEST(PointQueries, FindTheClosestPoint) {
  int near = 0, far = 0;
  for (const auto& [name, mesh] : families::ray_meshes()) {
    SCOPED_TRACE(name);
    const double most = drawn(12, 2);
    const auto points = families::tried_points(
        mesh, most / static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1)), 5);
    const auto exact = answers_of(oracle_of_points(), PointTask::closest, mesh, points);
    for (const PointQueryEntry& entry : point_queries()) {
      if (entry.info.origin == Origin::oracle) continue;
      const auto found = answers_of(entry, PointTask::closest, mesh, points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(found[i].status, Status::ok);
        if (mesh.triangles.empty()) {
          EXPECT_TRUE(std::isnan(found[i].distance));
          continue;
        }
        ++(exact[i].distance < 1e-2 ? near : far);
        ASSERT_LT(found[i].triangle, mesh.triangles.size());
        double size = points[i].norm();
        for (const std::uint32_t k : mesh.triangles[found[i].triangle]) {
          size = std::max(size, mesh.vertices[k].norm());
        }
        ASSERT_NEAR(found[i].distance, exact[i].distance, 4e-15 * size) << i;
        ASSERT_NEAR((points[i] - found[i].closest).norm(), found[i].distance, 1e-15 * size);
        TriangleMesh one{mesh.vertices, {mesh.triangles[found[i].triangle]}};
        ASSERT_NEAR(
            answers_of(oracle_of_points(), PointTask::closest, one, {found[i].closest})[0].distance,
            0, 4e-15 * size);
      }
    }
  }
  EXPECT_GT(near, 100 / one_in);
  EXPECT_GT(far, 100 / one_in);
}

TEST(PointQueries, SayWhatPointsAreNone) {
  const TriangleMesh mesh = families::ellipsoid_mesh({2, 2, 2}, 8, 6);
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const PointQueryEntry& entry : point_queries()) {
    for (const PointTask task : {PointTask::closest, PointTask::side}) {
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
