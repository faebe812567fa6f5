// Tests that each axis draws what it states.
#include "harness/kinds/pair/axes/axes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "harness/base/reproducible_math.h"
#include "harness/grade/margins.h"
#include "harness/kinds/kind.h"
#include "harness/kinds/pair/axes/axis_draws.h"
#include "harness/kinds/pair/pair_checkers.h"
#include "harness/process/solve_case.h"

namespace touchstone {
namespace {

const kinds::Axis& axis(const std::string& name) {
  return *std::ranges::find(kinds::axes(), name, &kinds::Axis::name);
}

// The cases of a value, and how many of them are apart and overlap.
struct Drawn {
  std::vector<grade::TrueCase> cases;
  kinds::AxisSummary summary;
  std::map<Answer, int> answers;
};

class Axes : public ::testing::Test {
 protected:
  // Visits each value of the axis up to the greatest.
  template <class Visit>
  void for_each_value(const std::string& name, int cases, const Visit& visit,
                      double greatest = 1e300) {
    check::CheckRequest request(check::CheckMode::axes);
    request.cases = cases;
    for (const kinds::Family* family : kinds::axis_families()) {
      if (family->kind == &kinds::pair_kind() && family->axis == name) {
        request.families.push_back(family);
      }
    }
    const kinds::PairRequest of_pairs(request);
    for (std::uint32_t place = 0; place < of_pairs.regimes.size(); ++place) {
      const kinds::AxisValue& value = kinds::value_of(*of_pairs.regimes[place]);
      if (value.value > greatest) continue;
      SCOPED_TRACE(name + " " + value.name);
      EXPECT_EQ(std::stod(value.name), value.value);
      Drawn drawn;
      drawn.cases = kinds::axis_cases(of_pairs, place, oracle, drawn.summary);
      EXPECT_GT(drawn.cases.size(), 0u);
      for (grade::TrueCase& c : drawn.cases) {
        const Answer answer = c.truth(Encoding::as_given).measure.answer;
        ++drawn.answers[answer];
        ++all[answer];
      }
      visit(value.value, drawn);
    }
  }
  void expect_both_outcomes() {
    EXPECT_GT(all[Answer::separated], 20);
    EXPECT_GT(all[Answer::overlapping], 20);
  }

  oracle::Oracle oracle;
  std::map<Answer, int> all;
};

TEST_F(Axes, HaveTheEndsThatTheyPromise) {
  const auto ends = [](const std::string& name) {
    return axis(name).values.front().name + " to " + axis(name).values.back().name;
  };
  EXPECT_EQ(ends("scale-down"), "1e0 to 1e-12");
  EXPECT_EQ(ends("scale-up"), "1e0 to 1e12");
  EXPECT_EQ(ends("aspect"), "1e0 to 1e10");
  EXPECT_EQ(ends("distance"), "0 to 1e12");
  EXPECT_EQ(ends("ratio"), "1e0 to 1e12");
  EXPECT_EQ(ends("gap"), "1e0 to 1e-16");
  EXPECT_EQ(ends("depth"), "1e0 to 1e-16");
  EXPECT_EQ(ends("vertices"), "4 to 1e5");
  EXPECT_EQ(ends("coplanar"), "1e-1 to 0");
  EXPECT_EQ(ends("parallel"), "1e0 to 0");
  std::set<std::string> names;
  for (const kinds::Regime& regime : kinds::regimes_of_axes())
    EXPECT_TRUE(names.insert(regime.name).second);
}

TEST_F(Axes, Scale) {
  for (const char* name : {"scale-down", "scale-up"}) {
    for_each_value(name, 16, [&](double value, const Drawn& drawn) {
      for (const grade::TrueCase& c : drawn.cases) {
        for (const Shape* shape : {&c.pair().shape_a, &c.pair().shape_b}) {
          if (shape->kind == ShapeKind::halfspace) continue;
          EXPECT_NEAR(grade::shape_size(*shape) / value, 1, 1e-12) << c.pair().id;
        }
      }
    });
  }
  expect_both_outcomes();
}

// Returns the ratio of the longest extent to the shortest, among the extents that the shape has.
double aspect_of(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::sphere:
    case ShapeKind::halfspace: break;
    case ShapeKind::capsule: return (shape.half_length + shape.radius) / shape.radius;
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      return std::max(shape.radius, shape.half_length) / std::min(shape.radius, shape.half_length);
    case ShapeKind::box: return shape.half_extents.maxCoeff() / shape.half_extents.minCoeff();
    case ShapeKind::ellipsoid: return shape.radii.maxCoeff() / shape.radii.minCoeff();
    case ShapeKind::hull: {
      Vec3d low = shape.hull->vertices.front(), high = low;
      for (const Vec3d& v : shape.hull->vertices) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
      }
      return (high - low).maxCoeff() / (high - low).minCoeff();
    }
  }
  return 1;
}

