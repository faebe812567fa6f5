#include "algorithms/kernels/epa/epa_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/minkowski/simplex.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

constexpr int most_vertices = 120;

template <class Scalar>
class PolytopeSurfaceTest : public testing::Test {
 protected:
  using Surface = EpaHull<Scalar>;
  using Point = DifferencePoint<Scalar>;
  static constexpr Scalar rounding = SupportPair<Scalar>::rounding;

  void TearDown() override { limit_isa(isa_of_machine()); }

  static Point point(const Vec3d& v) {
    const Vec3<Scalar> p = v.cast<Scalar>();
    return {p, p, Vec3<Scalar>::Zero()};
  }
  static std::array<Point, 4> tetrahedron() {
    return {point({0.3, 0.3, 0.3}), point({0.3, -0.3, -0.3}), point({-0.3, 0.3, -0.3}),
            point({-0.3, -0.3, 0.3})};
  }
  static std::vector<int> faces(const Surface& surface) {
    std::vector<int> list;
    surface.all_faces([&](int face) {
      list.push_back(face);
      return true;
    });
    return list;
  }
  // The face that the point is furthest above, and how far.
  static std::pair<int, Scalar> face_below(const Surface& surface, const Vec3<Scalar>& p) {
    std::pair<int, Scalar> best{-1, Scalar{-1}};
    for (const int face : faces(surface)) {
      const Scalar height = surface.normal(face).dot(p) - surface.distance(face);
      if (height > best.second) best = {face, height};
    }
    return best;
  }

  // A closed surface without handles, convex, with the planes of its triangles; the nearest face.
  static void expect_sound(Surface& surface) {
    std::set<int> vertices;
    std::set<std::pair<int, int>> edges;
    Scalar least = std::numeric_limits<Scalar>::infinity();
    const std::vector<int> all = faces(surface);
    for (const int face : all) {
      const std::array<int, 3> corners = surface.corners(face);
      vertices.insert(corners.begin(), corners.end());
      for (int k = 0; k < 3; ++k) {
        EXPECT_TRUE(edges.insert({corners[k], corners[(k + 1) % 3]}).second) << "an edge twice";
      }
      const auto points = surface.points(corners);
      const TrianglePlane<Scalar> plane = triangle_plane(points);
      if (plane.flat) continue;
      least = std::min(least, surface.distance(face));
      const Vec3<Scalar> normal = plane.normal.normalized();
      EXPECT_NEAR(surface.distance(face), normal.dot(points[plane.base]), rounding);
      EXPECT_LE((surface.normal(face) - normal).norm(), rounding);
    }
    for (const auto& [tail, head] : edges) {
      EXPECT_EQ(edges.count({head, tail}), 1u) << "a neighbour is missing";
    }
    EXPECT_EQ(all.size(), 2 * vertices.size() - 4);
    for (const int face : all) {
      for (const int vertex : vertices) {
        const Vec3<Scalar>& p = surface.vertex(vertex).difference;
        EXPECT_LE(surface.normal(face).dot(p) - surface.distance(face), 64 * rounding);
      }
    }
    EXPECT_NEAR(surface.nearest_face().distance, least, 2 * rounding);
  }

  // The newest faces are those with the newest vertex.
  static void expect_newest(const Surface& surface, int vertex) {
    std::set<int> with_it;
    for (const int face : faces(surface)) {
      const std::array<int, 3> corners = surface.corners(face);
      if (std::ranges::count(corners, vertex) != 0) with_it.insert(face);
    }
    const auto newest = surface.newest_faces();
    EXPECT_EQ(std::set<int>(newest.begin(), newest.end()), with_it);
  }

