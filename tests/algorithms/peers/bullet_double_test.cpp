// Bullet's two builds beside each other in one process.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "harness/base/random.h"
#include "harness/grade/true_case.h"
#include "harness/process/limited_query.h"

namespace touchstone {
namespace {

constexpr std::array names = {"bullet-gjk-epa", "bullet-box-box", "bullet-sat", "bullet-mpr"};

Shape some_box(base::Random& random) {
  Shape shape;
  shape.kind = ShapeKind::box;
  for (double& half : shape.half_extents) half = random.uniform(0.3, 1);
  return shape;
}
Shape some_sphere(base::Random& random) {
  Shape shape;
  shape.radius = random.uniform(0.3, 1);
  return shape;
}
Shape some_hull(base::Random& random) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 16; ++i) points.push_back(random.on_sphere() + Vec3d(0.3, 0.1, 0.2));
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = make_hull(std::move(points));
  return shape;
}

// Pairs of bodies of about unit size, about half of which overlap.
struct Pairs {
  static constexpr std::size_t count = 300;

  std::vector<Shape> shapes;
  std::vector<Pose> poses;
  std::vector<std::uint32_t> first, second, shape_of;

  explicit Pairs(Shape (*shape_a)(base::Random&), Shape (*shape_b)(base::Random&)) {
    base::Random random(3);
    for (std::uint32_t i = 0; i < count; ++i) {
      shapes.push_back(shape_a(random));
      shapes.push_back(shape_b(random));
      const Vec3d at = 10 * random.in_ball();
      poses.push_back({random.rotation(), at});
      poses.push_back({random.rotation(), at + random.uniform(0.7, 3) * random.on_sphere()});
      first.push_back(2 * i);
      second.push_back(2 * i + 1);
    }
    for (std::uint32_t i = 0; i < 2 * count; ++i) shape_of.push_back(i);
  }

  PairBatch batch() const {
    return {shapes[0].kind, shapes[1].kind, {first, second, shape_of, poses}};
  }
  std::unique_ptr<NarrowPhase> make(const NarrowPhaseEntry& entry, Precision scalar) const {
    std::unique_ptr<NarrowPhase> algorithm = entry.make({.scalar = scalar});
    algorithm->bind(shapes);
    return algorithm;
  }
  std::vector<Outcome> ask(const NarrowPhaseEntry& entry, Precision scalar, Task task) const {
    std::vector<Outcome> outcomes(count);
    make(entry, scalar)->solve(task, batch(), outcomes);
    return outcomes;
  }
  files::Case as_case(std::size_t i) const {
    return {"", shapes[2 * i], shapes[2 * i + 1], poses[2 * i], poses[2 * i + 1]};
  }
};

// NaN is itself.
bool same(double x, double y) {
  return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
}
bool same(const Vec3d& x, const Vec3d& y) {
  return same(x.x(), y.x()) && same(x.y(), y.y()) && same(x.z(), y.z());
}
bool same(const Outcome& x, const Outcome& y) {
  return x.answer == y.answer && x.status == y.status && same(x.distance, y.distance) &&
         same(x.normal, y.normal) && same(x.witness_a, y.witness_a) &&
         same(x.witness_b, y.witness_b) && x.iterations == y.iterations &&
         x.support_calls == y.support_calls;
}
std::size_t differing(std::span<const Outcome> some, std::span<const Outcome> others) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < some.size(); ++i) count += !same(some[i], others[i]);
  return count;
}

class BulletDouble : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : names) {
      const NarrowPhaseEntry* const entry = registry::find<NarrowPhaseEntry>(name);
      ASSERT_NE(entry, nullptr) << name;
      if (!is_built(entry->info)) GTEST_SKIP() << entry->info.reason;
      if (!offers(*entry, Precision::float64)) GTEST_SKIP() << entry->info.lacking;
      entries_.push_back(entry);
    }
  }
  std::vector<const NarrowPhaseEntry*> entries_;
};

// The same bits as in a process that uses the one build alone, whichever was there first, and with
// their queries in turns.
TEST_F(BulletDouble, NeitherBuildDisturbsTheOther) {
  for (const NarrowPhaseEntry* entry : entries_) {
    const Pairs pairs(some_box, some_box);
    for (const Task task : entry->tasks) {
      SCOPED_TRACE(entry->info.name + " " + std::string(to_string(task)));
      std::array<std::vector<Outcome>, 2> alone;
      for (const Precision scalar : {Precision::float32, Precision::float64}) {
        auto& outcomes = alone[scalar == Precision::float64];
        outcomes.resize(Pairs::count);
        process::solve_guarded([&] { return pairs.make(*entry, scalar); }, task, pairs.batch(),
                               outcomes, 60, std::size_t{4} << 30);
      }
      if (task != Task::intersect) {
        EXPECT_GT(differing(alone[0], alone[1]), Pairs::count / 4);
      }
      const auto single = pairs.make(*entry, Precision::float32);
      const auto twice = pairs.make(*entry, Precision::float64);
      std::array<std::vector<Outcome>, 2> mixed;
      for (auto& outcomes : mixed) outcomes.resize(Pairs::count);
      for (std::size_t i = 0; i < Pairs::count; ++i) {
        PairBatch one = pairs.batch();
        one.pairs.first = one.pairs.first.subspan(i, 1);
        one.pairs.second = one.pairs.second.subspan(i, 1);
        single->solve(task, one, std::span(mixed[0]).subspan(i, 1));
        twice->solve(task, one, std::span(mixed[1]).subspan(i, 1));
      }
      EXPECT_EQ(differing(alone[0], mixed[0]), 0u);
      EXPECT_EQ(differing(alone[1], mixed[1]), 0u);
    }
  }
}

// GJK's distances are exact to the precision of their scalar, against what Bullet was given.
TEST_F(BulletDouble, DistancesAreDoubles) {
  const NarrowPhaseEntry& entry = *entries_.front();
  oracle::Oracle oracle;
  for (const Pairs& pairs :
       {Pairs(some_box, some_box), Pairs(some_sphere, some_box), Pairs(some_hull, some_hull)}) {
    const auto in_float = pairs.ask(entry, Precision::float32, Task::distance);
    const auto in_double = pairs.ask(entry, Precision::float64, Task::distance);
    int apart = 0, coarse = 0;
    for (std::size_t i = 0; i < Pairs::count; ++i) {
      const files::Case c = pairs.as_case(i);
      const Encoding encoding =
          encoding_of(entry, c.shape_a.kind, c.shape_b.kind, Task::distance, Precision::float64);
      const grade::EncodedPair given(c, encoding);
      const double truth = oracle.measure(given.a(), given.b()).middle();
      if (truth < 1e-3) continue;
      ++apart;
      EXPECT_EQ(in_double[i].answer, Answer::separated);
      EXPECT_NEAR(in_double[i].distance, truth, 1e-12);
      coarse += std::abs(in_float[i].distance - truth) > 1e-9;
    }
    EXPECT_GT(apart, 50);
    EXPECT_LT(apart, 250);
    EXPECT_GT(coarse, apart * 9 / 10);
  }
}

}  // namespace
}  // namespace touchstone
