// Bilateral advancement: time is narrowed from both ends along the axis of the closest points.
// Paper:   Catto, "Continuous collision", GDC 2013 (the time of impact of Box2D and box3d).
// Steps:   1. GJK finds the closest points, and their axis n (kernels/gjk).
//          2. From the end of the motion: the deepest points along n are the support points there. If they
//             are not past each other, the axis serves until that end.
//          3. Otherwise these two points, carried by their bodies, meet along n at an earlier time, which a
//             root finder of secants and bisections finds; this is the new end. Repeat step 2 until no points
//             are past each other there.
//          4. From the beginning: prove that n parts the bodies up to that end, piece by piece
//             (kernels/motion/advancement/parting_step), and go on where the proof ends.
//          5. Repeat until the distance is within the tolerance (kernels/motion/advancement/advancement).
// Departs: the published method takes what it finds at the end for what holds all the way there, and cannot
//          know: bodies that turn may be past each other along n in between, and such a contact is missed.
//          Step 4 is ours, and with it an answer is certified. Without rotation the gap along n is linear,
//          and one piece is the whole proof. The tolerance is no slop that is left between the bodies.
// Fails:   unknown / not_converged at the cap of 2,000 steps.
// Cost:    a GJK distance, two supports for each new end and some for each piece. The end is exact along the axis,
//          and the pieces save GJK, not proofs: at many turns these are what it costs. Tolerance: 1e-9 of the
//          larger body's size.
#include <optional>

#include "algorithms/kernels/motion/advancement/advancing_cast.h"

namespace touchstone {
namespace {

// Points of the bodies that are deepest along an axis at a time; from their bodies' origins, world axes.
struct DeepestPoints {
  double time;
  Vec3d a, b;
};

// The gap along the plane's normal at a time.
double gap_at(const RelativeMotion& motion, SupportPair<double>& pair, const Vec3d& n) {
  const double slack = RelativeMotion::pair_rounding * pair.unit() + motion.placement_rounding();
  return pair.unit() * (-n.dot(pair.support(n).difference) - pair.radius()) - slack;
}

DeepestPoints deepest_points(const RelativeMotion& motion, double time, const Vec3d& n) {
  SupportPair<double> pair = motion.at(time);
  const DifferencePoint<double> point = pair.support(n);
  return {time, motion.centre_a(time) + pair.unit() * point.a,
          motion.centre_b(time) + pair.unit() * (point.b - pair.centre_b())};
}

// The gap along n, without the radii, between two points that their bodies carry along.
double carried_gap(const RelativeMotion& motion, const DeepestPoints& points, double time,
                   const Vec3d& n) {
  const double later = time - points.time;
  const Vec3d a = rotation_by(later * motion.a().motion->rotation_vector) * points.a;
  const Vec3d b = rotation_by(later * motion.b().motion->rotation_vector) * points.b;
  return n.dot(motion.offset(time) + b - a);
}

// A time between `begin`, at which the points have not met, and their own, at which they are past each other:
// where they meet.
double meeting_time(const RelativeMotion& motion, const DeepestPoints& points, double begin,
                    double radius, const Vec3d& n) {
  constexpr int most_tries = 12;
  double low = begin, high = points.time;
  double open = carried_gap(motion, points, low, n) - radius;
  double past = carried_gap(motion, points, high, n) - radius;
  if (!(open > 0)) return begin;
  const double enough = 0.05 * open;
  for (int k = 0; k < most_tries; ++k) {
    // Secants and bisections in turn, so that neither end stays for ever.
    const double time = k % 2 == 0 ? low + (high - low) * open / (open - past) : 0.5 * (low + high);
    const double gap = carried_gap(motion, points, time, n) - radius;
    (gap > 0 ? low : high) = time;
    (gap > 0 ? open : past) = gap;
    if (gap > 0 && gap < enough) break;
  }
  return low;
}

// The time until which no points are past each other along n, as far as the ends of the search tell.
double axis_serves_until(const RelativeMotion& motion, const PartingPlane& plane) {
  constexpr int most_ends = 4;
  const double radius = motion.a().shape->radius + motion.b().shape->radius;
  double end = 1;
  for (int k = 0; k < most_ends; ++k) {
    const DeepestPoints points = deepest_points(motion, end, plane.normal);
    if (carried_gap(motion, points, end, plane.normal) > radius) break;
    end = meeting_time(motion, points, plane.time, radius, plane.normal);
  }
  return end;
}

struct BilateralStep {
  static constexpr bool balls_first = true, lasting_planes = false;  // the axis keeps its direction
  static FreeUntil step(const RelativeMotion& motion, SupportPair<double>& pair,
                        const PartingPlane& plane);
};

FreeUntil BilateralStep::step(const RelativeMotion& motion, SupportPair<double>& pair,
                              const PartingPlane& plane) {
  constexpr int most_pieces = 32;
  FreeUntil free = longest_step(motion, pair, plane);
  const bool turns = motion.a().motion->turns() || motion.b().motion->turns();
  if (free.to_the_end || !turns || !(free.time > plane.time)) return free;
  // Where a piece ends with the gap used up, the next plane is better.
  const double enough = 0.3 * plane.gap;
  PartingPlane piece = plane;
  std::optional<double> end;
  for (int k = 0; k < most_pieces; ++k) {
    SupportPair<double> there = motion.at(free.time);
    piece.time = free.time;
    piece.gap = gap_at(motion, there, plane.normal);
    if (!(piece.gap > enough)) break;
    if (!end) end = axis_serves_until(motion, piece);
    if (free.time >= *end) break;
    const FreeUntil further = longest_step(motion, there, piece);
    if (further.to_the_end) return further;
    if (!(further.time > free.time)) break;
    free.time = further.time;
  }
  return free;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CastEntry> cast_bilateral_advancement() {
  return {
      {.info = {.name = "bilateral-advancement",
                .citation = "Catto, \"Continuous collision\", GDC 2013, with a proof of each step"},
       .scalars = {Precision::float64},
       .rotation = true,
       .in_time = true,
       .supports = advancing_cast_supports,
       .make = [](const CastSettings& settings) {
         return std::make_unique<AdvancingCast<BilateralStep>>(settings);
       }}};
}

}  // namespace touchstone::entries
