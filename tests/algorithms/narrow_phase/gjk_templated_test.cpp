// gjk-templated is gjk with another dispatch: the same bits for all kinds, tasks and scalars, on
// random bodies and on those that are hard.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/hard_pairs.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::gjk_templated_test {
namespace {

using namespace test;

const NarrowPhaseEntry& templated() { return *registry::find<NarrowPhaseEntry>("gjk-templated"); }
const NarrowPhaseEntry& switching() { return *registry::find<NarrowPhaseEntry>("gjk"); }

// near: apart or together by 1e-15 to 0.1 of their size. flat: sizes of zero, needles, sheets.
// aligned: with axes in common, some with the same centre. stretched: no rotation but any matrix.
enum class PoseSort { plain, near, flat, aligned, stretched, huge };
constexpr std::array sorts{PoseSort::plain,   PoseSort::near,      PoseSort::flat,
                           PoseSort::aligned, PoseSort::stretched, PoseSort::huge};

// A prism with more vertices than hulls that are scanned.
Shape great_prism() {
  constexpr std::uint32_t sides = 120;
  std::vector<Vec3d> vertices;
  std::vector<std::vector<std::uint32_t>> loops(2);
  for (std::uint32_t k = 0; k < sides; ++k) {
    const double angle = 2 * M_PI * k / sides;
    const std::uint32_t next = (k + 1) % sides;
    for (const double z : {-0.4, 0.4}) {
      vertices.emplace_back(0.6 * std::cos(angle), 0.6 * std::sin(angle), z);
    }
    loops[0].insert(loops[0].begin(), 2 * k);
    loops[1].push_back(2 * k + 1);
    loops.push_back({2 * k, 2 * next, 2 * next + 1, 2 * k + 1});
  }
  return hull(std::move(vertices), loops);
}

Shape draw(Random& random, ShapeKind kind, bool flat) {
  static const Shape prism = great_prism();
  if (kind == ShapeKind::hull && !flat && random() % 4 == 0) return prism;
  Shape shape = random_shape(random, kind, flat);
  shape.radii = shape.half_extents;
  shape.normal = random_direction(random) * uniform(random, 0.5, 2);
  shape.offset = uniform(random, -0.5, 0.5);
  return shape;
}

void add_pair(Random& random, Kinds kinds, PoseSort sort, Pairs& pairs) {
  const bool flat = sort == PoseSort::flat;
  const Shape a = draw(random, kinds.a, flat), b = draw(random, kinds.b, flat);
  Pose pose_a{random_rotation(random), random_direction(random)};
  Pose pose_b{random_rotation(random), Vec3d::Zero()};
  Vec3d offset = random_vector(random, 0, flat ? 1 : 2.2);
  if (sort == PoseSort::aligned) {
    pose_a = {Mat3d::Identity(), Vec3d::Zero()};
    const double angle = M_PI / 2 * static_cast<double>(random() % 3);
    pose_b.rotation = turn(angle, Vec3d::Unit(static_cast<int>(random() % 3)));
    offset = static_cast<double>(random() % 4) / 2 * Vec3d::Unit(static_cast<int>(random() % 3));
  }
  if (sort == PoseSort::stretched) {
    for (double& x : pose_a.rotation.reshaped()) x *= uniform(random, -1, 1.5);
    for (double& x : pose_b.rotation.reshaped()) x += power(random, -17, -0.5);
  }
  if (sort == PoseSort::huge) {
    const double scale = power(random, -9, 9);
    for (Pose* pose : {&pose_a, &pose_b}) pose->rotation *= scale;
    offset *= scale;
    pose_a.translation *= power(random, 0, 9);
  }
  pose_b.translation = pose_a.translation + offset;
  if (sort == PoseSort::near || flat) {
    for (int step = 0; step < 2; ++step) {
      const Task task = step == 0 ? Task::distance : Task::penetration;
      const Outcome found = ask(switching(), {}, task, a, pose_a, b, pose_b);
      if (std::isnan(found.distance)) continue;
      const double wanted = (random() % 2 == 0 ? 1 : -1) * power(random, -15, -1);
      pose_b.translation += (wanted - found.distance) * found.normal;
      break;
    }
  }
  pairs.add(a, pose_a, b, pose_b);
}

std::vector<Outcome> solve_with(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                                Task task, const Pairs& pairs) {
  const auto algorithm = entry.make(settings);
  algorithm->bind(pairs.shapes);
  std::vector<Outcome> outcomes(pairs.size());
  algorithm->solve(task, pairs.batch(0, pairs.size()), outcomes);
  return outcomes;
}

// Expects gjk's outcomes, bit for bit, and returns them.
std::vector<Outcome> expect_alike(const NarrowPhaseSettings& settings, Task task,
                                  const Pairs& pairs, const std::string& what) {
  const std::vector<Outcome> expected = solve_with(switching(), settings, task, pairs);
  const std::vector<Outcome> outcomes = solve_with(templated(), settings, task, pairs);
  expect_same(expected, outcomes, what);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(expected[i].iterations, outcomes[i].iterations) << what << ", pair " << i;
    EXPECT_EQ(expected[i].support_calls, outcomes[i].support_calls) << what << ", pair " << i;
  }
  return expected;
}