  // Grows a surface by such points; how many were added.
  template <class Draw>
  static int grow(Surface& surface, const Draw& draw, bool sound) {
    EXPECT_TRUE(surface.start(tetrahedron()));
    int added = 0;
    for (int i = 4; i < most_vertices; ++i) {
      const Point p = point(draw());
      const auto [face, height] = face_below(surface, p.difference);
      const bool seen = height > rounding;
      const bool grew = seen && surface.add(p, face, std::numeric_limits<Scalar>::infinity());
      added += grew ? 1 : 0;
      if (grew) expect_newest(surface, added + 3);
      if (sound && i % 8 == 0) expect_sound(surface);
    }
    if (sound) expect_sound(surface);
    return added;
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PolytopeSurfaceTest, Scalars);

TYPED_TEST(PolytopeSurfaceTest, StaysClosedAndConvex) {
  reference::Random random(11);
  typename TestFixture::Surface surface(most_vertices);
  for (int repeat = 0; repeat < 20; ++repeat) {
    // Vertices of all sizes of polytopes: all on a sphere, or mostly inside of the others.
    const double least = repeat % 2 == 0 ? 1 : 0.3;
    const int added = TestFixture::grow(
        surface, [&]() -> Vec3d { return random.uniform(least, 1) * random.direction(); }, true);
    EXPECT_GT(added, repeat % 2 == 0 ? 110 : 20);
    EXPECT_TRUE(repeat % 2 == 0 || added < 110);
  }
}

// Coordinates on a coarse grid: points in the planes of faces, and on their edges.
TYPED_TEST(PolytopeSurfaceTest, StaysClosedOnAGrid) {
  reference::Random random(12);
  typename TestFixture::Surface surface(most_vertices);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const auto coordinate = [&] { return (random.below(9) - 4) / 4.0; };
    TestFixture::grow(
        surface,
        [&]() -> Vec3d {
          return {coordinate(), coordinate(), coordinate()};
        },
        true);
    // The eight corners of the cube hold all of it, once they have come.
    EXPECT_LE(surface.nearest_face().distance, 1 + TestFixture::rounding);
  }
}

TYPED_TEST(PolytopeSurfaceTest, IsTheSameAtEveryLevel) {
  const auto grown_at = [](Isa level) {
    limit_isa(level);
    reference::Random random(13);
    typename TestFixture::Surface surface(most_vertices);
    TestFixture::grow(
        surface, [&] { return random.direction(); }, false);
    return surface;
  };
  const auto baseline = grown_at(Isa::baseline);
  for (const Isa level : {Isa::avx2, Isa::avx512}) {
    const auto other = grown_at(level);
    ASSERT_EQ(TestFixture::faces(other), TestFixture::faces(baseline)) << to_string(level);
    for (const int face : TestFixture::faces(other)) {
      EXPECT_EQ(other.corners(face), baseline.corners(face));
      EXPECT_EQ(other.distance(face), baseline.distance(face));
      EXPECT_EQ(other.normal(face), baseline.normal(face));
    }
  }
}

TYPED_TEST(PolytopeSurfaceTest, RefusesWhatHasNoHorizon) {
  constexpr TypeParam infinity = std::numeric_limits<TypeParam>::infinity();
  typename TestFixture::Surface surface(most_vertices);
  ASSERT_TRUE(surface.start(TestFixture::tetrahedron()));
  for (const Vec3d& v : {Vec3d{0.1, 0, 0}, Vec3d{0.3, 0.3, 0.3}, Vec3d{0.3, 0, 0}}) {
    EXPECT_FALSE(surface.add(TestFixture::point(v), 0, infinity)) << v.transpose();
    EXPECT_EQ(TestFixture::faces(surface).size(), 4u);
  }
  // The origin may move as far as the faces; beyond it, it is not. Two corners in one place make no
  // faces.
  auto corners = TestFixture::tetrahedron();
  const auto moved = [&](double by) {
    for (auto& corner : corners) corner.difference.x() += static_cast<TypeParam>(by);
    return surface.start(corners);
  };
  EXPECT_TRUE(moved(0.1));
  EXPECT_FALSE(moved(0.3));
  corners = TestFixture::tetrahedron();
  corners[1] = corners[0];
  EXPECT_FALSE(surface.start(corners));
}

// There is no nearest face if all four corners are out of reach; a face that is set aside is not
// the nearest.
TYPED_TEST(PolytopeSurfaceTest, SetsFacesAside) {
  constexpr TypeParam infinity = std::numeric_limits<TypeParam>::infinity();
  typename TestFixture::Surface surface(most_vertices);
  ASSERT_TRUE(surface.start(TestFixture::tetrahedron()));
  const auto tip = TestFixture::point({1, 1, -1});
  const auto [face, height] = TestFixture::face_below(surface, tip.difference);
  ASSERT_GT(height, 0);
  ASSERT_TRUE(surface.add(tip, face, 0));
  EXPECT_EQ(TestFixture::faces(surface).size(), 6u);
  int chosen = 0;
  for (; surface.nearest_face().face >= 0; ++chosen) {
    surface.set_aside(surface.nearest_face().face);
  }
  EXPECT_EQ(chosen, 3);
  EXPECT_EQ(surface.nearest_face().distance, infinity);
}

}  // namespace
}  // namespace touchstone
