#include "algorithms/hull/convex_hull.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <thread>

namespace touchstone {
namespace {

using Points = std::vector<Vec3d>;

Points cube() {
  Points points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  return points;
}

Points prism(int sides, double height) {
  Points points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (double z : {0.0, height}) points.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  return points;
}

Points ball(int count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  Points points;
  while (std::ssize(points) < count) {
    const double z = u(random), y = u(random), x = u(random);
    const Vec3d p(x, y, z);
    if (p.norm() <= 1) points.push_back(p);
  }
  return points;
}

Mat3d oblique() {
  return Eigen::AngleAxisd(0.7, Vec3d(0.3, -0.5, 0.9).normalized()).toRotationMatrix();
}

template <class Map>
Points mapped(Points points, Map map) {
  for (Vec3d& p : points) p = map(p);
  return points;
}

// Everything that shape.h says of a solid hull. Distances are in long double, from the loops alone.
void expect_valid(const Hull& hull, double tolerance = 1e-12) {
  using Wide = Eigen::Matrix<long double, 3, 1>;
  ASSERT_EQ(hull.dimension, 3);
  ASSERT_FALSE(hull.faces.empty());
  const auto wide = [&](std::uint32_t v) -> Wide { return hull.vertices[v].cast<long double>(); };
  long double size = 0;
  for (const Vec3d& p : hull.vertices) {
    size = std::max(size, (p.cast<long double>() - wide(0)).norm());
  }
  std::set<std::uint32_t> used;
  for (const Hull::Face& face : hull.faces) {
    ASSERT_GE(face.loop.size(), 3u);
    EXPECT_NEAR(face.normal.norm(), 1, 1e-14);
    Wide area = Wide::Zero();
    for (std::size_t i = 0; i < face.loop.size(); ++i) {
      used.insert(face.loop[i]);
      const Wide a = wide(face.loop[i]) - wide(face.loop[0]);
      const Wide b = wide(face.loop[(i + 1) % face.loop.size()]) - wide(face.loop[0]);
      area += a.cross(b);
    }
    EXPECT_GT(area.normalized().dot(face.normal.cast<long double>()), 1 - 1e-6L);
    for (std::uint32_t v = 0; v < hull.vertices.size(); ++v) {
      const Wide offset = (wide(v) - wide(face.loop[0])) / size;
      EXPECT_LE(area.normalized().dot(offset), tolerance) << "vertex " << v;
    }
  }
  ASSERT_EQ(used.size() + hull.faces.size(), hull.edges.size() + 2) << "Euler";
  ASSERT_EQ(hull.neighbours.size(), hull.vertices.size());
  std::size_t ends = 0;
  for (std::uint32_t v = 0; v < hull.vertices.size(); ++v) {
    EXPECT_EQ(used.contains(v), !hull.neighbours[v].empty());
    EXPECT_TRUE(hull.neighbours[v].empty() || hull.neighbours[v].size() >= 3);
    ends += hull.neighbours[v].size();
  }
  EXPECT_EQ(ends, 2 * hull.edges.size());
  const auto follows = [](const std::vector<std::uint32_t>& loop, std::uint32_t a,
                          std::uint32_t b) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (loop[i] == a && loop[(i + 1) % loop.size()] == b) return true;
    }
    return false;
  };
  for (const Hull::Edge& e : hull.edges) {
    EXPECT_TRUE(follows(hull.faces[e.left].loop, e.tail, e.head));
    EXPECT_TRUE(follows(hull.faces[e.right].loop, e.head, e.tail));
    EXPECT_THAT(hull.neighbours[e.tail], testing::Contains(e.head));
    EXPECT_THAT(hull.neighbours[e.head], testing::Contains(e.tail));
  }
}

void expect_counts(const Hull& hull, std::size_t faces, std::size_t edges) {
  EXPECT_EQ(hull.faces.size(), faces);
  EXPECT_EQ(hull.edges.size(), edges);
}

TEST(ConvexHull, CubeHasSixQuadrilaterals) {
  const auto hull = make_hull(cube());
  expect_valid(*hull, 0);
  expect_counts(*hull, 6, 12);
  for (const Hull::Face& face : hull->faces) {
    EXPECT_EQ(face.loop.size(), 4u);
    EXPECT_EQ(face.normal.cwiseAbs().maxCoeff(), 1);
  }
}

TEST(ConvexHull, Tetrahedron) {
  const auto hull = make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  expect_valid(*hull, 1e-18);
  expect_counts(*hull, 4, 6);
}

