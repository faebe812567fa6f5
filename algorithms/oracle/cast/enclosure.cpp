// Part of the oracle: conservative advancement with the exact distance of bodies whose poses are rounded.
//
// At a time, the poses are computed in long double and rounded to double. The oracle's exact answer is
// for those: the true bodies are within `doubt` of them, so that their distance is within 2 `doubt`.
// No point of a body comes nearer to the other along a direction n than at the speed
// -n . v + |n x w_a| rho_a + |n x w_b| rho_b.
#include "algorithms/oracle/cast/enclosure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/core/bounds.h"
#include "algorithms/oracle/answer.h"

namespace touchstone::oracle {
namespace {

using Wide = long double;
using Wide3 = Eigen::Matrix<Wide, 3, 1>;
using WideMatrix = Eigen::Matrix<Wide, 3, 3>;

Wide3 wide(const Vec3d& v) { return v.cast<Wide>(); }

Mat3d rotation_at(const EnclosedBody& body, double time) {
  const Wide3 turn = time * wide(body.motion->rotation_vector);
  const Wide angle = turn.norm();
  if (!(angle > 0)) return body.pose->rotation;
  const Wide3 axis = turn / angle;
  const Wide half = std::sin(angle / 2);
  WideMatrix across;
  across << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const WideMatrix whole = WideMatrix::Identity() + std::sin(angle) * across +
                           2 * half * half * (across * across).eval();
  return (whole * body.pose->rotation.cast<Wide>()).cast<double>();
}

class RoundedPair {
 public:
  RoundedPair(Oracle& oracle, const EnclosedBody& a, const EnclosedBody& b)
      : oracle_(oracle),
        a_(a),
        b_(b),
        offset_(wide(b.pose->translation) - wide(a.pose->translation)),
        velocity_(wide(b.motion->displacement) - wide(a.motion->displacement)) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    // Each entry of a rotation is off by half of epsilon and by what long double leaves of the angle.
    const auto turned = [](const EnclosedBody& body) {
      if (!body.motion->turns()) return 0.0;
      return (4 * epsilon + 1e-17 * body.motion->rotation_vector.norm()) * body.reach;
    };
    doubt_ = 2 * epsilon * static_cast<double>(offset_.norm() + velocity_.norm()) + turned(a_) +
             turned(b_);
  }

  // Bounds on the signed distance at a time, and on the gap along a unit vector from a to b.
  struct Bounds {
    double lower, upper;
    double gap = 0;
    Vec3d normal = Vec3d::Zero();
  };
  Bounds at(double time) {
    const Pose pose_a = rounded_pose(a_, a_, time), pose_b = rounded_pose(b_, a_, time);
    const Body body_a(*a_.solid, pose_a), body_b(*b_.solid, pose_b);
    const Measure measure = oracle_.measure(body_a, body_b);
    Bounds bounds{measure.lower - 2 * doubt_, measure.upper + 2 * doubt_};
    const double length = measure.normal.norm();
    if (!(length > 0)) return bounds;
    bounds.normal = measure.normal / length;
    // A half-space has a gap along its own normal alone, which may be no vector of doubles.
    const bool of_plane = b_.solid->core == Solid::Core::halfspace;
    bounds.gap = of_plane ? bounds.lower
                          : -separation_along(body_a, body_b, bounds.normal).upper - 2 * doubt_;
    return bounds;
  }

  // An upper bound on the speed at which they close along a unit vector from a to b.
  double speed(const Vec3d& normal) const {
    const auto turning = [&](const EnclosedBody& body) {
      return normal.cross(body.motion->rotation_vector).norm() * body.reach;
    };
    const Vec3d velocity = velocity_.cast<double>();
    return turning(a_) + turning(b_) - normal.dot(velocity) + 1e-12 * fastest();
  }
  // The same along any direction.
  double fastest() const {
    const auto turning = [](const EnclosedBody& body) {
      return body.motion->rotation_vector.norm() * body.reach;
    };
    return (static_cast<double>(velocity_.norm()) + turning(a_) + turning(b_)) * (1 + 1e-12);
  }

  double doubt() const { return doubt_; }

 private:
  Oracle& oracle_;
  EnclosedBody a_, b_;
  Wide3 offset_, velocity_;
  double doubt_ = 0;
};

}  // namespace

