// Tests what every narrow phase answers to the task signed, beyond a margin, and into an outcome
// that is not new: on pairs of all kinds, against the exact answers.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/any_pairs.h"

namespace touchstone::signed_test {
namespace {

using namespace test;

// Calls check(entry, settings) for each algorithm and scalar that is built.
template <class Check>
void for_each_algorithm(const Check& check) {
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (!is_built(entry.info)) continue;
    for (const Precision scalar : entry.scalars) {
      SCOPED_TRACE(entry.info.name + " " + std::string(to_string(scalar)));
      check(entry, settings_of(scalar));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

Outcome ask_pair(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings, Task task,
                 const AnyPair& pair, Call call = Call::batch, const Outcome& before = {}) {
  const std::array<Shape, 2> shapes{pair.a, pair.b};
  const auto algorithm = entry.make(settings);
  algorithm->bind(shapes);
  Outcome outcome = before;
  ask_into(*algorithm, task, pair, call, outcome);
  return outcome;
}

bool is_peer(const NarrowPhaseEntry& entry) { return entry.info.origin == Origin::peer; }
double error_of(const NarrowPhaseSettings& settings) {
  return settings.scalar == Precision::float64 ? 1e-8 : 2e-4;
}

struct SignedCount {
  int asked = 0, right = 0, gave_up = 0, separated = 0, touching = 0, overlapping = 0;
};

void grade_signed(const NarrowPhaseEntry& entry, const AnyPair& pair, const Outcome& outcome,
                  double error, SignedCount& count) {
  const oracle::Measure& truth = pair.truth;
  const double size = pair.size();
  ++count.asked;
  const bool near = std::abs(outcome.distance - truth.middle()) <= 1e-2 * size;
  count.right += (outcome.distance > 0) == (truth.middle() > 0) && near ? 1 : 0;
  count.gave_up += outcome.status != Status::ok && outcome.status != Status::not_reported ? 1 : 0;
  count.separated += outcome.answer == Answer::separated ? 1 : 0;
  count.touching += outcome.answer == Answer::touching ? 1 : 0;
  count.overlapping += outcome.answer == Answer::overlapping ? 1 : 0;
  if (is_peer(entry) || outcome.status != Status::ok) return;
  if (outcome.answer == Answer::touching) {
    ASSERT_LE(std::abs(truth.middle()), error * size);
  } else if (std::abs(truth.middle()) > error * 1e-2 * size) {
    ASSERT_EQ(outcome.answer, truth.middle() > 0 ? Answer::separated : Answer::overlapping);
  }
  ASSERT_NEAR(outcome.distance, truth.middle(), error * size);
  ASSERT_LE(outcome.lower, truth.upper + error * 1e-2 * size);
  ASSERT_GE(outcome.upper, truth.lower - error * 1e-2 * size);
  if (outcome.answer == Answer::touching) return;
  ASSERT_NEAR(outcome.normal.norm(), 1, 1e-5);
  const oracle::Solid a(pair.a), b(pair.b);
  // At contact the direction is lost in rounding.
  if (pair.b.kind != ShapeKind::halfspace && std::abs(truth.middle()) > error * size) {
    // Moved along the normal by the depth, or back by the distance, the bodies touch.
    const oracle::Enclosure along =
        oracle::separation_along({a, pair.pose_a}, {b, pair.pose_b}, outcome.normal);
    ASSERT_NEAR(along.upper, -truth.middle(), std::sqrt(error) * size);
  }
  const double between =
      outcome.normal.dot(outcome.witness_b - outcome.witness_a) - outcome.distance;
  ASSERT_NEAR(between, 0, 2 * error * size);
}

TEST(Signed, IsTheDistanceWhereApartAndTheDepthWhereNot) {
  int offered = 0;
  for_each_algorithm([&](const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings) {
    if (!offers(entry, Task::signed_distance)) return;
    ++offered;
    SignedCount count;
    for (const AnyPair& pair : any_pairs()) {
      if (!offers(entry, pair.a.kind, pair.b.kind, Task::signed_distance)) continue;
      if (!pair.is_bounded()) continue;
      for (const Call call : {Call::batch, Call::alone}) {
        SCOPED_TRACE(pair.name + (call == Call::alone ? " alone" : ""));
        const Outcome outcome = ask_pair(entry, settings, Task::signed_distance, pair, call);
        grade_signed(entry, pair, outcome, error_of(settings), count);
        if (testing::Test::HasFatalFailure()) return;
      }
    }
    EXPECT_GT(count.separated, count.asked / 5);
    EXPECT_GT(count.overlapping, count.asked / 5);
    if (is_peer(entry)) {
      EXPECT_GT(count.right, count.asked / 2);
    } else {
      EXPECT_LE(count.gave_up, count.asked / 3 + 4);  // where rounding hides the side
    }
    std::printf("%s: %d asked, %d right to a hundredth, %d touch, %d gave up\n",
                entry.info.name.c_str(), count.asked, count.right, count.touching, count.gave_up);
  });
  EXPECT_GE(offered, 12);
}

// Whether the numbers that only_given takes are those of the other outcome, bit for bit.
void expect_the_same(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.answer, b.answer);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.support_calls, b.support_calls);
  const auto same = [](double x, double y) { return (std::isnan(x) && std::isnan(y)) || x == y; };
  EXPECT_TRUE(same(a.distance, b.distance)) << a.distance << " " << b.distance;
  EXPECT_TRUE(same(a.lower, b.lower)) << a.lower << " " << b.lower;
  EXPECT_TRUE(same(a.upper, b.upper)) << a.upper << " " << b.upper;
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(same(a.normal[k], b.normal[k])) << a.normal[k] << " " << b.normal[k];
    EXPECT_TRUE(same(a.witness_a[k], b.witness_a[k])) << a.witness_a[k] << " " << b.witness_a[k];
    EXPECT_TRUE(same(a.witness_b[k], b.witness_b[k])) << a.witness_b[k] << " " << b.witness_b[k];
  }
}

// Whether no number that is given is that of the outcome before.
void expect_nothing_of(const Outcome& before, const Outcome& outcome) {
  EXPECT_NE(outcome.distance, before.distance);
  EXPECT_NE(outcome.lower, before.lower);
  EXPECT_NE(outcome.upper, before.upper);
  EXPECT_NE(outcome.iterations, before.iterations);
  EXPECT_NE(outcome.support_calls, before.support_calls);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NE(outcome.normal[k], before.normal[k]);
    EXPECT_NE(outcome.witness_a[k], before.witness_a[k]);
    EXPECT_NE(outcome.witness_b[k], before.witness_b[k]);
  }
}