TEST_F(Axes, Aspect) {
  for_each_value("aspect", 16, [&](double value, const Drawn& drawn) {
    int slender = 0;
    for (const grade::TrueCase& c : drawn.cases) {
      for (const Shape* shape : {&c.pair().shape_a, &c.pair().shape_b}) {
        if (shape->kind == ShapeKind::halfspace || shape->kind == ShapeKind::sphere) continue;
        EXPECT_NEAR(aspect_of(*shape) / value, 1, 1e-9) << c.pair().id;
        EXPECT_NEAR(grade::shape_size(*shape), 1, 1e-9) << c.pair().id;
        ++slender;
      }
    }
    EXPECT_GT(slender, 20);
  });
  expect_both_outcomes();
}

TEST_F(Axes, Distance) {
  for_each_value("distance", 16, [&](double value, const Drawn& drawn) {
    for (const grade::TrueCase& c : drawn.cases) {
      const Vec3d& at = c.pair().pose_a.translation;
      EXPECT_NEAR(base::length(at), value, 1e-12 * value) << c.pair().id;
      if (c.pair().shape_b.kind == ShapeKind::halfspace) continue;
      EXPECT_LT(base::length(c.pair().pose_b.translation - at), 5 + 1e-12 * value) << c.pair().id;
    }
  });
  expect_both_outcomes();
}

TEST_F(Axes, Ratio) {
  for_each_value("ratio", 16, [&](double value, const Drawn& drawn) {
    for (const grade::TrueCase& c : drawn.cases) {
      const double a = grade::shape_size(c.pair().shape_a), b = grade::shape_size(c.pair().shape_b);
      if (a == 0 || b == 0) continue;  // a half-space
      EXPECT_NEAR(std::max(a, b) / std::min(a, b) / value, 1, 1e-9) << c.pair().id;
      EXPECT_NEAR(std::max(a, b), 1, 1e-12);
    }
  });
  expect_both_outcomes();
}

TEST_F(Axes, Gap) {
  for_each_value("gap", 16, [&](double value, Drawn& drawn) {
    EXPECT_LE(drawn.summary.dropped, 2);
    EXPECT_EQ(drawn.answers[Answer::separated], drawn.summary.cases);
    for (grade::TrueCase& c : drawn.cases) {
      const oracle::Measure& exact = c.truth(Encoding::as_given).measure;
      EXPECT_NEAR(exact.middle() / grade::pair_size(c.pair()) / value, 1, 0.1) << c.pair().id;
    }
  });
}

TEST_F(Axes, Depth) {
  for_each_value("depth", 16, [&](double value, Drawn& drawn) {
    EXPECT_LE(drawn.summary.dropped, 8);
    EXPECT_EQ(drawn.answers[Answer::overlapping], drawn.summary.cases);
    for (grade::TrueCase& c : drawn.cases) {
      const oracle::Measure& exact = c.truth(Encoding::as_given).measure;
      const double share = -exact.middle() / grade::pair_size(c.pair()) / value;
      EXPECT_GT(share, 0.29) << c.pair().id;
      EXPECT_LT(share, 1.11) << c.pair().id;
    }
  });
}

TEST_F(Axes, Vertices) {
  const auto visit = [&](double value, const Drawn& drawn) {
    for (const grade::TrueCase& c : drawn.cases) {
      const auto has = [&](const Shape& shape) {
        return shape.kind == ShapeKind::hull &&
               static_cast<double>(shape.hull->vertices.size()) == value;
      };
      EXPECT_TRUE(has(c.pair().shape_a) || has(c.pair().shape_b)) << c.pair().id;
    }
  };
  for_each_value("vertices", 16, visit, 1000);
  expect_both_outcomes();
  EXPECT_LE(axis("vertices").most_cases(1e5), 6u);
}

TEST_F(Axes, Coplanar) {
  int caps = 0, beside = 0;
  for_each_value("coplanar", 16, [&](double value, const Drawn& drawn) {
    for (const grade::TrueCase& c : drawn.cases) {
      if (c.pair().id.find("/side-by-side") != std::string::npos) {
        ++beside;
        const Vec3d between = c.pair().pose_b.translation - c.pair().pose_a.translation;
        const Vec3d local = base::transposed_times(c.pair().pose_a.rotation, between);
        EXPECT_EQ(local.z(), value) << c.pair().id;
        continue;
      }
      bool found = false;
      for (const Shape* shape : {&c.pair().shape_a, &c.pair().shape_b}) {
        if (shape->kind != ShapeKind::hull) continue;
        const std::vector<Vec3d>& v = shape->hull->vertices;
        double highest = v.front().z();
        for (const Vec3d& p : v) highest = std::max(highest, p.z());
        found = found || (v.back() == Vec3d(0, 0, value) && highest == value);
      }
      EXPECT_TRUE(found) << c.pair().id;
      ++caps;
    }
  });
  EXPECT_GT(caps, 50);
  EXPECT_GT(beside, 50);
  expect_both_outcomes();
}

