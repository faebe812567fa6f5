// Tests particular to separating axes: axes across edges, flat and thin bodies, extremes.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/bodies.h"
#include "tests/algorithms/narrow_phase/brute_force.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::sat_test {
namespace {

using namespace test;

Outcome ask_named(const char* name, Precision scalar, Task task, const Shape& a, const Pose& pose_a,
                  const Shape& b, const Pose& pose_b) {
  return ask(*registry::find<NarrowPhaseEntry>(name), settings_of(scalar), task, a, pose_a, b,
             pose_b);
}

Mat3d turn(double degrees, const Vec3d& axis) {
  return Eigen::AngleAxisd(degrees * M_PI / 180, axis).toRotationMatrix();
}

// The greatest distance of two vertices: the size of a body.
double size_of(const Shape& shape) {
  if (shape.kind == ShapeKind::box) return 2 * shape.half_extents.norm();
  double size = 0;
  for (const Vec3d& p : shape.hull->vertices) {
    for (const Vec3d& q : shape.hull->vertices) size = std::max(size, (p - q).norm());
  }
  return size;
}

struct AxisTally {
  int apart = 0, common = 0, gave_up = 0;
};

// Checks sat in both scalars and tasks against the brute force, and counts. Differences below
// `margin` times the size of the pair are not asked of it. `doubt`: error of the brute force,
// metres.
void check(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, double margin,
           float float_margin, AxisTally& tally, double doubt = 0) {
  const double truth = brute_force::signed_distance(a, pose_a, b, pose_b);
  const double size = std::max(size_of(a), size_of(b));
  (truth > 0 ? tally.apart : tally.common)++;
  for (const Precision scalar : {Precision::float64, Precision::float32}) {
    const bool exact = scalar == Precision::float64;
    const double tolerance = (exact ? margin : static_cast<double>(float_margin)) * size;
    for (const Task task : {Task::intersect, Task::penetration}) {
      const Outcome outcome = ask_named("sat", scalar, task, a, pose_a, b, pose_b);
      SCOPED_TRACE(std::string(to_string(scalar)) + " " + std::string(to_string(task)) +
                   ", true distance " + std::to_string(truth / size) + " of the size");
      if (outcome.status != Status::ok) {
        EXPECT_EQ(outcome.status, Status::not_converged);
        if (exact) tally.gave_up++;
        EXPECT_LE(std::abs(truth), tolerance) << "gave up where it need not";
        EXPECT_EQ(outcome.answer, Answer::unknown);
      } else if (std::abs(truth) > tolerance) {
        EXPECT_EQ(outcome.answer, truth > 0 ? Answer::separated : Answer::overlapping);
      }
      if (task == Task::penetration && outcome.answer == Answer::overlapping) {
        EXPECT_NEAR(outcome.distance, truth, tolerance);
        EXPECT_LE(outcome.lower, truth + (exact ? doubt : 1e-6 * size));
        EXPECT_GE(outcome.upper, truth - (exact ? doubt : 1e-6 * size));
        EXPECT_NEAR(outcome.normal.norm(), 1, 1e-15);
      }
      if (task == Task::intersect || outcome.answer == Answer::separated) {
        EXPECT_TRUE(std::isnan(outcome.distance) && std::isnan(outcome.normal.x()) &&
                    std::isnan(outcome.witness_a.x()));
      }
    }
  }
}

using MakeShape = std::function<Shape(Random&)>;

// Random pairs whose bodies are moved along the line of their centres to about where they touch.
AxisTally sweep(const MakeShape& make_a, const MakeShape& make_b, int count, double margin,
                float float_margin, double spread, std::uint64_t seed) {
  Random random(seed);
  AxisTally tally;
  for (int k = 0; k < drawn(count, 60); ++k) {
    const Shape a = make_a(random), b = make_b(random);
    Pose pose_a{random_rotation(random), Vec3d::Zero()}, pose_b{random_rotation(random), {}};
    const Vec3d u = random_direction(random);
    pose_b.translation.setZero();
    const double reach = support(a, pose_a, u).dot(u) - support(b, pose_b, -u).dot(u);
    pose_b.translation = reach * (1 - spread * uniform(random, -0.2, 1)) * u;
    check(a, pose_a, b, pose_b, margin, float_margin, tally);
    if (testing::Test::HasFailure()) {
      ADD_FAILURE() << "pair " << k;
      break;
    }
  }
  return tally;
}

Shape unit_box(Random& random) {
  return box(uniform(random, 0.2, 1), uniform(random, 0.2, 1), uniform(random, 0.2, 1));
}
Shape small_hull(Random& random) { return random_hull(random, 4 + static_cast<int>(random() % 9)); }
Shape flat_hull(Random& random) {
  // Small integers times a power of two: flat in exact arithmetic.
  std::vector<Vec3d> points;
  const Vec3d u(1, static_cast<double>(random() % 5) - 2, 2),
      v(-2, 1, static_cast<double>(random() % 3));
  const int count = 3 + static_cast<int>(random() % 5);
  while (static_cast<int>(points.size()) < count) {
    points.push_back((static_cast<double>(random() % 17) - 8) / 16 * u +
                     (static_cast<double>(random() % 17) - 8) / 16 * v);
    if (points.size() == 3 && (points[1] - points[0]).cross(points[2] - points[0]).norm() == 0) {
      points.clear();
    }
  }
  return bare_hull(points, 2);
}
Shape segment(Random& random) {
  const Vec3d p = random_direction(random);
  return bare_hull({p, -p * uniform(random, 0, 1)}, 1);
}
Shape point(Random& random) { return bare_hull({0.1 * random_direction(random)}, 0); }

void expect_both(const AxisTally& tally) {
  const int all = tally.apart + tally.common;
  const int share = one_in == 1 ? all / 5 : all / 6;  // a few draws vary more
  EXPECT_GT(tally.apart, share);
  EXPECT_GT(tally.common, share);
  EXPECT_LE(tally.gave_up, 4 * all / 50);
}

TEST(Sat, AgreesOnBoxes) { expect_both(sweep(unit_box, unit_box, 1500, 1e-13, 1e-5F, 1, 1)); }
TEST(Sat, AgreesOnHulls) { expect_both(sweep(any_hull, any_hull, 600, 1e-13, 1e-5F, 1, 2)); }
TEST(Sat, AgreesOnBoxAndHull) { expect_both(sweep(unit_box, any_hull, 800, 1e-13, 1e-5F, 1, 3)); }
TEST(Sat, AgreesOnFlatHulls) {
  expect_both(sweep(flat_hull, any_hull, 400, 1e-13, 1e-5F, 1, 4));
  expect_both(sweep(flat_hull, flat_hull, 400, 1e-13, 1e-5F, 1, 5));
  expect_both(sweep(unit_box, flat_hull, 400, 1e-13, 1e-5F, 1, 6));
}
TEST(Sat, AgreesOnBoxesWithoutThickness) {
  const auto plate = [](Random& random) { return box(uniform(random, 0.2, 1), 1, 0); };
  const auto needle = [](Random&) { return box(0, 1, 0); };
  expect_both(sweep(plate, unit_box, 400, 1e-13, 1e-5F, 1, 23));
  expect_both(sweep(plate, plate, 400, 1e-13, 1e-5F, 1, 24));
  expect_both(sweep(needle, unit_box, 400, 1e-13, 1e-5F, 1, 25));
  expect_both(sweep(any_hull, plate, 400, 1e-13, 1e-5F, 1, 26));
}
TEST(Sat, AgreesOnSegmentsAndPoints) {
  expect_both(sweep(unit_box, segment, 600, 1e-13, 1e-5F, 1, 7));
  expect_both(sweep(any_hull, point, 600, 1e-13, 1e-5F, 1, 8));
  // The difference of these two is flat or less: they touch or are apart.
  const AxisTally tally = sweep(flat_hull, point, 300, 1e-12, 1e-5F, 1, 9);
  EXPECT_GT(tally.apart, drawn(250, 40));
}
TEST(Sat, AgreesOnNeedlesAndPlates) {
  const auto thin = [](Random& random) {
    Vec3d half(1, 1, 1);
    for (int k = 0; k < 3; ++k) half[k] = std::pow(10.0, uniform(random, -8, 0));
    return box(half.x(), half.y(), half.z());
  };
  const auto needle = [](Random& random) {
    return box_as_hull(1, 1e-8 * uniform(random, 1, 2), std::pow(10.0, uniform(random, -8, 0)));
  };
  AxisTally all;
  for (const auto& tally : {sweep(thin, unit_box, 500, 1e-12, 1e-4F, 1, 10),
                            sweep(thin, thin, 500, 1e-12, 1e-4F, 1, 11),
                            sweep(needle, needle, 500, 1e-12, 1e-4F, 1, 12),
                            sweep(needle, any_hull, 300, 1e-12, 1e-4F, 1, 13)}) {
    all.apart += tally.apart;
    all.common += tally.common;
  }
  EXPECT_GT(all.apart, drawn(360, 40));
  EXPECT_GT(all.common, drawn(360, 40));
}
TEST(Sat, AgreesOnUnequalSizes) {
  const auto scaled = [](const MakeShape& make, double scale) {
    return [make, scale](Random& random) {
      const Shape shape = make(random);
      std::vector<Vec3d> points = shape.hull->vertices;
      auto copy = std::make_shared<Hull>(*shape.hull);
      for (Vec3d& v : copy->vertices) v *= scale;
      return as_shape(copy);
    };
  };
  for (const double scale : {1e-9, 1e9, 1e-150, 1e150}) {
    expect_both(sweep(scaled(any_hull, scale), scaled(any_hull, scale), 100, 1e-13, 1e-5F, 1, 14));
  }
  for (const double scale : {1e-12, 1e-6, 1e6, 1e12}) {
    expect_both(sweep(any_hull, scaled(any_hull, scale), 100, 1e-13, 1e-5F, 1, 15));
    expect_both(sweep(unit_box, scaled(any_hull, scale), 100, 1e-13, 1e-5F, 1, 16));
  }
}

TEST(Sat, AgreesFarFromTheOrigin) {
  Random random(17);
  AxisTally tally;
  for (int k = 0; k < 300; ++k) {
    // Far in the world, and far from the body's own origin.
    const Vec3d far = 1e8 * random_direction(random), baked = 1e8 * random_direction(random);
    Shape a = small_hull(random);
    const Shape b = small_hull(random);
    auto moved = std::make_shared<Hull>(*a.hull);
    for (Vec3d& v : moved->vertices) v += baked;
    a.hull = moved;
    const Mat3d r = random_rotation(random);
    const Pose pose_a{r, far},
        pose_b{random_rotation(random), far + r * baked + random_vector(random, 0, 2)};
    check(a, pose_a, b, pose_b, 1e-10, 1e-5F, tally, 2e-11);
  }
  expect_both(tally);
}

// Edges that are parallel up to an angle, whose ridges face each other.
TEST(Sat, AgreesOnAlmostParallelEdges) {
  Random random(18);
  AxisTally tally;
  for (int k = 0; k < drawn(1500, 150); ++k) {
    const double angle = std::pow(10.0, uniform(random, -16, -1));
    const Vec3d axis = random_direction(random);
    const Mat3d common = random_rotation(random);
    const Shape a = k % 3 == 0 ? box(1, 1, 1) : box_as_hull(1, 1, 1);
    const Shape b = k % 2 == 0 ? box(0.5, 1, 0.7) : box_as_hull(0.5, 1, 0.7);
    const Pose pose_a{common * turn(45, Vec3d::UnitX()), Vec3d::Zero()};
    const Mat3d twist = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    const Mat3d rotation_b = common * twist * turn(45, Vec3d::UnitX());
    const double gap = (k % 4 < 2 ? 1 : -1) * std::pow(10.0, uniform(random, -12, -1));
    const Pose turned{rotation_b, Vec3d::Zero()};
    const Vec3d up = common.col(2);
    const Vec3d meet = support(a, pose_a, up) - support(b, turned, -up) + gap * up;
    // Ridge over ridge, here and there along them.
    const Vec3d along = common.col(0);
    const Pose pose_b{rotation_b,
                      meet - meet.dot(along) * along + uniform(random, -0.2, 0.2) * along};
    check(a, pose_a, b, pose_b, 1e-12, 1e-5F, tally);
    if (HasFailure()) FAIL() << "pair " << k << ", angle " << angle << ", gap " << gap;
  }
  expect_both(tally);
}

// Two knife edges face each other, almost parallel: hardly any face normal tells them apart.
TEST(Sat, IsHonestOnKnives) {
  Random random(19);
  int answered = 0;
  for (int k = 0; k < 400; ++k) {
    const double width = std::pow(10.0, uniform(random, -8, -1));
    const Shape knife = hull(
        {{-1, 0, 0}, {1, 0, 0}, {-1, -width, -1}, {1, -width, -1}, {-1, width, -1}, {1, width, -1}},
        {{0, 2, 3, 1}, {0, 1, 5, 4}, {2, 4, 5, 3}, {0, 4, 2}, {1, 3, 5}});
    const Mat3d common = random_rotation(random);
    const double angle = std::pow(10.0, uniform(random, -17, -2));
    const double gap = (k % 2 == 0 ? 1 : -1) * std::pow(10.0, uniform(random, -9, -1));
    const Pose pose_a{common, Vec3d::Zero()};
    const Pose pose_b{common * turn(180, Vec3d::UnitX()) *
                          Eigen::AngleAxisd(angle, Vec3d::UnitZ()).toRotationMatrix(),
                      common.col(2) * gap};
    const double truth = brute_force::signed_distance(knife, pose_a, knife, pose_b);
    const Outcome outcome =
        ask_named("sat", Precision::float64, Task::intersect, knife, pose_a, knife, pose_b);
    if (outcome.status != Status::ok) continue;
    ++answered;
    if (std::abs(truth) > 1e-12) {
      EXPECT_EQ(outcome.answer, truth > 0 ? Answer::separated : Answer::overlapping)
          << width << " " << angle << " " << gap;
    }
  }
  EXPECT_GT(answered, 200);
}

TEST(Sat, FaceNormalsAloneMissCrossedEdges) {
  // Two ridges crossed at right angles, apart along z, which is no face normal of either.
  int missed = 0;
  for (const Shape& shape : {box(1, 1, 1), box_as_hull(1, 1, 1)}) {
    for (const double gap : {1e-12, 1e-6, 1e-2, 0.3}) {
      const Pose pose_a{turn(45, Vec3d::UnitX()), Vec3d::Zero()};
      const Pose pose_b{turn(45, Vec3d::UnitY()), {0, 0, 2 * std::sqrt(2.0) + gap}};
      const auto answer = [&](const char* name) {
        return ask_named(name, Precision::float64, Task::intersect, shape, pose_a, shape, pose_b);
      };
      EXPECT_EQ(answer("sat").answer, Answer::separated);
      EXPECT_EQ(answer("sat").status, Status::ok);
      EXPECT_EQ(answer("sat-faces").answer, Answer::overlapping);
      missed += answer("sat-faces").answer == Answer::overlapping ? 1 : 0;
    }
    // Overlapping: face normals alone give too great a depth.
    const Pose pose_a{turn(45, Vec3d::UnitX()), Vec3d::Zero()};
    const Pose pose_b{turn(45, Vec3d::UnitY()), {0, 0, 2 * std::sqrt(2.0) - 0.01}};
    const Outcome full =
        ask_named("sat", Precision::float64, Task::penetration, shape, pose_a, shape, pose_b);
    const Outcome faces =
        ask_named("sat-faces", Precision::float64, Task::penetration, shape, pose_a, shape, pose_b);
    EXPECT_NEAR(full.distance, -0.01, 1e-14);
    EXPECT_NEAR((full.normal - Vec3d::UnitZ()).norm(), 0, 1e-14);
    EXPECT_LT(faces.distance, -0.1);
    EXPECT_LE(faces.lower, -0.01);
    EXPECT_TRUE(std::isnan(faces.upper));
  }
  EXPECT_EQ(missed, 8);
}

TEST(Sat, WitnessPointsLieOnBothBodies) {
  Random random(20);
  int overlapping = 0;
  for (int k = 0; k < drawn(1500, 150); ++k) {
    const Shape a = k % 2 == 0 ? unit_box(random) : small_hull(random);
    const Shape b = k % 3 == 0 ? unit_box(random) : small_hull(random);
    const Pose pose_a{k % 5 == 0 ? Mat3d::Identity() : random_rotation(random), Vec3d::Zero()};
    const Pose pose_b{k % 5 == 0 ? Mat3d::Identity() : random_rotation(random),
                      random_vector(random, 0, 1.5)};
    for (const char* name : {"sat", "closed-form"}) {
      const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>(name);
      if (!offers(entry, a.kind, b.kind, Task::penetration)) continue;
      const Outcome outcome = ask(entry, {}, Task::penetration, a, pose_a, b, pose_b);
      if (outcome.answer != Answer::overlapping) continue;
      ++overlapping;
      EXPECT_LE(brute_force::outside(a, pose_a, outcome.witness_a), 1e-13) << name << " " << k;
      EXPECT_LE(brute_force::outside(b, pose_b, outcome.witness_b), 1e-13) << name << " " << k;
      const Vec3d between = outcome.witness_a - outcome.witness_b;
      EXPECT_LE((between + outcome.distance * outcome.normal).norm(), 1e-12) << name << " " << k;
    }
  }
  EXPECT_GT(overlapping, drawn(500, 50));
}

TEST(Sat, SaysSoWhereAHullHasNoFaces) {
  Random random(21);
  const Shape whole = small_hull(random);
  const Shape bare = bare_hull(whole.hull->vertices, 3);
  const Pose here;
  const Pose away{Mat3d::Identity(), {5, 0, 0}}, inside{Mat3d::Identity(), {0.1, 0, 0}};
  for (const char* name : {"sat", "sat-faces"}) {
    for (const Task task : {Task::intersect, Task::penetration}) {
      const Outcome apart = ask_named(name, Precision::float64, task, bare, here, whole, away);
      EXPECT_EQ(apart.answer, Answer::separated);
      EXPECT_EQ(apart.status, Status::ok);
      const Outcome common = ask_named(name, Precision::float64, task, bare, here, whole, inside);
      EXPECT_EQ(common.answer, Answer::unknown);
      EXPECT_EQ(common.status, Status::degenerate);
    }
  }
}

// Points have no size of their own: only the rounding of their offset hides that they touch.
TEST(Sat, PointsAtOnePlaceTouch) {
  struct Case {
    Vec3d vertex_a, vertex_b;
    Pose a, b;
  };
  const auto matrix = [](const Vec3d& x, const Vec3d& y, const Vec3d& z) {
    Mat3d m;
    m << x.transpose(), y.transpose(), z.transpose();
    return m;
  };
  // In exact arithmetic the two points are the same.
  const Case cases[] = {
      {{0.42448032199501307, -0.3191883041343282, 0.841492658224678},
       {-0.22587289023784418, 0.22407557820969082, -0.6183842947284348},
       {matrix({0.6982120851468728, -0.33166393829983964, -0.6344280228570426},
               {0.5823965390431226, -0.252199547818611, 0.7727934131387771},
               {-0.4163101673817835, -0.909062385159307, 0.017071157635707435}),
        {-2.543347182121908e-17, -7.58898345046478e-17, -5.12023104428373e-17}},
       {matrix({-0.9968572104800306, 0.06478642141722427, -0.04558970842111182},
               {-0.07920916163129765, -0.8243553536514977, 0.5605034876071521},
               {-0.0012691050544133553, 0.5623530657034455, 0.8268962564108614}),
        {-0.39949801648743216, 1.4914482539996565, 0.5128552745411993}}},
      {{1.2705585784987389e-05, 3.860997050451282e-06, -1.1188614846110164e-05},
       {-1.1371070281442599e-05, 6.568497685436867e-07, -3.887725327454259e-06},
       {matrix({0.6370920694411041, -0.14066628461274527, 0.7578434478363569},
               {-0.5550923677323187, -0.7658853354769529, 0.32448746691772734},
               {0.5347767369104415, -0.6274015056362243, -0.5660222543194035}),
        {-1.0443367661184763e-05, 1.4297269776351198e-05, -1.459298666928217e-05}},
       {Mat3d::Identity(),
        {-2.5043317901365034e-22, -4.885076005287457e-22, 1.9349144322201888e-22}}}};
  for (const Case& c : cases) {
    const Shape a = bare_hull({c.vertex_a}, 0), b = bare_hull({c.vertex_b}, 0);
    const double size = c.vertex_a.norm();
    for (const char* name : {"sat", "sat-faces"}) {
      for (const Precision scalar : {Precision::float64, Precision::float32}) {
        for (const Task task : {Task::intersect, Task::penetration}) {
          const Outcome same = ask_named(name, scalar, task, a, c.a, b, c.b);
          EXPECT_EQ(same.answer, Answer::touching) << name;
          EXPECT_EQ(same.status, Status::ok);
          EXPECT_LE(same.lower, 0);
          EXPECT_GE(same.lower, -1e-15 * size);
          Pose away = c.b;
          away.translation += 1e-14 * size * Vec3d::UnitY();
          const Outcome apart = ask_named(name, scalar, task, a, c.a, b, away);
          EXPECT_EQ(apart.answer, Answer::separated) << name;
          EXPECT_EQ(apart.status, Status::ok);
        }
      }
    }
  }
}

// A matrix is used as it stands: one that was rounded to float is not quite a rotation.
TEST(Sat, TakesMatricesLiterally) {
  Random random(22);
  AxisTally tally;
  for (int k = 0; k < 300; ++k) {
    const Shape a = k % 2 == 0 ? unit_box(random) : small_hull(random);
    const Shape b = k % 3 == 0 ? unit_box(random) : small_hull(random);
    const auto coarse = [&] {
      Mat3d m = random_rotation(random).cast<float>().cast<double>();
      if (k % 4 == 0) m.col(0) *= -1;  // a reflection
      if (k % 5 == 0) m.col(1) *= 1.01;
      return m;
    };
    const Pose pose_a{coarse(), Vec3d::Zero()};
    const Pose pose_b{coarse(), random_vector(random, 0.5, 2)};
    check(a, pose_a, b, pose_b, 1e-13, 1e-5F, tally);
  }
  expect_both(tally);
}

}  // namespace
}  // namespace touchstone::sat_test
