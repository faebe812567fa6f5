#include "algorithms/kernels/minkowski/support_cube_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/minkowski/support_shape.h"

namespace touchstone {
namespace {

using Draw = std::function<Vec3d()>;
struct Cloud {
  std::string name;
  Draw draw;
};

class Source {
 public:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3d on_sphere() {
    std::normal_distribution<double> normal;
    return Vec3d(normal(random_), normal(random_), normal(random_)).normalized();
  }
  std::size_t below(std::size_t count) { return random_() % count; }

  // Coordinates are at most about 1, as those of a SupportShape are.
  std::vector<Cloud> clouds() {
    const auto prism = [this](double height) {
      const double angle = uniform(0, 6.3);
      return Vec3d(0.6 * std::cos(angle), 0.6 * std::sin(angle), below(2) == 0 ? height : -height);
    };
    return {
        {"sphere", [this] { return on_sphere(); }},
        {"needle", [this] { return on_sphere().cwiseProduct(Vec3d(0.01, 1, 0.02)).eval(); }},
        {"disc", [this] { return on_sphere().cwiseProduct(Vec3d(1, 0.7, 0.001)).eval(); }},
        {"flat", [this] { return on_sphere().cwiseProduct(Vec3d(1, 0, 1)).eval(); }},
        {"line", [this] { return Vec3d(0, uniform(-1, 1), 0); }},
        {"slanted line", [this] { return (uniform(-1, 1) * Vec3d(0.5, 0.25, -0.75)).eval(); }},
        {"point", [] { return Vec3d(0.25, -0.5, 0.75); }},
        {"prism", [prism] { return prism(0.7); }},
        {"filled box", [this] { return Vec3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)); }},
        {"off centre", [this] { return (0.001 * on_sphere() + Vec3d(0.9, 0.1, 0)).eval(); }},
        {"lattice", [this] {
           const auto step = [this] { return static_cast<double>(below(5)) / 4 - 0.5; };
           return Vec3d(step(), step(), step());
         }}};
  }

 private:
  std::mt19937_64 random_{11};
};

template <class Scalar>
class DirectionCellsOf : public testing::Test {
 protected:
  void TearDown() override { limit_isa(isa_of_machine()); }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(DirectionCellsOf, Scalars);

template <class Scalar>
Scalar along(const Vec3<Scalar>& d, const Vec3<Scalar>& v) {
  return d.x() * v.x() + d.y() * v.y() + d.z() * v.z();
}

// Directions of every kind: anywhere, along axes and diagonals, normal to faces (where three
// vertices are equally far), and very short and long ones.
template <class Scalar>
std::vector<Vec3<Scalar>> directions(Source& source, const std::vector<Vec3<Scalar>>& vertices) {
  std::vector<Vec3<Scalar>> result;
  for (int k = 0; k < 200; ++k) result.push_back(source.on_sphere().template cast<Scalar>());
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        for (const double size : {1e-12, 1., 1e12}) {
          result.push_back((size * Vec3d(x, y, z)).template cast<Scalar>());
          const Vec3d off = 1e-9 * source.on_sphere();
          result.push_back((size * (Vec3d(x, y, z) + off)).template cast<Scalar>());
        }
      }
    }
  }
  for (int k = 0; k < 100; ++k) {
    const auto any = [&] {
      return vertices[source.below(vertices.size())].template cast<double>().eval();
    };
    const Vec3d a = any(), normal = (any() - a).cross(any() - a);
    if (normal.norm() > 1e-30) result.push_back(normal.normalized().template cast<Scalar>());
  }
  return result;
}