std::string name(Kinds kinds, Precision scalar, Task task, PoseSort sort) {
  return std::string(to_string(kinds.a)) + "-" + std::string(to_string(kinds.b)) + " " +
         std::string(to_string(scalar)) + " " + std::string(to_string(task)) + " sort " +
         std::to_string(static_cast<int>(sort));
}

std::vector<Kinds> all_kind_pairs() {
  std::vector<Kinds> pairs;
  for (const ShapeKind a : all_shape_kinds) {
    for (const ShapeKind b : all_shape_kinds) {
      if (a <= b) pairs.push_back({a, b});
    }
  }
  return pairs;
}

TEST(GjkTemplated, HasTheBitsOfGjk) {
  Random random(31);
  std::array<std::size_t, 4> answers{};
  for (const Kinds kinds : all_kind_pairs()) {
    std::array<std::size_t, 4> of_kinds{};
    for (const PoseSort sort : sorts) {
      Pairs pairs;
      while (pairs.size() < drawn(36, 6)) add_pair(random, kinds, sort, pairs);
      for (const Precision scalar : scalars) {
        for (const Task task : all_tasks) {
          const std::string what = name(kinds, scalar, task, sort);
          for (const Outcome& o : expect_alike(settings_of(scalar), task, pairs, what)) {
            ++of_kinds[static_cast<std::size_t>(o.answer)];
          }
          if (HasFailure()) return;
        }
      }
    }
    const std::string what(to_string(kinds.a));
    EXPECT_GT(of_kinds[static_cast<std::size_t>(Answer::overlapping)], 300u / one_in) << what;
    if (kinds.a != ShapeKind::halfspace) {
      EXPECT_GT(of_kinds[static_cast<std::size_t>(Answer::separated)], 300u / one_in) << what;
    }
    for (std::size_t k = 0; k < 4; ++k) answers[k] += of_kinds[k];
  }
  EXPECT_GT(answers[static_cast<std::size_t>(Answer::touching)] +
                answers[static_cast<std::size_t>(Answer::unknown)],
            100u / one_in)
      << "nothing was hard";
}

TEST(GjkTemplated, HasTheBitsOfGjkAtEveryLevelAndSetting) {
  Random random(32);
  for (const Kinds kinds : all_kind_pairs()) {
    Pairs pairs;
    while (pairs.size() < drawn(16, 4)) add_pair(random, kinds, PoseSort::near, pairs);
    for (const Precision scalar : scalars) {
      for (const Task task : all_tasks) {
        const std::string what = name(kinds, scalar, task, PoseSort::near);
        for (const Isa level : isa_levels()) {
          limit_isa(level);
          expect_alike(settings_of(scalar), task, pairs, what);
        }
        limit_isa(isa_of_machine());
        NarrowPhaseSettings settings = settings_of(scalar);
        settings.tolerance = 1e-3;
        expect_alike(settings, task, pairs, what + " tolerance");
        settings.max_iterations = 2;
        expect_alike(settings, task, pairs, what + " cap");
        settings = settings_of(scalar);
        settings.duality_gap = 1e-6;
        expect_alike(settings, task, pairs, what + " duality gap");
        if (HasFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace touchstone::gjk_templated_test
