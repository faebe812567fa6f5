// Planes that pairs carry from the frame before, many at a time: the lanes say what one plane says,
// and batches that start from them are as right as the exact answer.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/batch/plane_lanes.h"
#include "algorithms/kernels/gjk/carried_plane.h"
#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone::warm_planes_test {
namespace {

using namespace reference;

void turn(Random& random, double angle, Pose& pose) {
  pose.rotation = Eigen::AngleAxisd(angle, random.direction()).toRotationMatrix() * pose.rotation;
}

// Pairs of bodies with planes that they carried a little way; some are spoilt.
struct Carried {
  std::vector<Pose> poses;
  std::vector<std::uint32_t> first, second, memory_of;
  std::vector<PairMemory> memories;
  std::vector<CarriedPlane> planes;  // of the pairs, as they lie in the memories
};

Carried carried_pairs(Random& random, std::size_t count) {
  Carried pairs;
  pairs.memories.resize(count);
  pairs.planes.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double size = std::pow(10, random.uniform(-3, 3));
    Pose a, b;
    a.rotation = random.rotation();
    b.rotation = random.rotation();
    a.translation = random.vector(3 * size);
    b.translation = a.translation + size * random.uniform(1, 3) * random.direction();
    const Vec3d normal = (b.translation - a.translation).normalized();
    CarriedPlane plane = CarriedPlane::make(normal, size * random.uniform(-0.1, 0.5), size, a,
                                            size * random.uniform(0.1, 1), b);
    if (random.below(5) == 0) plane = {};
    // Memories lie in another order.
    const std::size_t slot = count - 1 - i;
    std::memcpy(pairs.memories[slot].bytes.data(), &plane, sizeof plane);
    if (random.below(9) == 0) {
      pairs.memories[slot].bytes[static_cast<std::size_t>(random.below(40))] ^= std::byte{1};
    }
    std::memcpy(static_cast<void*>(&pairs.planes[i]), pairs.memories[slot].bytes.data(),
                sizeof plane);
    const double part = std::pow(10, random.uniform(-4, -0.3));
    turn(random, part, a);
    turn(random, part, b);
    b.translation += random.vector(0.3 * part * size);
    if (random.below(9) == 0) a.rotation.col(1) += random.vector(1e-3);
    if (random.below(30) == 0) b.rotation *= 3;
    if (random.below(30) == 0) b.translation.y() = std::numeric_limits<double>::infinity();
    if (random.below(30) == 0) a.rotation(1, 2) = std::numeric_limits<double>::quiet_NaN();
    pairs.poses.push_back(a);
    pairs.poses.push_back(b);
    pairs.first.push_back(static_cast<std::uint32_t>(2 * i));
    pairs.second.push_back(static_cast<std::uint32_t>(2 * i + 1));
    pairs.memory_of.push_back(static_cast<std::uint32_t>(slot));
  }
  return pairs;
}

TEST(PlaneLanes, SayWhatOnePlaneSays) {
  Random random(3);
  int parted = 0, open = 0, directed = 0;
  for (const Isa level : isa_levels()) {
    limit_isa(level);
    for (int n = 0; n < drawn(60, 25); ++n) {
      const std::size_t count = static_cast<std::size_t>(random.below(40)) + 1;
      const Carried pairs = carried_pairs(random, count);
      const std::vector<CarriedPlane>& planes = pairs.planes;
      const double margin = random.below(2) ? 0.1 : 0;
      std::vector<Outcome> outcomes(count);
      std::vector<std::uint32_t> left(count);
      std::vector<std::array<float, 4>> directions(count);
      const std::size_t left_count =
          part_by_planes({.pairs = {pairs.first, pairs.second, {}, pairs.poses},
                          .memory = pairs.memories[0].bytes.data(),
                          .memory_of = pairs.memory_of,
                          .margin = margin},
                         outcomes.data(), {left.data(), directions.data()});
      std::size_t k = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Pose &a = pairs.poses[2 * i], &b = pairs.poses[2 * i + 1];
        if (planes[i].parts(a, b, margin)) {
          ++parted;
          EXPECT_EQ(outcomes[i].status, Status::ok);
          EXPECT_EQ(outcomes[i].answer, Answer::separated);
          continue;
        }
        ++open;
        EXPECT_EQ(outcomes[i].status, Status::unsupported);
        ASSERT_LT(k, left_count) << to_string(level) << ", pair " << i << " of " << count;
        EXPECT_EQ(left[k++], i);
        const Vec3d expected = planes[i].normal(a, b);
        const Vec3d direction(directions[i][0], directions[i][1], directions[i][2]);
        if (!planes[i].is_own() && direction.isZero(0)) continue;
        if (expected.isZero(0)) {
          EXPECT_TRUE(direction.isZero(0));
        } else {
          ++directed;
          EXPECT_NEAR((direction.normalized() - expected).norm(), 0, 1e-6);
        }
      }
      EXPECT_EQ(k, left_count);
    }
  }
  limit_isa(isa_of_machine());
  EXPECT_GT(parted, 100);
  EXPECT_GT(open, 100);
  EXPECT_GT(directed, 50);
}

Shape shape_of(Random& random, ShapeKind kind) {
  const auto size = [&] { return random.uniform(0.3, 0.6); };
  switch (kind) {
    case ShapeKind::sphere: return make_sphere(size());
    case ShapeKind::capsule: return make_capsule(0.5 * size(), size());
    case ShapeKind::box: return make_box(size(), size(), size());
    case ShapeKind::cylinder: return make_cylinder(size(), size());
    case ShapeKind::cone: return make_cone(size(), size());
    case ShapeKind::ellipsoid: return make_ellipsoid(size(), size(), size());
    default: {
      std::vector<Vec3d> vertices;
      const int count = random.below(4) == 0 ? 250 : 12;
      for (int i = 0; i < count; ++i) vertices.push_back(size() * random.direction());
      return reference::make_hull(std::move(vertices));
    }
  }
}