TYPED_TEST(DirectionCellsOf, FindWhatLookingAtAllFindsAtEveryLevel) {
  using Scalar = TypeParam;
  Source source;
  int ties = 0;
  for (const Cloud& cloud : source.clouds()) {
    for (const std::size_t count : {1u, 7u, 16u, 17u, 42u, 129u, 162u, 512u, 2000u}) {
      std::vector<Vec3<Scalar>> vertices;
      for (std::size_t k = 0; k < count; ++k) {
        // Every eighth stands twice.
        const bool again = k % 8 == 7;
        vertices.push_back(again ? vertices[k / 2] : cloud.draw().template cast<Scalar>().eval());
      }
      const SupportCubeMap<Scalar> cells{std::span<const Vec3<Scalar>>(vertices)};
      ASSERT_FALSE(cells.empty());
      std::set<std::uint32_t> numbers;
      for (std::uint32_t place = 0; place < count; ++place) {
        numbers.insert(cells.number(place));
        ASSERT_EQ(cells.vertex(place), vertices[cells.number(place)]);
      }
      ASSERT_EQ(numbers.size(), count);
      for (const Vec3<Scalar>& d : directions(source, vertices)) {
        std::uint32_t best = 0;
        for (std::uint32_t place = 1; place < count; ++place) {
          if (along(d, cells.vertex(place)) > along(d, cells.vertex(best))) best = place;
        }
        for (std::uint32_t place = best + 1; place < count; ++place) {
          ties += along(d, cells.vertex(place)) == along(d, cells.vertex(best)) ? 1 : 0;
        }
        for (const Isa level : {Isa::baseline, Isa::avx2, Isa::avx512}) {
          limit_isa(level);
          const auto found = cells.furthest(d);
          ASSERT_EQ(found.place, best) << cloud.name << ' ' << count << ' ' << to_string(level)
                                       << " along " << d.transpose();
          ASSERT_EQ(found.value, along(d, cells.vertex(best)));
        }
      }
    }
  }
  EXPECT_GT(ties, 1000);
}

TYPED_TEST(DirectionCellsOf, AnswerBadDirectionsWithSomeVertex) {
  using Scalar = TypeParam;
  Source source;
  std::vector<Vec3<Scalar>> vertices;
  for (int k = 0; k < 500; ++k) vertices.push_back(source.on_sphere().template cast<Scalar>());
  const SupportCubeMap<Scalar> cells{std::span<const Vec3<Scalar>>(vertices)};
  const Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();
  const Scalar infinity = std::numeric_limits<Scalar>::infinity();
  for (const Isa level : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    limit_isa(level);
    for (const Scalar x : {Scalar{0}, nan, infinity, -infinity}) {
      for (const Scalar y : {Scalar{0}, nan, infinity, -infinity, Scalar{1}}) {
        EXPECT_LT(cells.number(cells.furthest({x, y, 0}).place), vertices.size());
        EXPECT_LT(cells.number(cells.furthest({y, 0, x}).place), vertices.size());
      }
    }
  }
}

// It may not take much more memory than the vertices, whatever they are.
TYPED_TEST(DirectionCellsOf, StaySmall) {
  using Scalar = TypeParam;
  Source source;
  for (const Cloud& cloud : source.clouds()) {
    std::vector<Vec3<Scalar>> vertices;
    for (int k = 0; k < 1500; ++k) vertices.push_back(cloud.draw().template cast<Scalar>());
    const SupportCubeMap<Scalar> cells{std::span<const Vec3<Scalar>>(vertices)};
    EXPECT_LT(cells.held_bytes(), vertices.size() * (3 * sizeof(Scalar) + 24)) << cloud.name;
  }
}

// Through the shape: sizes at both ends of the numbers, hulls far from their origin, and no edges.
TYPED_TEST(DirectionCellsOf, ServeShapesOfEverySize) {
  using Scalar = TypeParam;
  Source source;
  for (const double size : {1e-300, 1e-150, 1e-9, 1., 1e9, 1e150, 1e300}) {
    for (const double away : {0., 3., 1e6}) {
      auto hull = std::make_shared<Hull>();
      for (int k = 0; k < 300; ++k) {
        hull->vertices.push_back(size * (source.on_sphere() + Vec3d(away, 0, 0)));
      }
      Shape shape;
      shape.kind = ShapeKind::hull;
      shape.hull = hull;
      const SupportShape<Scalar> made(shape);
      ASSERT_FALSE(made.cells.empty());
      for (int k = 0; k < 200; ++k) {
        const Vec3<Scalar> d = source.on_sphere().template cast<Scalar>();
        Scalar most = -std::numeric_limits<Scalar>::infinity();
        for (std::uint32_t i = 0; i < 300; ++i) most = std::max(most, along(d, made.vertex(i)));
        ASSERT_EQ(along(d, made.vertex(made.furthest(d))), most) << size << ' ' << away;
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