TEST(ConvexHull, KeepsInteriorAndRepeatedPointsOutOfTheFaces) {
  Points points = ball(50, 1);
  for (Vec3d& p : points) p = 0.5 * p + Vec3d::Constant(0.5);
  const Points corners = cube();
  for (int repeat = 0; repeat < 3; ++repeat)
    points.insert(points.end(), corners.begin(), corners.end());
  points.emplace_back(0.5, 0, 0);     // on an edge
  points.emplace_back(0.5, 0.25, 1);  // on a face
  const Points given = points;
  const auto hull = make_hull(points);
  EXPECT_EQ(hull->vertices, given);
  expect_valid(*hull, 1e-15);
  expect_counts(*hull, 6, 12);
  const auto reduced = make_reduced_hull(points);
  EXPECT_EQ(reduced->vertices.size(), 8u);
  expect_valid(*reduced, 1e-15);
  expect_counts(*reduced, 6, 12);
}

TEST(ConvexHull, ScalesOffsetsAndProportions) {
  int tried = 0;
  for (double scale : {1e-150, 1e-9, 1.0, 1e9, 1e150}) {
    for (double thin : {1.0, 1e-4, 1e-8}) {
      for (int axes = 1; axes <= 2; ++axes) {
        for (bool turned : {false, true}) {
          const Vec3d extents(axes == 2 ? thin : 1, 1, thin);
          const Mat3d rotation = turned ? oblique() : Mat3d::Identity();
          const auto place = [&](const Vec3d& p) -> Vec3d {
            return scale * (rotation * p.cwiseProduct(extents));
          };
          SCOPED_TRACE(testing::Message() << scale << ' ' << thin << ' ' << axes << ' ' << turned);
          const auto box = make_hull(mapped(cube(), place));
          expect_valid(*box, turned ? 1e-12 : 1e-15);
          if (!turned || thin == 1) expect_counts(*box, 6, 12);
          const auto disc = make_hull(mapped(prism(64, 1), place));
          expect_valid(*disc, turned ? 1e-12 : 1e-15);
          if (!turned) expect_counts(*disc, 66, 192);
          ++tried;
        }
      }
    }
  }
  EXPECT_EQ(tried, 60);
  const auto far =
      make_hull(mapped(cube(), [](const Vec3d& p) -> Vec3d { return p + Vec3d(1e8, -1e8, 3e7); }));
  expect_valid(*far, 1e-15);
  expect_counts(*far, 6, 12);
  const auto far_ball = make_hull(
      mapped(ball(100, 2), [](const Vec3d& p) -> Vec3d { return p + Vec3d::Constant(1e8); }));
  expect_valid(*far_ball, 1e-7);
  const auto huge = make_hull(
      mapped(cube(), [](const Vec3d& p) -> Vec3d { return 1e308 * (2 * p - Vec3d::Ones()); }));
  expect_counts(*huge, 6, 12);
}

TEST(ConvexHull, CapsOfManySidesAreOnePolygon) {
  const auto hull = make_hull(prism(256, 2));
  expect_valid(*hull, 1e-14);
  expect_counts(*hull, 258, 768);
  const auto turned =
      make_hull(mapped(prism(256, 2), [](const Vec3d& p) -> Vec3d { return oblique() * p; }));
  expect_valid(*turned, 1e-14);
  expect_counts(*turned, 258, 768);
}

TEST(ConvexHull, ManyPoints) {
  const auto solid = make_hull(ball(10000, 3));
  expect_valid(*solid, 1e-14);
  EXPECT_GT(solid->faces.size(), 200u);
  const auto surface =
      make_hull(mapped(ball(2000, 4), [](const Vec3d& p) -> Vec3d { return p.normalized(); }));
  expect_valid(*surface, 1e-12);
  expect_counts(*surface, 3996, 5994);
}

TEST(ConvexHull, RandomSetsAtEveryProportion) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> power(-9, 9), thin(-8, 0);
  std::uniform_int_distribution<int> count(4, 40);
  int valid = 0;
  for (int i = 0; i < 300; ++i) {
    const double z = std::pow(10, thin(random)), y = std::pow(10, thin(random));
    const Vec3d extents(1, y, z);
    const double scale = std::pow(10, power(random));
    const auto hull = make_hull(mapped(
        ball(count(random), static_cast<unsigned>(i)),
        [&](const Vec3d& p) -> Vec3d { return scale * (oblique() * p.cwiseProduct(extents)); }));
    EXPECT_EQ(hull->dimension, 3);
    if (hull->faces.empty()) continue;
    expect_valid(*hull, 1e-12);
    ++valid;
  }
  EXPECT_EQ(valid, 300);
}