// Pairs of one combination of kinds, which drift towards each other and apart.
struct Scene {
  Scene(Random& random, ShapeKind a, ShapeKind b, std::uint32_t count) : kind_a(a), kind_b(b) {
    for (std::uint32_t i = 0; i < count; ++i) {
      for (const ShapeKind kind : {a, b}) {
        shapes.push_back(shape_of(random, kind));
        shape_of_body.push_back(static_cast<std::uint32_t>(shape_of_body.size()));
        poses.emplace_back();
        poses.back().rotation = random.rotation();
        poses.back().translation = random.vector(10);
      }
      const Vec3d way = random.uniform(0.4, 1.6) * random.direction();
      poses[2 * i + 1].translation = poses[2 * i].translation + way;
      velocities.push_back(random.uniform(-0.02, 0.02) * way);
      first.push_back(2 * i);
      second.push_back(2 * i + 1);
      slots.push_back(i);
    }
  }
  void step(Random& random) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      // Some rest, and some jump.
      if (i % 5 == 0) continue;
      const double reach = random.below(40) == 0 ? 1 : 0.01;
      turn(random, reach, poses[2 * i]);
      turn(random, reach, poses[2 * i + 1]);
      poses[2 * i + 1].translation += velocities[i] + random.vector(0.3 * reach);
    }
  }
  PairBatch batch() const {
    return {.kind_a = kind_a, .kind_b = kind_b, .pairs = {first, second, shape_of_body, poses}};
  }

  ShapeKind kind_a, kind_b;
  std::vector<Shape> shapes;
  std::vector<Pose> poses;
  std::vector<Vec3d> velocities;
  std::vector<std::uint32_t> shape_of_body, first, second, slots;
};

struct Contestant {
  const NarrowPhaseEntry* entry;
  Task task;
  std::unique_ptr<NarrowPhase> narrow_phase;
  std::vector<PairMemory> memory;
  bool alone;
};

TEST(WarmPlanes, BatchesAreAsRightAsTheExactAnswer) {
  constexpr std::uint32_t count = 21;
  using K = ShapeKind;
  Random random(4);
  oracle::Oracle oracle;
  int separated = 0, overlapping = 0, without_a_search = 0;
  for (const auto& [kind_a, kind_b] : {std::pair{K::box, K::box},
                                       {K::box, K::hull},
                                       {K::hull, K::hull},
                                       {K::capsule, K::cylinder},
                                       {K::cylinder, K::cone},
                                       {K::cone, K::ellipsoid},
                                       {K::sphere, K::ellipsoid},
                                       {K::ellipsoid, K::ellipsoid}}) {
    Scene scene(random, kind_a, kind_b, count);
    std::vector<Contestant> all;
    for (const char* name : {"gjk", "gjk-lanes", "ellipsoid", "smooth"}) {
      const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>(name);
      for (const Task task : {Task::intersect, Task::penetration, Task::signed_distance}) {
        if (!offers(entry, task) || !offers(entry, kind_a, kind_b, task)) continue;
        for (const bool alone : {false, true}) {
          NarrowPhaseSettings settings;
          if (task == Task::signed_distance) settings.margin = 0.05;
          all.push_back(
              {&entry, task, entry.make(settings), std::vector<PairMemory>(count), alone});
          all.back().narrow_phase->bind(scene.shapes);
        }
      }
    }
    for (int frame = 0; frame < drawn(30, 8); ++frame) {
      scene.step(random);
      std::vector<double> truth;
      for (std::uint32_t i = 0; i < count; ++i) {
        const oracle::Solid a(scene.shapes[2 * i]), b(scene.shapes[2 * i + 1]);
        truth.push_back(
            oracle.measure({a, scene.poses[2 * i]}, {b, scene.poses[2 * i + 1]}).middle());
      }
      for (Contestant& one : all) {
        PairBatch batch = scene.batch();
        batch.memory = one.memory;
        batch.memory_of = scene.slots;
        std::vector<Outcome> outcomes(count);
        if (one.alone) {
          for (std::uint32_t i = 0; i < count; ++i) {
            one.narrow_phase->solve_alone(one.task, batch, i, outcomes[i]);
          }
        } else {
          one.narrow_phase->solve(one.task, batch, outcomes);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
          const Outcome& outcome = outcomes[i];
          const std::string what = one.entry->info.name + " " + std::string(to_string(one.task)) +
                                   ", frame " + std::to_string(frame) + ", pair " +
                                   std::to_string(i);
          if (outcome.status != Status::ok || std::abs(truth[i]) < 1e-7) continue;
          EXPECT_EQ(outcome.answer, truth[i] > 0 ? Answer::separated : Answer::overlapping) << what;
          (truth[i] > 0 ? separated : overlapping) += 1;
          without_a_search += outcome.answer == Answer::separated && outcome.support_calls == 0;
          if (!asks_for_number(one.task, outcome.answer)) continue;
          if (outcome.distance == outcome.distance) {
            EXPECT_NEAR(outcome.distance, truth[i], 1e-7) << what;
          } else {
            EXPECT_GT(truth[i], 0.05 - 1e-9) << what;
          }
        }
      }
    }
  }
  EXPECT_GT(separated, 1000 / one_in);
  EXPECT_GT(overlapping, 1000 / one_in);
  EXPECT_GT(without_a_search, 500 / one_in);
}

}  // namespace
}  // namespace touchstone::warm_planes_test