// Returns the least angle between an axis of one body and one of the other, except right angles and
// zero.
double least_angle(const files::Case& c) {
  double least = 10;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3d u = c.pose_a.rotation.col(i), v = c.pose_b.rotation.col(j);
      const double angle = std::atan2(base::length(base::outer(u, v)), std::abs(base::inner(u, v)));
      if (angle > 0) least = std::min(least, angle);
    }
  }
  return least;
}

TEST_F(Axes, Parallel) {
  std::set<std::string> features;
  for_each_value("parallel", 16, [&](double value, const Drawn& drawn) {
    for (const grade::TrueCase& c : drawn.cases) {
      const std::string& id = c.pair().id;
      const std::size_t at = id.find('/', id.find('/') + 1) + 1;
      features.insert(id.substr(at, id.find("-gap") == std::string::npos ? id.find("-depth") - at
                                                                         : id.find("-gap") - at));
      // Other axes of boxes may be nearer to each other by chance if the angle is large.
      if (value > 0 && value < 0.01) {
        EXPECT_NEAR(least_angle(c.pair()) / value, 1, 1e-6) << c.pair().id;
      }
    }
  });
  EXPECT_THAT(features, testing::ElementsAre("edge", "faces", "side", "side-edge"));
  expect_both_outcomes();
}

// --- hulls of many vertices ---------------------------------------------------------------------

void expect_good_hull(const Hull& hull, std::size_t vertices) {
  ASSERT_EQ(hull.vertices.size(), vertices);
  EXPECT_EQ(hull.vertices.size() + hull.faces.size(), hull.edges.size() + 2);
  std::size_t sides = 0;
  for (const Hull::Face& face : hull.faces) sides += face.loop.size();
  EXPECT_EQ(sides, 2 * hull.edges.size());
  const auto has_side = [&](std::uint32_t face, std::uint32_t tail, std::uint32_t head) {
    const auto& loop = hull.faces[face].loop;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (loop[i] == tail && loop[(i + 1) % loop.size()] == head) return true;
    }
    return false;
  };
  // A closed surface that is locally convex everywhere is convex.
  std::size_t bad = 0;
  for (const Hull::Edge& edge : hull.edges) {
    if (!has_side(edge.left, edge.tail, edge.head)) ++bad;
    if (!has_side(edge.right, edge.head, edge.tail)) ++bad;
    const Hull::Face &left = hull.faces[edge.left], &right = hull.faces[edge.right];
    for (const std::uint32_t v : right.loop) {
      if (v == edge.tail || v == edge.head) continue;
      if (!(base::inner(left.normal, hull.vertices[v] - hull.vertices[edge.tail]) < 0)) ++bad;
    }
  }
  EXPECT_EQ(bad, 0u);
  ASSERT_EQ(hull.neighbours.size(), vertices);
}

TEST(RingedHull, IsConvexAndClosedAtEveryCount) {
  base::Random random(3);
  for (const std::size_t count : {4, 10, 100, 1000, 10'000, 100'000}) {
    SCOPED_TRACE(count);
    const Vec3d radii = kinds::compact_half(1, random);
    const std::shared_ptr<const Hull> hull = kinds::ringed_hull(count, radii);
    expect_good_hull(*hull, count);
    if (count > 1000) continue;
    for (const Hull::Face& face : hull->faces) {
      for (const Vec3d& v : hull->vertices) {
        EXPECT_LT(base::inner(face.normal, v - hull->vertices[face.loop[0]]), 1e-14);
      }
    }
  }
}

// SAT refuses these at once instead of taking seconds.
TEST(RingedHull, TwoLargeOnesAreMoreThanSatWillLookAt) {
  const auto solved = [](std::size_t vertices, double apart, const char* name) {
    files::Case c;
    c.shape_a.kind = ShapeKind::hull;
    c.shape_a.hull = kinds::ringed_hull(vertices, Vec3d(1, 0.75, 0.5));
    c.shape_b = c.shape_a;
    c.pose_b.translation = {apart, 0.25, 0.125};
    return process::solve_case(*registry::find<NarrowPhaseEntry>(name), {}, c, Task::penetration);
  };
  for (const char* name : {"sat", "sat-faces"}) {
    EXPECT_EQ(solved(1000, 1, name).status, Status::ok);
    EXPECT_EQ(solved(1000, 1, name).answer, Answer::overlapping);
    EXPECT_EQ(solved(100'000, 1, name).status, Status::capacity);
    EXPECT_EQ(solved(100'000, 1, name).answer, Answer::unknown);
  }
  EXPECT_EQ(solved(100'000, 3, "sat").answer, Answer::separated);
  EXPECT_EQ(solved(100'000, 3, "sat").status, Status::ok);
  EXPECT_EQ(solved(10'000, 1, "sat").status, Status::capacity);
  EXPECT_EQ(solved(10'000, 3, "sat").answer, Answer::separated);
}

}  // namespace
}  // namespace touchstone