TEST(Leftovers, NothingOfAnEarlierCallIsGiven) {
  Outcome junk;
  junk.answer = Answer::touching;
  junk.status = Status::capacity;
  junk.distance = 17;
  junk.lower = -18;
  junk.upper = 19;
  junk.normal = junk.witness_a = junk.witness_b = Vec3d(20, 21, 22);
  junk.iterations = 1'000'023;
  junk.support_calls = 1'000'024;
  for_each_algorithm([&](const NarrowPhaseEntry& entry, NarrowPhaseSettings settings) {
    for (const AnyPair& pair : any_pairs()) {
      for (const Task task : all_tasks) {
        if (!offers(entry, pair.a.kind, pair.b.kind, task)) continue;
        for (const Call call : {Call::batch, Call::alone}) {
          for (const std::optional<int> cap : {std::optional<int>(), std::optional(2)}) {
            if (cap && is_peer(entry)) continue;
            SCOPED_TRACE(pair.name + " " + std::string(to_string(task)) +
                         (call == Call::alone ? " alone" : "") + (cap ? " of two steps" : ""));
            settings.max_iterations = cap;
            const Outcome after =
                only_given(task, ask_pair(entry, settings, task, pair, call, junk));
            expect_nothing_of(junk, after);
            // A library may answer differently where its memory lies differently.
            if (!is_peer(entry)) {
              expect_the_same(only_given(task, ask_pair(entry, settings, task, pair, call)), after);
            }
            if (testing::Test::HasFailure()) return;
          }
        }
      }
    }
  });
}

