// GJK at one time of an advancement, and the outcome of a hit.
#include "algorithms/kernels/motion/advancement/advancement.h"

#include <algorithm>
#include <cmath>

#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/kernels/gjk/separation_along.h"
#include "algorithms/kernels/motion/advancement/box_planes.h"
#include "algorithms/kernels/motion/advancement/contact_by.h"
#include "algorithms/kernels/motion/advancement/round_cores.h"
#include "algorithms/kernels/motion/advancement/round_planes.h"
#include "algorithms/kernels/motion/advancement/turning_normal.h"
#include "algorithms/kernels/motion/keep_to_tolerance.h"

namespace touchstone {

AdvancementSearch::AdvancementSearch(const RelativeMotion& motion, const AdvancementGoal& goal)
    : motion_(motion),
      pair_motion_{motion.displacement(), motion.a().motion->rotation_vector,
                   motion.b().motion->rotation_vector},
      asked_tolerance_(goal.tolerance),
      lasting_planes_(goal.lasting_planes) {
  const auto size = [](const MovingBody& body, double reach) {
    return std::max(reach, body.shape->size) + body.shape->radius;
  };
  const double larger =
      std::max(size(motion.a(), motion.reach_a()), size(motion.b(), motion.reach_b()));
  // The unit of a pair in contact is below four times its size.
  hidden_ = 16 * (4 * RelativeMotion::pair_rounding * larger + motion.placement_rounding());
  tolerance_ = std::max(goal.tolerance.value_or(1e-9 * larger), hidden_);
}

FreeUntil apart_by_balls(const MotionBounds& motion) {
  const Vec3d start = motion.offset(0);
  const Vec3d& velocity = motion.displacement();
  const double square = velocity.squaredNorm(), away = start.norm();
  const double reach =
      motion.reach_a() + motion.reach_b() + motion.a().shape->radius + motion.b().shape->radius;
  // The placement's rounding is that of the offset; products and lengths add as much.
  const double needed = reach * (1 + 1e-12) + 4 * motion.placement_rounding();
  if (!(away > needed)) return {0, false};
  const double nearest = nearest_time(start, velocity);
  const auto direction_at = [&](double time) { return motion.offset(time).normalized(); };
  const Vec3d across = direction_at(nearest);
  const double gap = across.dot(start), change = across.dot(velocity);
  if (std::min(gap, gap + change) > needed) return {1, true};
  // The balls meet where |start + t velocity| is their reach. The plane there, or the first one, has a
  // gap that is linear in time.
  const double closing = -start.dot(velocity);
  const double discriminant = closing * closing - square * (away - needed) * (away + needed);
  const double meet = discriminant > 0 && closing > 0
                          ? (away - needed) * (away + needed) / (closing + std::sqrt(discriminant))
                          : nearest;
  double free = 0;
  for (const double time : {std::min(meet, 1.0), 0.0}) {
    const Vec3d n = direction_at(time);
    const double open = n.dot(start) - needed, speed = -n.dot(velocity);
    if (open > 0 && speed > 0) free = std::max(free, open / speed);
  }
  return {std::min(free, 1.0), false};
}

Advancement AdvancementSearch::look(SupportPair<double>& pair, double time, CastOutcome& outcome) {
  if (!(pair.unit() < 0x1p959)) return {};
  if (!is_round(pair)) return look_by_gjk(pair, time, outcome.iterations);
  ++outcome.iterations;
  const ClosestOfRound closest = closest_of_round(pair);
  const double distance = closest.between.norm();
  Vec3d normal = distance > 0 ? Vec3d(closest.between / distance) : Vec3d(Vec3d::Zero());
  if (pair.unit() * (distance - pair.radius()) <= tolerance_) {
    return hit(pair, {time, closest.on_a, closest.on_b}, normal);
  }
  if (lasting_planes_) {
    // The motion is foreseen for a radian at most.
    const double foreseen = std::min(1 - time, 1 / std::max(motion_.angle_a(), motion_.angle_b()));
    normal = lasting_normal(pair, pair_motion_, closest, foreseen, 0.5 * tolerance_ / pair.unit());
  }
  return apart(pair, time, normal, -normal.dot(pair.support(normal).difference));
}

Advancement AdvancementSearch::look_by_gjk(SupportPair<double>& pair, double time,
                                           int& iterations) {
  constexpr int most_iterations = 128;
  // Far from contact a rough plane serves as well. GJK on polytopes ends after a few steps whatever is asked.
  constexpr double share = 0.1;
  const double unit = pair.unit();
  if (lasting_planes_ && are_boxes(pair)) {
    ++iterations;
    if (const auto found = look_at_pair_of_boxes(pair, time)) return *found;
  }
  double open = 0;
  if (!pair.is_polytope()) {
    const Vec3d along = normal_.isZero(0) ? Vec3d(pair.centre_b().stableNormalized()) : normal_;
    open = separation_along(pair, along) - pair.radius();
  }
  const GjkDistanceGoal<double> goal{
      .task = Task::distance,
      .tolerance =
          std::max({0.25 * tolerance_ / unit, SupportPair<double>::rounding, share * open}),
      .most_iterations = most_iterations};
  const LastFrame<double> last{kept_, normal_};
  const GjkDistanceResult<double> found = gjk_distance(pair, goal, &last);
  kept_.keep(found.simplex);
  iterations += found.iterations;
  const bool inside = found.end == GjkDistanceResult<double>::End::contact;
  // A simplex nearer than the radii ends the search early, without the plane.
  const double upper = inside ? 0.0 : unit * (found.upper - pair.radius());
  if (!inside && upper > tolerance_) {
    Advancement result = apart(pair, time, found.direction, found.lower);
    if (lasting_planes_ && pair.is_polytope()) {
      let_turn(result.plane, turning_of_normal(found.simplex, found.direction,
                                               motion_.a().motion->rotation_vector,
                                               motion_.b().motion->rotation_vector));
    }
    return result;
  }
  Simplex<double> simplex = found.simplex;
  NearestPoint<double> nearest = found.nearest;
  if (simplex.size == 4) {
    simplex.size = 3;
    nearest = reduce_to_nearest(simplex);
  }
  const DifferencePoint<double> mean =
      found.nearest.inside ? mean_at_origin(found.simplex) : weighted_mean(simplex);
  return hit(pair, {time, mean.a, mean.b - pair.centre_b()},
             found.nearest.inside ? Vec3d(Vec3d::Zero()) : Vec3d(-nearest.direction));
}

std::optional<Advancement> AdvancementSearch::look_at_pair_of_boxes(SupportPair<double>& pair,
                                                                    double time) {
  const BoxLook found = look_at_boxes(pair, pair_motion_, tolerance_ / pair.unit());
  if (found.state == BoxLook::State::open) {
    Advancement result = apart(pair, time, found.normal, separation_along(pair, found.normal));
    let_turn(result.plane, found.turning);
    // It is less than the look's where a rotation is not quite one. A step needs more than rounding.
    if (result.plane.gap > 0.5 * tolerance_) return result;
  }
  if (found.state == BoxLook::State::near) {
    const double distance = (pair.centre_b() + found.on_b - found.on_a).norm();
    if (pair.unit() * distance <= tolerance_) {
      return hit(pair, {time, found.on_a, found.on_b}, found.normal);
    }
  }
  return {};
}

Advancement AdvancementSearch::hit(const SupportPair<double>& pair, const NearestPoints& found,
                                   const Vec3d& normal) {
  const double time = found.time;
  // No plane may have been looked at before, where balls around the bodies meet first.
  const bool is_first = !(time > 0) || normal_.isZero(0);
  if (is_first && !normal.isZero(0)) normal_ = normal;
  // Where the balls around the points meet.
  Vec3d touch = found.a;
  if (pair.radius() > 0) {
    touch += pair.radius_a() / pair.radius() * (found.b + pair.centre_b() - found.a);
  }
  point_ = motion_.to_world(motion_.centre_a(time) + pair.unit() * touch, time);
  nearest_ = {time, motion_.centre_a(time) + pair.unit() * found.a,
              motion_.centre_b(time) + pair.unit() * found.b};
  return {Advancement::State::hit, {}};
}

void AdvancementSearch::let_turn(PartingPlane& plane, const Vec3d& turning) const {
  constexpr double near = 0.25;
  if (plane.gap < near * std::min(motion_.reach_a(), motion_.reach_b())) plane.turning = turning;
}

Advancement AdvancementSearch::apart(const SupportPair<double>& pair, double time,
                                     const Vec3d& normal, double cores_apart) {
  const double unit = pair.unit();
  const double slack = RelativeMotion::pair_rounding * unit + motion_.placement_rounding();
  Advancement result;
  result.plane = {time, normal, unit * (cores_apart - pair.radius()) - slack};
  if (result.plane.gap > 0) {
    result.state = Advancement::State::apart;
    normal_ = normal;
  }
  return result;
}

void AdvancementSearch::finish(double time, CastOutcome& outcome) const {
  if (!normal_.isZero(0)) outcome.normal = normal_;
  outcome.point = point_;
  prove_contact(time, outcome);
  keep_to_tolerance(asked_tolerance_, hidden_, outcome);
}

void AdvancementSearch::prove_contact(double time, CastOutcome& outcome) const {
  if (!(time > 0)) {
    SupportPair<double> pair = motion_.at(0);
    if (contact_is_proven(pair, motion_.placement_rounding(), outcome.iterations)) {
      outcome.upper = 0;
      return;
    }
  }
  // The first try is at the tolerance's depth if the bodies close at the speed of their origins.
  const double speed = motion_.speed() + motion_.angle_a() * motion_.reach_a() +
                       motion_.angle_b() * motion_.reach_b();
  if (!(speed > 0)) return;
  if (const auto by = contact_by(motion_, nearest_, 2 * tolerance_ / speed, outcome.iterations)) {
    outcome.upper = *by;
  }
}

}  // namespace touchstone
