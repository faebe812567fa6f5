#include "tests/algorithms/oracle/samples.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/shapes.h"

namespace touchstone::oracle {
namespace {

using touchstone::reference::make_box;
using touchstone::reference::make_capsule;
using touchstone::reference::make_cone;
using touchstone::reference::make_cylinder;
using touchstone::reference::make_ellipsoid;
using touchstone::reference::make_halfspace;
using touchstone::reference::make_hull;
using touchstone::reference::make_sphere;

Placed placed(const Shape& shape, const Pose& pose = {}) {
  return {std::make_shared<Solid>(shape), pose};
}

Pose random_pose(Random& random, double reach) {
  const Mat3d rotation = random.rotation();
  return {rotation, random.vector(reach)};
}

Shape random_box(Random& random) {
  const double x = random.uniform(0.2, 1.5), y = random.uniform(0.2, 1.5);
  return make_box(x, y, random.uniform(0.2, 1.5));
}

Shape random_hull(Random& random, int vertices) {
  std::vector<Vec3d> points;
  for (int i = 0; i < vertices; ++i) points.push_back(random.direction());
  return make_hull(points);
}

// A point, a segment, or a polygon with up to six corners; exactly flat.
Shape random_flat(Random& random) {
  std::vector<Vec3d> points;
  for (int i = random.below(6); i >= 0; --i) {
    const double x = random.uniform(-1, 1);
    points.emplace_back(x, random.uniform(-1, 1), 0);
  }
  return make_hull(points);
}

Shape random_round(Random& random) {
  const double radius = random.uniform(0, 1);
  return random.below(2) == 0 ? make_sphere(radius)
                              : make_capsule(radius, random.uniform(0.2, 1.5));
}

Shape random_polytope(Random& random) {
  switch (random.below(4)) {
    case 0: return random_box(random);
    case 1: return random_hull(random, 4 + random.below(5));
    case 2: return random_flat(random);
    default: return random_round(random);
  }
}

Shape random_curved(Random& random) {
  const double x = random.uniform(0.2, 1.5), y = random.uniform(0.2, 1.5);
  switch (random.below(3)) {
    case 0: return make_cylinder(x, y);
    case 1: return make_cone(x, y);
    default: return make_ellipsoid(x, y, random.uniform(0.2, 1.5));
  }
}

// Moves b along the shortest connection until the signed distance is about `gap`.
void bring(Sample& sample, double gap) {
  Oracle oracle;
  const Measure measure = oracle.measure(sample.a.body(), sample.b.body());
  sample.b.pose.translation += (gap - measure.middle()) * measure.normal;
}

void scale(Sample& sample, int exponent) {
  for (Placed* body : {&sample.a, &sample.b}) {
    body->pose.rotation *= std::ldexp(1.0, exponent);
    body->pose.translation *= std::ldexp(1.0, exponent);
  }
}

// --- pairs in general position ---

Sample boxes(Random& random, int) {
  const Shape a = random_box(random), b = random_box(random);
  const Pose pose_a = random_pose(random, 1.5);
  return {placed(a, pose_a), placed(b, random_pose(random, 1.5))};
}

Sample tetrahedra(Random& random, int) {
  const Shape a = random_hull(random, 4), b = random_hull(random, 4);
  const Pose pose_a = random_pose(random, 0.5);
  return {placed(a, pose_a), placed(b, random_pose(random, 0.5))};
}

Sample hulls(Random& random, int) {
  const Shape a = random_hull(random, 4 + random.below(4)),
              b = random_hull(random, 4 + random.below(4));
  const Pose pose_a = random_pose(random, 0.9);
  return {placed(a, pose_a), placed(b, random_pose(random, 0.9))};
}

Sample great_hulls(Random& random, int) {
  const Shape a = random_hull(random, 8 + random.below(35)),
              b = random_hull(random, 8 + random.below(35));
  const Pose pose_a = random_pose(random, 1.1);
  return {placed(a, pose_a), placed(b, random_pose(random, 1.1))};
}

Sample flats(Random& random, int number) {
  const Shape a = random_flat(random);
  const Shape b = number % 2 == 0 ? random_flat(random) : random_polytope(random);
  const Pose pose_a = random_pose(random, 0.3);
  return {placed(a, pose_a), placed(b, random_pose(random, 0.3))};
}

Sample rounds(Random& random, int) {
  const Shape a = random_round(random), b = random_polytope(random);
  const Pose pose_a = random_pose(random, 1.3);
  return {placed(a, pose_a), placed(b, random_pose(random, 1.3))};
}

Sample quaternions(Random& random, int number) {
  Sample sample = number % 2 == 0 ? boxes(random, number) : rounds(random, number);
  for (Placed* body : {&sample.a, &sample.b}) {
    std::array<double, 4> q;
    for (double& part : q) part = random.uniform(-1, 1);
    if (number % 3 == 0) {
      // The length's square is beyond the range of double, or the length has only a few bits.
      const int exponent = random.below(2) == 0 ? random.below(1200) - 600 : 2;
      for (double& part : q) part = std::ldexp(std::round(4 * part), exponent);
      if (q == std::array<double, 4>{}) q[0] = 1;
    }
    body->quaternion = q;
  }
  return sample;
}

Sample matrices(Random& random, int number) {
  Sample sample = hulls(random, number);
  for (Placed* body : {&sample.a, &sample.b}) {
    Mat3d& m = body->pose.rotation;
    for (int k = 0; k < 9; ++k) m(k) = random.uniform(-1.3, 1.3);
    if (random.below(4) == 0) m.col(random.below(3)) = 2 * m.col(random.below(3));
  }
  return sample;
}

// --- pairs that touch exactly, and others with nothing in general position ---

Shape integer_hull(Random& random, int most) {
  std::vector<Vec3d> points;
  for (int i = 1 + random.below(most); i > 0; --i) {
    const int x = random.below(5) - 2, y = random.below(5) - 2;
    points.emplace_back(x, y, random.below(5) - 2);
  }
  return make_hull(points);
}

Sample integers(Random& random, int number) {
  const auto body = [&] {
    Shape shape = integer_hull(random, 7);
    if (number % 3 == 1) shape = make_box(random.below(3), random.below(3), random.below(3));
    if (number % 3 == 2) {
      shape = random.below(2) == 0 ? make_sphere(random.below(4))
                                   : make_capsule(random.below(3), random.below(3));
    }
    Pose pose;
    if (random.below(2) == 0) {
      for (int k = 0; k < 9; ++k) pose.rotation(k) = random.below(3) - 1;
    }
    for (int k = 0; k < 3; ++k) pose.translation[k] = random.below(5) - 2;
    return placed(shape, pose);
  };
  Placed a = body();
  if (number % 3 == 2 && random.below(2) == 0) a = placed(integer_hull(random, 7), a.pose);
  return {a, body()};
}

// The bodies have one random pose, so that bodies that touch in body coordinates touch in the
// world.
Sample one_pose(Random& random, int number) {
  Sample sample;
  const Pose pose = random_pose(random, 10);
  std::vector<Vec3d> points = integer_hull(random, 8).hull->vertices;
  sample.a = placed(make_hull(points), pose);
  points = integer_hull(random, 8).hull->vertices;
  const double x = random.below(5) - 2, y = random.below(5) - 2;
  const Vec3d offset(x, y, random.below(3) - 1);
  for (Vec3d& point : points) point += offset;
  sample.b = placed(make_hull(points), pose);
  if (number % 4 == 0) {
    const std::array<double, 4> q = {random.uniform(-1, 1), random.uniform(-1, 1),
                                     random.uniform(-1, 1), random.uniform(-1, 1)};
    sample.a.quaternion = sample.b.quaternion = q;
  }
  return sample;
}

// One body twice, one inside the other, or both around one point.
Sample coincident(Random& random, int number) {
  Sample sample;
  const Shape shape = number % 2 == 0 ? random_polytope(random) : integer_hull(random, 8);
  sample.a = placed(shape, random_pose(random, 2));
  sample.b = sample.a;
  if (number % 4 >= 2) {
    sample.b.pose.rotation *= number % 8 < 4 ? 0.5 : -1;
  } else if (number % 8 >= 4) {
    sample.b = placed(random_polytope(random), random_pose(random, 0));
    sample.b.pose.translation = sample.a.pose.translation;
  }
  return sample;
}

Sample near(Random& random, int number) {
  Sample sample = number % 3 == 0   ? boxes(random, number)
                  : number % 3 == 1 ? tetrahedra(random, number)
                                    : rounds(random, number);
  if (number % 5 == 0) {  // face to face
    sample.b.pose.rotation = sample.a.pose.rotation;
  }
  constexpr double gaps[] = {1e-6, 1e-9, 1e-12, 1e-15, 1e-16, 3e-17, 0};
  const double gap = gaps[random.below(7)];
  bring(sample, random.below(2) == 0 ? gap : -gap);
  return sample;
}

// --- extremes ---

Sample scaled(Random& random, int number) {
  Sample sample = number % 2 == 0 ? boxes(random, number) : tetrahedra(random, number);
  if (number % 3 == 0) bring(sample, random.uniform(-1e-15, 1e-15));
  constexpr int exponents[] = {1000, -1000, 500, -500, -1060};
  scale(sample, exponents[random.below(5)]);
  return sample;
}

// The power of two is in the matrix, and its reciprocal in the body.
Sample scaled_within(Random& random, int number) {
  Sample sample = tetrahedra(random, number);
  for (Placed* body : {&sample.a, &sample.b}) {
    const double power = std::ldexp(1.0, random.below(1800) - 900);
    std::vector<Vec3d> points = body->solid->vertices;
    for (Vec3d& point : points) point *= power;
    body->pose.rotation /= power;
    body->solid = std::make_shared<Solid>(make_hull(points));
  }
  return sample;
}

Sample subnormal_bits(Random& random, int number) {
  Sample sample = integers(random, number);
  const double least = std::numeric_limits<double>::denorm_min();
  for (Placed* body : {&sample.a, &sample.b}) {
    for (int k = 0; k < 3; ++k) {
      double& x = body->pose.translation[k];
      if (x == 0 && random.below(2) == 0) x = least * (random.below(3) - 1);
    }
    for (int k = 0; k < 9; ++k) {
      double& x = body->pose.rotation(k);
      if (x == 0 && random.below(4) == 0) x = least * (random.below(9) - 4);
    }
  }
  return sample;
}

Sample far_away(Random& random, int number) {
  Sample sample = near(random, number);
  const Vec3d offset = 0x1p40 * random.direction();
  sample.a.pose.translation += offset;
  sample.b.pose.translation += offset;
  return sample;
}

Sample thin(Random& random, int number) {
  Sample sample;
  for (Placed* body : {&sample.a, &sample.b}) {
    Vec3d sizes(1, random.uniform(0.5, 1), 1e-8);
    if (random.below(2) == 0) sizes.y() = 1e-8;
    *body = placed(make_box(sizes.x(), sizes.y(), sizes.z()), random_pose(random, 0.3));
  }
  if (number % 2 == 0) bring(sample, random.uniform(-2e-8, 2e-8));
  return sample;
}

Sample size_ratio(Random& random, int number) {
  Sample sample = boxes(random, number);
  sample.b.pose.rotation *= 1e-12;
  bring(sample, random.uniform(-2e-12, 2e-12));
  return sample;
}

Sample nearly_parallel(Random& random, int number) {
  Sample sample = boxes(random, number);
  const double angle = random.uniform(-2e-15, 2e-15);
  sample.b.pose.rotation =
      sample.a.pose.rotation * Eigen::AngleAxisd(angle, random.direction()).toRotationMatrix();
  bring(sample, random.uniform(-1e-15, 1e-15));
  return sample;
}

// Triangles of hardly any area beside balls, where a height over a plane means nothing.
Sample slivers(Random& random, int number) {
  const double width = std::ldexp(1.0, -20 - random.below(60));
  const Vec3d along = random.direction();
  std::vector<Vec3d> points;
  for (int i = 3 + random.below(3); i > 0; --i) {
    points.push_back(random.uniform(-1, 1) * along + width * random.direction());
  }
  const Shape ball = number % 2 == 0 ? make_sphere(random.uniform(0, 0.7))
                                     : make_capsule(random.uniform(0, 0.5), random.uniform(0, 0.5));
  Sample sample = {placed(make_hull(points)), placed(ball, random_pose(random, 0.7))};
  if (number % 5 == 0) bring(sample, random.uniform(-1, 1) * 1e-13);
  return sample;
}

// A polytope beside a ball that is hardly there: what is added for the rounding of a distance has
// to be more than a part of the radius.
Sample small_balls(Random& random, int number) {
  const Shape polytope = number % 2 == 0 ? random_box(random) : random_hull(random, 4);
  const Shape ball = make_sphere(random.uniform(1, 2) * 1e-9);
  const Pose pose = random_pose(random, 1);
  Sample sample = {placed(polytope, pose), placed(ball, random_pose(random, 2))};
  bring(sample, random.uniform(-1, 1) * 1e-16);
  return sample;
}

}  // namespace

std::vector<Regime> exact_regimes() {
  return {
      {"Boxes", boxes, 20, 0, 20, 2000, 1000, 1000},
      {"Tetrahedra", tetrahedra, 20, 0, 20, 2000, 2000, 1000},
      {"Hulls", hulls, 20, 0, 20, 2000, 200, 1000},
      {"GreatHulls", great_hulls, 20, 0, 20, 500, 0, 200},
      {"Flats", flats, 20, 0, 5, 2000, 500, 1000},
      {"Rounds", rounds, 20, 0, 20, 2000, 500, 1000},
      {"Quaternions", quaternions, 20, 0, 20, 2000, 300, 1000},
      {"Matrices", matrices, 20, 0, 20, 2000, 200, 1000},
      {"Integers", integers, 20, 5, 20, 5000, 2000, 2000},
      {"OnePose", one_pose, 20, 5, 20, 3000, 500, 1000},
      {"Coincident", coincident, 0, 5, 50, 2000, 200, 500},
      {"Near", near, 20, 0, 20, 2000, 500, 1000},
      {"Scaled", scaled, 20, 0, 20, 1000, 300, 500},
      {"ScaledWithin", scaled_within, 20, 0, 20, 1000, 300, 500},
      {"SubnormalBits", subnormal_bits, 20, 1, 20, 1000, 300, 500},
      {"FarAway", far_away, 20, 0, 20, 1000, 300, 500},
      {"Thin", thin, 10, 0, 10, 1000, 300, 500},
      {"SizeRatio", size_ratio, 20, 0, 20, 1000, 300, 500},
      {"NearlyParallel", nearly_parallel, 10, 0, 10, 1000, 300, 500},
      {"Slivers", slivers, 20, 0, 20, 1000, 300, 500},
      {"SmallBalls", small_balls, 20, 0, 20, 1000, 300, 500},
  };
}

Sample curved_sample(Random& random, int number) {
  const Shape a = random_curved(random);
  const Shape b = number % 2 == 0 ? random_curved(random) : random_polytope(random);
  const Pose pose_a = random_pose(random, 1.5);
  Sample sample = {placed(a, pose_a), placed(b, random_pose(random, 1.5))};
  if (number % 4 >= 2) std::swap(sample.a, sample.b);
  return sample;
}

Sample halfspace_sample(Random& random, int number) {
  const auto halfspace = [&] {
    Pose pose = random_pose(random, 1);
    for (int k = 0; k < 9; ++k) pose.rotation(k) += random.uniform(-0.5, 0.5);
    return placed(make_halfspace(random.direction(), random.uniform(-1, 1)), pose);
  };
  Sample sample;
  sample.a = halfspace();
  if (number % 8 == 0) {
    sample.b = halfspace();
    if (number % 16 == 0) {
      sample.b = sample.a;
      sample.b.solid = std::make_shared<Solid>(
          make_halfspace(-2 * sample.a.solid->normal, random.uniform(-1, 1)));
    }
  } else {
    const Shape shape = number % 8 < 4 ? random_polytope(random) : random_curved(random);
    sample.b = placed(shape, random_pose(random, 1));
  }
  if (number % 2 == 0) std::swap(sample.a, sample.b);
  return sample;
}

Sample nearly_touching_sample(Random& random, int number) {
  switch (number % 5) {
    case 0: return nearly_parallel(random, number);
    case 1: return slivers(random, 5 * number);
    case 2: return one_pose(random, number);
    case 3: return small_balls(random, number);
    default: return near(random, number);
  }
}

}  // namespace touchstone::oracle
