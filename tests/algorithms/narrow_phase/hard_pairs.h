// Pairs of bodies that are hard to tell apart, at random.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/narrow_phase.h"
#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/narrow_phase/bodies.h"

namespace touchstone::test {

struct Kinds {
  ShapeKind a, b;
  std::size_t hull_points = 16;  // at most
};
struct Pairs {
  std::vector<Shape> shapes;
  std::vector<Pose> poses;
  std::vector<std::uint32_t> shape_of, first, second;

  void add(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
    for (const auto& [shape, pose] : {std::pair{a, pose_a}, std::pair{b, pose_b}}) {
      (shapes.size() % 2 == 0 ? first : second)
          .push_back(static_cast<std::uint32_t>(shapes.size()));
      shape_of.push_back(static_cast<std::uint32_t>(shapes.size()));
      shapes.push_back(shape);
      poses.push_back(pose);
    }
  }
  std::size_t size() const { return first.size(); }
  PairBatch batch(std::size_t begin, std::size_t count) const {
    return {.kind_a = shapes[0].kind,
            .kind_b = shapes[1].kind,
            .pairs = {.first = std::span(first).subspan(begin, count),
                      .second = std::span(second).subspan(begin, count),
                      .shape_of = shape_of,
                      .poses = poses}};
  }
};

inline double power(Random& random, double low, double high) {
  return std::pow(10.0, uniform(random, low, high));
}

// Four points or more; hard: in a plane, along a line, one, or about so.
inline Shape random_hull(Random& random, std::size_t most_points, bool hard) {
  std::vector<Vec3d> points(4 + random() % (most_points - 3));
  Vec3d stretch = Vec3d::Ones();
  int dimension = 3;
  if (hard) {
    points.resize(1 + random() % most_points);
    for (int axis = 0; axis < 3; ++axis) {
      stretch[axis] = random() % 4 == 0 ? 0 : power(random, -5, 0);
      if (stretch[axis] == 0) --dimension;
    }
  }
  for (Vec3d& point : points) point = stretch.cwiseProduct(0.6 * random_direction(random));
  dimension = std::min(dimension, static_cast<int>(points.size()) - 1);
  return bare_hull(std::move(points), dimension);
}

inline Shape random_shape(Random& random, ShapeKind kind, bool hard, std::size_t hull_points = 16) {
  if (kind == ShapeKind::hull) return random_hull(random, hull_points, hard);
  Shape shape;
  shape.kind = kind;
  const auto length = [&] {
    if (!hard) return uniform(random, 0.2, 1);
    return random() % 5 == 0 ? 0 : power(random, -5, 0);
  };
  shape.radius = length();
  shape.half_length = length();
  for (double& half : shape.half_extents) half = length();
  shape.radii = shape.half_extents;
  return shape;
}

inline Mat3d turn(double angle, const Vec3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

// The property that makes a pair hard.
enum class Sort { plain, parallel, stacked, slivers, scaled, remote, skewed };
inline constexpr std::array all_sorts{Sort::plain,  Sort::parallel, Sort::stacked, Sort::slivers,
                                      Sort::scaled, Sort::remote,   Sort::skewed};

// Adds a pair of random sizes and places; b is moved until the signed distance is about one of a
// ladder of lengths.
inline void add_pair(Random& random, oracle::Oracle& oracle, Kinds kinds, Sort sort, Pairs& pairs) {
  const bool slivers = sort == Sort::slivers;
  Shape a = random_shape(random, kinds.a, slivers, kinds.hull_points);
  Shape b = random_shape(random, kinds.b, slivers, kinds.hull_points);
  Pose pose_a{random_rotation(random), random_direction(random)};
  Pose pose_b{random_rotation(random), Vec3d::Zero()};
  if (sort == Sort::parallel || sort == Sort::stacked) {
    const Vec3d axis = Vec3d::Unit(static_cast<int>(random() % 3));
    const double angle = random() % 3 == 0 ? 0 : power(random, -17, 0);
    pose_b.rotation =
        pose_a.rotation * turn(angle, random() % 2 == 0 ? axis : random_direction(random));
    if (random() % 3 == 0) pose_b.rotation = pose_b.rotation * turn(M_PI / 2, axis);
  }
  Vec3d offset = random_vector(random, 0.2, 2.2);
  if (sort == Sort::stacked) {
    if (kinds.a == kinds.b && random() % 2 == 0) b = a;
    const double half = a.kind == ShapeKind::hull ? 0.6 : a.half_extents.x();
    offset = pose_a.rotation * (2 * uniform(random, 0.8, 1.1) * half * Vec3d::UnitX());
    if (random() % 2 == 0) offset += pose_a.rotation.col(1) * uniform(random, -0.3, 0.3);
  }
  const double scale = sort == Sort::scaled ? power(random, -6, 6) : 1;
  for (Shape* shape : {&a, &b}) {
    shape->radius *= scale;
    shape->half_length *= scale;
    shape->half_extents *= scale;
    shape->radii *= scale;
    if (shape->kind != ShapeKind::hull) continue;
    std::vector<Vec3d> vertices = shape->hull->vertices;
    for (Vec3d& vertex : vertices) vertex *= scale;
    *shape = bare_hull(std::move(vertices), shape->hull->dimension);
  }
  pose_a.translation *= scale;
  if (sort == Sort::remote) pose_a.translation = 1e7 * random_direction(random);
  if (sort == Sort::skewed) {
    for (Pose* pose : {&pose_a, &pose_b}) {
      pose->rotation += power(random, -17, -0.5) * Mat3d::Random();
      if (random() % 4 == 0) pose->rotation.col(0) *= -1;
      if (random() % 16 == 0) pose->rotation *= power(random, -8, 8);
    }
  }
  pose_b.translation = pose_a.translation + scale * offset;
  const oracle::Solid solid_a(a), solid_b(b);
  if (random() % 4 != 0) {
    const double wanted = (random() % 2 == 0 ? 1 : -1) * scale * power(random, -14, -0.5);
    for (int step = 0; step < 2; ++step) {
      const oracle::Measure measure = oracle.measure({solid_a, pose_a}, {solid_b, pose_b});
      if (!measure.normal.isZero()) {
        pose_b.translation += (wanted - measure.middle()) * measure.normal.normalized();
      }
    }
  }
  pairs.add(a, pose_a, b, pose_b);
}

inline Pairs hard_pairs(std::uint64_t seed, Kinds kinds, Sort sort, std::size_t count) {
  Random random(seed);
  std::srand(static_cast<unsigned>(seed));  // for Eigen's random matrices
  oracle::Oracle oracle;
  Pairs pairs;
  while (pairs.size() < count) add_pair(random, oracle, kinds, sort, pairs);
  return pairs;
}

// Solves the pairs in batches of the given size.
inline std::vector<Outcome> solve(const NarrowPhaseEntry& entry, Precision scalar, Task task,
                                  const Pairs& pairs, std::size_t batch_size) {
  const auto algorithm = entry.make(settings_of(scalar));
  algorithm->bind(pairs.shapes);
  std::vector<Outcome> outcomes(pairs.size());
  for (std::size_t begin = 0; begin < pairs.size(); begin += batch_size) {
    const std::size_t count = std::min(batch_size, pairs.size() - begin);
    algorithm->solve(task, pairs.batch(begin, count), std::span(outcomes).subspan(begin, count));
  }
  return outcomes;
}

inline std::vector<std::uint64_t> bits_of(const Outcome& o) {
  std::vector<std::uint64_t> bits = {static_cast<std::uint64_t>(o.answer),
                                     static_cast<std::uint64_t>(o.status)};
  for (const double x : {o.distance, o.lower, o.upper}) {
    bits.push_back(std::bit_cast<std::uint64_t>(x));
  }
  for (const Vec3d& v : {o.normal, o.witness_a, o.witness_b}) {
    for (const double x : v) bits.push_back(std::bit_cast<std::uint64_t>(x));
  }
  return bits;
}

inline void expect_same(const std::vector<Outcome>& a, const std::vector<Outcome>& b,
                        const std::string& what) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(bits_of(a[i]), bits_of(b[i])) << what << ", pair " << i;
  }
}

}  // namespace touchstone::test
