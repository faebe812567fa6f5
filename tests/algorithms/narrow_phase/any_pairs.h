// Pairs of all kinds, apart, touching and overlapping, with the exact answers. Made once.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/narrow_phase/hard_pairs.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::test {

struct AnyPair {
  Shape a, b;  // a.kind <= b.kind
  Pose pose_a, pose_b;
  oracle::Measure truth;
  std::string name;

  // The greatest length of the bodies, and of the way between them (metres).
  double size() const {
    const auto of = [](const Shape& shape) {
      if (shape.kind == ShapeKind::halfspace) return std::abs(shape.offset);
      return shape.radius + shape.half_length + shape.half_extents.norm() + shape.radii.norm() + 1;
    };
    return of(a) + of(b) + (pose_a.translation - pose_b.translation).norm();
  }
  bool is_bounded() const { return std::isfinite(truth.middle()); }
};

inline Shape any_shape(Random& random, ShapeKind kind) {
  Shape shape = random_shape(random, kind, false, 12);
  for (double& radius : shape.radii) radius = uniform(random, 0.2, 1);
  shape.normal = 2 * random_direction(random);
  shape.offset = uniform(random, -1, 1);
  return shape;
}

inline std::vector<AnyPair> make_any_pairs(int count) {
  // Signed distances (metres); the others are as they fall.
  constexpr std::array wanted{0.5, -0.05, 1e-3, -1e-3, 1e-9, -1e-9, 0.0, 0.02};
  Random random(71);
  oracle::Oracle oracle;
  std::vector<AnyPair> pairs;
  for (const ShapeKind kind_a : all_shape_kinds) {
    for (const ShapeKind kind_b : all_shape_kinds) {
      if (kind_b < kind_a) continue;
      for (int k = 0; k < count; ++k) {
        AnyPair pair{.a = any_shape(random, kind_a),
                     .b = any_shape(random, kind_b),
                     .pose_a = {random_rotation(random), random_direction(random)},
                     .pose_b = {random_rotation(random), Vec3d::Zero()},
                     .truth = {},
                     .name = std::string(to_string(kind_a)) + "-" + std::string(to_string(kind_b)) +
                             " " + std::to_string(k)};
        pair.pose_b.translation = pair.pose_a.translation + random_vector(random, 0, 2);
        const oracle::Solid solid_a(pair.a), solid_b(pair.b);
        const auto measure = [&] {
          return oracle.measure({solid_a, pair.pose_a}, {solid_b, pair.pose_b});
        };
        pair.truth = measure();
        const auto place = static_cast<std::size_t>(k) % (wanted.size() + 4);
        for (int step = 0; place < wanted.size() && step < 2; ++step) {
          if (pair.truth.normal.isZero() || !pair.is_bounded()) break;
          pair.pose_b.translation +=
              (wanted[place] - pair.truth.middle()) * pair.truth.normal.normalized();
          pair.truth = measure();
        }
        pairs.push_back(std::move(pair));
      }
    }
  }
  return pairs;
}

inline const std::vector<AnyPair>& any_pairs() {
  static const std::vector<AnyPair> pairs = make_any_pairs(drawn(14, 4));
  return pairs;
}

// Asks a pair, into `outcome` as it is.
inline void ask_into(NarrowPhase& algorithm, Task task, const AnyPair& pair, Call call,
                     Outcome& outcome) {
  const std::array<Pose, 2> poses{pair.pose_a, pair.pose_b};
  const std::array<std::uint32_t, 2> shape_of{0, 1};
  const std::array<std::uint32_t, 1> first{0}, second{1};
  const PairBatch batch{
      .kind_a = pair.a.kind,
      .kind_b = pair.b.kind,
      .pairs = {.first = first, .second = second, .shape_of = shape_of, .poses = poses}};
  if (call == Call::alone) {
    algorithm.solve_alone(task, batch, 0, outcome);
  } else {
    algorithm.solve(task, batch, {&outcome, 1});
  }
}

}  // namespace touchstone::test