EnclosedBody enclosed(const Shape& shape, const Solid& solid, const Pose& pose,
                      const Motion& motion) {
  const double reach = loose_reach(shape, pose.rotation);
  // A half-space does not turn, and has no reach.
  return {&solid, &pose, &motion, std::isfinite(reach) ? reach : 0};
}

Pose rounded_pose(const EnclosedBody& body, const EnclosedBody& from, double time) {
  const Wide3 offset = wide(body.pose->translation) - wide(from.pose->translation);
  const Wide3 velocity = wide(body.motion->displacement) - wide(from.motion->displacement);
  return {rotation_at(body, time), (offset + time * velocity).cast<double>()};
}

namespace {

// Writes where the bodies touch at the time of the hit, and the normal there if it is not known yet. Those that are
// deeper in each other than the tolerance at the start touch nowhere: their deepest points need not be in both.
void write_touch(Oracle& oracle, const EnclosedBody& a, const EnclosedBody& b, double tolerance,
                 CastOutcome& outcome) {
  const Pose pose_a = rounded_pose(a, a, outcome.toi), pose_b = rounded_pose(b, a, outcome.toi);
  Outcome touch;
  answer(oracle, {*a.solid, pose_a}, {*b.solid, pose_b}, Task::signed_distance, touch);
  if (!(touch.distance < -tolerance)) {
    outcome.point = touch.witness_a + a.pose->translation + outcome.toi * a.motion->displacement;
  }
  const double length = touch.normal.norm();
  if (outcome.normal.hasNaN() && length > 0) outcome.normal = touch.normal / length;
}

}  // namespace

void enclose(Oracle& oracle, const EnclosedBody& a, const EnclosedBody& b,
             const EnclosureGoal& goal, CastOutcome& outcome, std::vector<PartedUntil>* planes) {
  const double tolerance = goal.tolerance;
  RoundedPair bodies(oracle, a, b);
  const auto overlap = [&](double time) {
    ++outcome.iterations;
    return bodies.at(time).upper < 0;
  };
  outcome.status = Status::ok;
  outcome.iterations = 0;
  // The poses at the start are given, and not rounded.
  const Answer start = oracle.verdict({*a.solid, *a.pose}, {*b.solid, *b.pose});
  if (start == Answer::overlapping || start == Answer::touching) {
    outcome.answer = CastAnswer::hit;
    outcome.toi = outcome.lower = outcome.upper = 0;
    write_touch(oracle, a, b, tolerance, outcome);
    return;
  }
  double time = 0, tried = std::numeric_limits<double>::infinity();
  for (int k = 0; k < goal.most_steps; ++k) {
    ++outcome.iterations;
    const RoundedPair::Bounds bounds = bodies.at(time);
    outcome.lower = time;
    const double speed = bodies.speed(bounds.normal);
    if (bounds.gap > 0 && bounds.gap > (1 - time) * speed) {
      outcome.answer = CastAnswer::miss;
      outcome.lower = CastOutcome::none;
      if (planes != nullptr) planes->push_back({bounds.normal, 1});
      return;
    }
    // Near contact, a proof of it a little later ends the search. It is tried again each time that the
    // distance has fallen by much.
    const bool near = bounds.lower < tolerance && bounds.lower < 0.1 * tried;
    double step = std::max(tolerance, 4 * bodies.doubt()) / std::max(bodies.fastest(), 1e-300);
    for (int n = 0; near && n < 16; ++n, step *= 4) {
      const double later = std::min(time + step, 1.0);
      if (overlap(later)) {
        outcome.answer = CastAnswer::hit;
        outcome.toi = time;
        outcome.upper = later;
        if (!bounds.normal.isZero(0)) outcome.normal = bounds.normal;
        write_touch(oracle, a, b, tolerance, outcome);
        return;
      }
      if (!(later < 1)) break;
    }
    if (near) tried = bounds.lower;
    const double next = time + bounds.gap / speed * (1 - 1e-12);
    if (!(bounds.gap > 0) || !(next > time)) break;
    time = std::min(next, 1.0);
    if (planes != nullptr) planes->push_back({bounds.normal, time});
  }
  outcome.status = Status::not_converged;
}

}  // namespace touchstone::oracle
