// Balls around bodies and inside of them.
//
// Rounding: with S the sum of the lengths of offset and displacement and of the reaches, each dot product, the
// offset itself and the reaches are off by less than the bound of moving_pair.h for a unit of at most 2 S.
#include "algorithms/kernels/motion/linear/ball_verdict.h"

#include <algorithm>

#include "algorithms/kernels/motion/linear/moving_pair.h"

namespace touchstone {
namespace {

double inner_ball(const MovingBody& body) { return body.shape_inner + body.shape->radius; }

// The ball that is surely inside however the rotation stretches.
double sure_inner_ball(const MovingBody& body) { return body.inner_radius() + body.shape->radius; }

}  // namespace

double outer_reach(const MovingBody& body) {
  return body.shape->size * body.stretch.most + body.shape->radius;
}

BallVerdict ask_balls(const CentreOffset& offset, const MovingBody& a, const MovingBody& b,
                      double reach, double tolerance) {
  constexpr double least = 1e-100, most = 1e100;
  const Vec3d& start = offset.vector;
  const Vec3d velocity = b.motion->displacement - a.motion->displacement;
  const double away = start.norm();
  const double lengths = away + velocity.norm() + reach;
  if (!(reach > least && lengths < most)) return BallVerdict::open;
  const double margin = 2 * MovingPair::rounding * lengths + 4 * offset.doubt;
  if (away < inner_ball(a) + inner_ball(b) &&
      away + tolerance + margin < sure_inner_ball(a) + sure_inner_ball(b)) {
    return BallVerdict::overlap;
  }
  if (!(away > reach)) return BallVerdict::open;
  const Vec3d there = start + nearest_time(start, velocity) * velocity;
  const double distance = there.norm();
  if (!(distance > reach + margin)) return BallVerdict::open;
  const Vec3d direction = there / distance;
  const double at_start = direction.dot(start);
  const double at_end = at_start + direction.dot(velocity);
  return std::min(at_start, at_end) > reach + margin ? BallVerdict::miss : BallVerdict::open;
}

Vec3d point_in_balls(const CentreOffset& offset, const MovingBody& a, const MovingBody& b) {
  const double of_a = sure_inner_ball(a), of_b = sure_inner_ball(b);
  return a.pose->rotation * a.shape->centre + a.pose->translation +
         of_a / (of_a + of_b) * offset.vector;
}

}  // namespace touchstone