void expect_within_margin(const NarrowPhaseEntry& entry, const AnyPair& pair, Task task,
                          double margin, double error, const Outcome& outcome,
                          const Outcome& without) {
  const double truth = pair.truth.middle();
  const bool is_beyond = outcome.answer == Answer::separated && std::isnan(outcome.distance);
  if (!asks_distance(task) && !is_peer(entry)) {
    expect_the_same(only_given(task, outcome), only_given(task, without));
  } else if (is_beyond) {
    EXPECT_TRUE(outcome.normal.hasNaN() && outcome.witness_a.hasNaN() &&
                outcome.witness_b.hasNaN() && std::isnan(outcome.upper));
    EXPECT_TRUE(is_peer(entry) || truth > margin) << truth;
    if (!is_peer(entry)) {
      EXPECT_EQ(outcome.status, Status::ok);
      EXPECT_GE(outcome.lower, margin);
      EXPECT_LE(outcome.lower, pair.truth.upper + error * 1e-2 * pair.size());
    }
  } else {
    EXPECT_TRUE(is_peer(entry) || without.status != Status::ok ||
                truth <= margin + error * pair.size());
    EXPECT_EQ(outcome.answer, without.answer);
    EXPECT_EQ(outcome.status, without.status);
    if (is_peer(entry)) return;
    EXPECT_EQ(std::isnan(outcome.distance), std::isnan(without.distance));
    if (without.status == Status::ok && !std::isnan(without.distance)) {
      EXPECT_NEAR(outcome.distance, without.distance, error * pair.size());
    }
  }
}

TEST(Margin, BeyondItNothingIsGivenButThat) {
  for_each_algorithm([&](const NarrowPhaseEntry& entry, NarrowPhaseSettings settings) {
    const double error = error_of(settings);
    int beyond = 0, within = 0;
    for (const AnyPair& pair : any_pairs()) {
      if (!pair.is_bounded()) continue;
      for (const Task task : all_tasks) {
        if (!offers(entry, pair.a.kind, pair.b.kind, task)) continue;
        for (const Call call : {Call::batch, Call::alone}) {
          settings.margin = {};
          const Outcome without = ask_pair(entry, settings, task, pair, call);
          for (const double margin : {0.0, 0.1, 100.0}) {
            SCOPED_TRACE(pair.name + " " + std::string(to_string(task)) + " beyond " +
                         std::to_string(margin) + (call == Call::alone ? " alone" : ""));
            settings.margin = margin;
            const Outcome outcome = ask_pair(entry, settings, task, pair, call);
            expect_within_margin(entry, pair, task, margin, error, outcome, without);
            if (testing::Test::HasFailure()) return;
            if (!asks_distance(task) || outcome.answer != Answer::separated) continue;
            ++(std::isnan(outcome.distance) ? beyond : within);
          }
        }
      }
    }
    if (!offers(entry, Task::distance) && !offers(entry, Task::signed_distance)) return;
    EXPECT_GT(beyond, 60 / one_in);
    EXPECT_GT(within, 60 / one_in);
  });
}

// An algorithm that does not say what a tolerance limits has none, and one that does has one.
TEST(Tolerance, IsWhatTheEntrySays) {
  for_each_algorithm([&](const NarrowPhaseEntry& entry, NarrowPhaseSettings settings) {
    bool differs = false;
    for (const AnyPair& pair : any_pairs()) {
      for (const Task task : {Task::distance, Task::penetration}) {
        if (differs || !offers(entry, pair.a.kind, pair.b.kind, task)) continue;
        settings.tolerance = {};
        const Outcome usual = ask_pair(entry, settings, task, pair);
        settings.tolerance = 0.05;
        const Outcome coarse = ask_pair(entry, settings, task, pair);
        const auto same = [](double x, double y) { return x == y || std::isnan(x + y); };
        differs = usual.answer != coarse.answer || !same(usual.distance, coarse.distance) ||
                  !same(usual.lower, coarse.lower) || !same(usual.upper, coarse.upper);
      }
    }
    EXPECT_EQ(differs, !entry.tolerance.empty()) << entry.tolerance;
  });
}

}  // namespace
}  // namespace touchstone::signed_test
