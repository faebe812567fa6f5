// The meshes of simple bodies: closed, oriented, and of the volume of what they stand for.
#include "harness/geometry/mesh_shapes.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <string>

#include "algorithms/core/nearest_float.h"
#include "harness/base/error.h"

namespace touchstone::geometry {
namespace {

// True if each edge belongs to two triangles that run through it in opposite directions.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto other = edges.find({edge.second, edge.first});
    if (count != 1 || other == edges.end() || other->second != 1) return false;
  }
  return true;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  return sum;
}

bool has_floats(const Mesh& mesh) {
  for (const Vec3d& v : mesh.vertices) {
    if (v != nearest_float(v)) return false;
  }
  return true;
}

constexpr double pi = std::numbers::pi;

TEST(MeshShapes, AreClosedAndFaceOutwards) {
  const Mesh ring = torus(100, 40, 0.25);
  EXPECT_EQ(ring.triangles.size(), 8000U);
  EXPECT_TRUE(is_closed(ring));
  EXPECT_NEAR(volume(ring), 2 * pi * pi * 0.25 * 0.25, 0.01);
  const Mesh knot = trefoil(400, 12, 0.2);
  EXPECT_EQ(knot.triangles.size(), 9600U);
  EXPECT_TRUE(is_closed(knot));
  EXPECT_GT(volume(knot), 0);
  const Mesh ball = ellipsoid_with_poles({1, 2, 3}, 60, 160);
  EXPECT_EQ(ball.triangles.size(), 2U * 160 * 59);
  EXPECT_TRUE(is_closed(ball));
  EXPECT_NEAR(volume(ball), 4 * pi / 3 * 6, 0.1);
}

TEST(MeshShapes, HaveFloatCoordinates) {
  EXPECT_TRUE(has_floats(torus(17, 9, 0.3)));
  EXPECT_TRUE(has_floats(trefoil(50, 7, 0.1)));
  EXPECT_TRUE(has_floats(ellipsoid_with_poles({1, 1, 0.1}, 5, 6)));
  EXPECT_TRUE(has_floats(terrain(12, 0.3, 1)));
}

TEST(MeshShapes, TerrainIsAGridThatFollowsItsSeed) {
  const Mesh hills = terrain(32, 0.3, 1), same = terrain(32, 0.3, 1), other = terrain(32, 0.3, 2);
  EXPECT_EQ(hills.triangles.size(), 2048U);
  EXPECT_EQ(hills.vertices, same.vertices);
  EXPECT_NE(hills.vertices, other.vertices);
  for (const auto& t : hills.triangles) {
    const Vec3d& a = hills.vertices[t[0]];
    EXPECT_GT((hills.vertices[t[1]] - a).cross(hills.vertices[t[2]] - a).z(), 0);
  }
}

TEST(NamedMesh, HasAboutSoManyTriangles) {
  for (const std::string shape : {"torus", "trefoil", "ellipsoid", "terrain"}) {
    for (const int count : {500, 10000}) {
      const Mesh mesh = named_mesh(shape + "-" + std::to_string(count), ".");
      EXPECT_NEAR(static_cast<double>(mesh.triangles.size()) / count, 1, 0.3) << shape;
    }
  }
}

TEST(NamedMesh, RefusesOtherNumbersAndFilesThatAreNotThere) {
  EXPECT_THROW(named_mesh("torus-3", "."), base::InputError);
  EXPECT_THROW(named_mesh("torus-99999999999", "."), base::InputError);
  EXPECT_THROW(named_mesh("torus-", "."), base::InputError);
  EXPECT_THROW(named_mesh("nothing.obj", "."), base::InputError);
}

}  // namespace
}  // namespace touchstone::geometry
