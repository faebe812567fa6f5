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
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/ray_cast/meshes.h"

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

// Points around, at and off vertices, edges and faces, and with coordinates of vertices.
std::vector<Vec3d> tried_points(const TriangleMesh& mesh, double share, unsigned seed) {
  reference::Random random(seed);
  std::vector<Vec3d> points;
  for (const auto& triangle : mesh.triangles) {
    if (random.uniform(0, 1) >= share) continue;
    const Vec3d& a = mesh.vertices[triangle[0]];
    const Vec3d& b = mesh.vertices[triangle[1]];
    const Vec3d& c = mesh.vertices[triangle[2]];
    for (const Vec3d& on : {a, Vec3d((a + b) / 2), Vec3d((a + b + 2 * c) / 4)}) {
      points.push_back(on);
      for (const double off : {1e-3, 1e-7, 1e-15}) points.push_back(on + off * random.direction());
      points.push_back({on[0], on[1], on[2] + random.uniform(-2, 2)});
      points.push_back({on[0] + random.uniform(-2, 2), on[1], on[2]});
      points.push_back(a + random.vector(4));
    }
    points.push_back({a[0], b[1], c[2]});
    points.push_back(1e6 * random.direction());
  }
  points.push_back(Vec3d::Zero());
  return points;
}

std::vector<reference::NamedMesh> closed_meshes() {
  std::vector<reference::NamedMesh> all;
  all.push_back({"none", {}});
  all.push_back({"ball", reference::ellipsoid_mesh({2, 2, 2}, 8, 6)});
  all.push_back({"poles", reference::ellipsoid_mesh({3, 2, 1}, 160, 4)});
  reference::NamedMesh nested{"nested", reference::ellipsoid_mesh({2, 2, 2}, 8, 6)};
  TriangleMesh hole = reference::ellipsoid_mesh({1, 1, 1}, 7, 5);
  for (auto& triangle : hole.triangles) std::swap(triangle[0], triangle[1]);
  reference::add(nested.mesh, hole, 1, {0, 0, 0});
  reference::add(nested.mesh, reference::ellipsoid_mesh({1, 1, 1}, 6, 4), 1, {1.5, 0, 0});
  all.push_back(std::move(nested));
  all.push_back({"doubles", reference::moved(reference::ellipsoid_mesh({2, 1, 2}, 10, 6), 1 / 3.0,
                                             {0.1, 0.2, 0.7})});
  return all;
}

TEST(PointQueries, KnowTheirSideOfASurface) {
  std::array<int, 3> sides{};
  for (const auto& [name, mesh] : closed_meshes()) {
    SCOPED_TRACE(name);
    const double most = drawn(20, 4);
    const auto points = tried_points(
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
  for (const auto& [name, mesh] : reference::ray_meshes()) {
    SCOPED_TRACE(name);
    const double most = drawn(12, 2);
    const auto points = tried_points(
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
  const TriangleMesh mesh = reference::ellipsoid_mesh({2, 2, 2}, 8, 6);
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