TEST(ConvexHull, LatticePointsWithManyCoplanar) {
  std::mt19937_64 random(6);
  std::uniform_int_distribution<int> coordinate(0, 3);
  int solid = 0, flat = 0;
  for (int i = 0; i < 500; ++i) {
    Points points;
    const int count = 4 + i % 12;
    for (int k = 0; k < count; ++k) {
      const int z = i % 9 == 0 ? 2 : coordinate(random);
      const int y = coordinate(random), x = coordinate(random);
      points.emplace_back(x, y, z);
    }
    const auto hull = make_hull(points);
    if (hull->dimension < 3) {
      EXPECT_TRUE(hull->faces.empty());
      ++flat;
      continue;
    }
    expect_valid(*hull, 1e-15);
    // No two faces share a plane.
    for (const Hull::Edge& e : hull->edges) {
      EXPECT_LT(hull->faces[e.left].normal.dot(hull->faces[e.right].normal), 1 - 1e-6);
    }
    ++solid;
  }
  EXPECT_GT(solid, 300);
  EXPECT_GT(flat, 40);
}

TEST(ConvexHull, DimensionOfDegenerateSets) {
  const auto dimension = [](const Points& points) {
    const auto hull = make_hull(points);
    EXPECT_EQ(hull->vertices, points);
    EXPECT_TRUE(hull->faces.empty() && hull->edges.empty() && hull->neighbours.empty());
    return hull->dimension;
  };
  EXPECT_EQ(dimension({{1, 2, 3}}), 0);
  EXPECT_EQ(dimension(Points(5, Vec3d(1e8, 2, 3))), 0);
  EXPECT_EQ(dimension({{0, 0, 0}, {0, 0, 0}}), 0);
  EXPECT_EQ(dimension({{1, 2, 3}, {1, 2, 3.5}, {1, 2, 3}}), 1);
  for (double scale : {1e-9, 1.0, 1e9}) {
    Points line, plane;
    for (int i = 0; i < 40; ++i) {
      const double t = std::sqrt(i + 1.0);
      line.push_back(scale * (oblique() * Vec3d(t, 0, 0)));
      plane.push_back(scale * (oblique() * Vec3d(t, std::fmod(7.3 * t, 2), 0)));
    }
    EXPECT_EQ(dimension(line), 1);
    EXPECT_EQ(dimension(plane), 2);
  }
  EXPECT_EQ(dimension({{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {1, 1, 5}}), 2);
}

TEST(ConvexHull, ReducesDegenerateSets) {
  EXPECT_EQ(make_reduced_hull(Points(4, Vec3d(1, 2, 3)))->vertices, Points{Vec3d(1, 2, 3)});
  EXPECT_EQ(make_reduced_hull({{1, 0, 0}, {0, 0, 0}, {3, 0, 0}, {2, 0, 0}})->vertices,
            (Points{{0, 0, 0}, {3, 0, 0}}));
  const Points square = {{0, 0, 5}, {2, 0, 5}, {0, 2, 5}, {2, 2, 5}};
  Points flat = square;
  flat.insert(flat.end(), {{1, 1, 5}, {1, 0, 5}, {0.5, 1.5, 5}, {2, 2, 5}});
  const auto hull = make_reduced_hull(flat);
  EXPECT_EQ(hull->dimension, 2);
  EXPECT_EQ(hull->vertices, square);
}

TEST(ConvexHull, ReducedHullKeepsWhatIsExtreme) {
  const Points points = ball(3000, 7);
  const auto reduced = make_reduced_hull(points);
  expect_valid(*reduced, 1e-14);
  EXPECT_LT(reduced->vertices.size(), 600u);
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    const double z = normal(random), y = normal(random), x = normal(random);
    const Vec3d d(x, y, z);
    double all = -1e9, kept = -1e9;
    for (const Vec3d& p : points) all = std::max(all, d.dot(p));
    for (const Vec3d& p : reduced->vertices) kept = std::max(kept, d.dot(p));
    EXPECT_EQ(all, kept);
  }
}

TEST(ConvexHull, IsQuietAndGivesTheSameOnThreads) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  std::vector<std::shared_ptr<const Hull>> hulls(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    threads.emplace_back([&, i] { hulls[i] = make_hull(ball(500, 9)); });
  }
  for (std::thread& t : threads) t.join();
  make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-13}});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  for (const auto& hull : hulls) {
    ASSERT_EQ(hull->faces.size(), hulls[0]->faces.size());
    for (std::size_t f = 0; f < hull->faces.size(); ++f) {
      EXPECT_EQ(hull->faces[f].loop, hulls[0]->faces[f].loop);
    }
  }
}

TEST(ConvexHull, SliversAreSolidDownToRounding) {
  int with_faces = 0;
  for (int k = 2; k <= 13; ++k) {
    const auto hull = make_hull(mapped(cube(), [&](const Vec3d& p) -> Vec3d {
      return oblique() * Vec3d(p.x(), p.y(), p.z() * std::pow(10, -k));
    }));
    EXPECT_EQ(hull->dimension, 3) << k;
    if (!hull->faces.empty()) ++with_faces;
  }
  EXPECT_GE(with_faces, 10);
}

}  // namespace
}  // namespace touchstone
