// Algorithms and regimes for tests of checks.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/check/family_checker.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/pair/axes/axes.h"
#include "harness/kinds/pair/pair_checkers.h"
#include "tests/harness/check/pairs.h"

namespace touchstone {

// The faults of a planted algorithm.
enum class Harm : int {
  none,
  wrong_side,
  touches_elsewhere,
  wrong_depth,
  bad_bounds,
  gives_up,
  crashes,
  hangs,
  nan,
  no_points
};

// Answers for balls by the formula, and applies the harm to pairs whose second ball is to the right
// of the first.
class Planted final : public NarrowPhase {
 public:
  explicit Planted(Harm harm, int microseconds) : harm_(harm), microseconds_(microseconds) {}
  void bind(std::span<const Shape> shapes) override { shapes_ = shapes; }
  void solve(Task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const Pose& a = batch.pairs.poses[batch.pairs.first[i]];
      const Pose& b = batch.pairs.poses[batch.pairs.second[i]];
      const Vec3d between = b.translation - a.translation;
      const double radius_a = shapes_[batch.pairs.shape_of[batch.pairs.first[i]]].radius;
      const double radius_b = shapes_[batch.pairs.shape_of[batch.pairs.second[i]]].radius;
      Outcome& out = outcomes[i];
      out.distance = between.norm() - radius_a - radius_b;
      out.answer = out.distance > 0 ? Answer::separated : Answer::overlapping;
      out.status = Status::ok;
      out.normal = between.normalized();
      out.witness_a = a.translation + radius_a * out.normal;
      out.witness_b = b.translation - radius_b * out.normal;
      if (between.x() > 0) do_harm(out);
      if (microseconds_ > 0) usleep(static_cast<useconds_t>(microseconds_));
    }
  }

 private:
  void do_harm(Outcome& out) const {
    switch (harm_) {
      case Harm::none: break;
      case Harm::wrong_side:
        out.answer = out.distance > 0 ? Answer::overlapping : Answer::separated;
        break;
      case Harm::touches_elsewhere:
        out.answer = Answer::touching;
        out.lower = -1e-15;
        out.upper = 1e-15;
        break;
      case Harm::wrong_depth: out.distance *= 1.5; break;
      case Harm::bad_bounds: out.lower = out.distance + 0.1; break;
      case Harm::gives_up: out.status = Status::not_converged; break;
      case Harm::crashes: std::abort();
      case Harm::hangs: usleep(60'000'000); break;
      case Harm::nan: out.normal.x() = Outcome::none; break;
      case Harm::no_points: out.witness_b.setConstant(Outcome::none); break;
    }
  }

  Harm harm_;
  int microseconds_;
  std::span<const Shape> shapes_;
};

template <Harm harm, int microseconds = 0>
NarrowPhaseEntry planted(const std::string& name, Origin origin) {
  return {.info = {.name = name, .citation = "a test", .origin = origin},
          .tasks = {Task::intersect, Task::distance, Task::penetration},
          .scalars = {Precision::float64},
          .supports = [](ShapeKind a, ShapeKind b,
                         Task) { return a == ShapeKind::sphere && b == ShapeKind::sphere; },
          .make = [](const NarrowPhaseSettings&) -> std::unique_ptr<NarrowPhase> {
            return std::make_unique<Planted>(harm, microseconds);
          }};
}

// Draws balls of radius 1, alternately apart and overlapping, on both sides of each other.
inline kinds::Regime balls_regime(const std::string& name = "balls",
                                  const std::string& group = "test") {
  return {.name = name, .group = group, .what = "two balls", .draw = [](kinds::RegimeDraw& draw) {
            const double gap = draw.index % 2 == 0 ? 0.5 : -0.5;
            const double side = draw.index / 2 % 2 == 0 ? 1 : -1;
            kinds::RegimeCase c{along_x(ball(1), ball(1), side * (2 + gap)), "ball"};
            c.pair.pose_b.translation.y() = draw.random.uniform(-0.25, 0.25);
            return c;
          }};
}

// Draws balls of radius 1, alternately apart and overlapping. From the value 2 on the second ball
// is on the right in half of the slots, where the planted algorithms do harm; otherwise it is on
// the left.
inline kinds::RegimeCase draw_balls(kinds::RegimeDraw& draw) {
  const std::uint64_t slot = kinds::slot_of(draw.index);
  const double gap = slot % 2 == 0 ? 0.5 : -0.5;
  const double side = draw.regime.parameter >= 2 && slot / 2 % 2 == 0 ? 1 : -1;
  kinds::RegimeCase c{along_x(ball(1), ball(1), side * (2 + gap)), "ball"};
  c.pair.pose_b.translation.y() = draw.random.uniform(-0.25, 0.25);
  return c;
}

// Asks these narrow phases, in those of the request's scalars that they offer.
inline void ask(check::CheckRequest& request, const std::vector<const NarrowPhaseEntry*>& narrow) {
  request.contestants.clear();
  for (const NarrowPhaseEntry* entry : narrow) {
    for (const Precision scalar : request.scalars) {
      if (!offers(*entry, scalar)) continue;
      request.contestants.push_back(kinds::contestant_of(
          kinds::pair_kind(), *entry, scalar == Precision::float64, scalar, kinds::every_task));
    }
  }
}

// Asks about the cases of this regime too.
inline void draw(check::CheckRequest& request, const kinds::Regime& regime) {
  static std::deque<kinds::Family> families;
  request.families.push_back(&families.emplace_back(kinds::family_of(regime)));
}

inline kinds::Axis balls_axis(int values) {
  kinds::Axis axis;
  axis.name = axis.what = "balls";
  axis.unit = "steps";
  axis.draw = draw_balls;
  for (int i = 1; i <= values; ++i) axis.values.push_back({std::to_string(i), 1.0 * i});
  return axis;
}

}  // namespace touchstone
