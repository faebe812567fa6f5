// The search by GJK, the proof of a contact, and the numbers of a hit.
#include "algorithms/kernels/motion/linear/linear_cast.h"

#include <algorithm>
#include <optional>

#include "algorithms/kernels/motion/halfspace_cast.h"
#include "algorithms/kernels/motion/keep_to_tolerance.h"
#include "algorithms/kernels/motion/linear/ball_verdict.h"
#include "algorithms/kernels/motion/linear/contact_proofs.h"

namespace touchstone {

bool part_by_plane(MovingPair& pair, const Vec3d& normal, double gap, PathContact& found) {
  constexpr double rounding = MovingPair::rounding;
  if (!(gap > rounding)) return false;
  const double speed = normal.dot(pair.velocity());
  if (gap + (1 - pair.time()) * speed > rounding) return true;
  const double time = std::min(pair.time() + (gap - rounding) / -speed, 1.0);
  if (time > pair.time()) {
    found.plane = normal;
    pair.move_to(time, found.simplex);
  }
  return false;
}

PathEnd search_by_gjk(MovingPair& pair, double tolerance, int most_iterations, PathContact& found) {
  const double radius = pair.radius();
  Simplex<double>& simplex = found.simplex;
  if (found.direction.isZero(0)) found.direction = pair.first_direction();
  // Comparisons are written so that NaN ends the loop.
  while (found.iterations < most_iterations) {
    ++found.iterations;
    DifferencePoint<double> point = pair.support(found.direction);
    const double gap = -found.direction.dot(point.difference) - radius;
    const double before = pair.time();
    if (part_by_plane(pair, found.direction, gap, found)) return PathEnd::miss;
    const bool advanced = pair.time() > before;
    if (advanced) point.difference = point.a - (point.b + pair.offset());
    bool known = false;
    for (int i = 0; i < simplex.size; ++i) {
      known = known || simplex.points[static_cast<std::size_t>(i)].difference == point.difference;
    }
    if (known && !advanced) return PathEnd::open;
    if (!known) simplex.points[static_cast<std::size_t>(simplex.size++)] = point;
    found.nearest = reduce_to_nearest(simplex);
    if (found.nearest.inside || found.nearest.distance <= radius + tolerance) return PathEnd::hit;
    if (!(found.nearest.distance > 0)) return PathEnd::open;
    found.direction = -found.nearest.direction;
  }
  return PathEnd::open;
}

namespace {

// The normal, from a to b, of a plane along which bodies that are in contact at time 0 are no deeper
// than the tolerance in each other; zero if none is found. Rounding may have turned the nearest point's.
Vec3d touching_normal(MovingPair& pair, const PathContact& found, double tolerance) {
  if (found.nearest.inside) return Vec3d::Zero();
  for (const Vec3d& normal : {Vec3d(-found.nearest.direction), found.nearest.direction}) {
    const double gap = -normal.dot(pair.support(normal).difference) - pair.radius();
    if (gap > -tolerance) return normal;
  }
  return Vec3d::Zero();
}

// Returns a time by which the bodies are proven to share a point, if it finds one.
std::optional<double> contact_by(MovingPair& pair, const PathContact& found, const Vec3d& normal,
                                 int& iterations) {
  constexpr int most_tries = 7;
  constexpr double growth = 16;
  const double begin = pair.time(), speed = -normal.dot(pair.velocity());
  // Bodies that touch along a plane and go in through it overlap soon, and hardly do so yet.
  if (!(begin > 0) && !(speed > 0) && contact_is_proven(pair, found.simplex, 0, iterations))
    return 0;
  const double depth =
      found.nearest.inside ? 0.0 : std::max(found.nearest.distance - pair.radius(), 0.0);
  // First to where they are so deep along the plane that rounding does not hide it.
  const double least = depth + 256 * MovingPair::rounding;
  double step = speed > 0 ? least / speed : least;
  for (int k = 0; k < most_tries; ++k, step *= growth) {
    const double time = std::min(begin + step, 1.0);
    if (contact_is_proven(pair, found.simplex, time, iterations)) return time;
    if (!(time < 1)) break;
  }
  return {};
}

}  // namespace

double LinearCast::tolerance(std::uint32_t shape_a, std::uint32_t shape_b) const {
  return settings_.tolerance.value_or(1e-9 * std::max(scene_.size(shape_a), scene_.size(shape_b)));
}

void LinearCast::solve(const CastBatch& batch, std::size_t i, CastOutcome& outcome) {
  outcome = {};
  if (batch.kind_b == ShapeKind::halfspace) {
    const MovingBody a = scene_.body(batch, batch.pairs.first[i]);
    const MovingBody b = scene_.body(batch, batch.pairs.second[i]);
    cast_halfspace(*a.shape, *a.pose, *a.motion, *b.shape, *b.pose, *b.motion,
                   {settings_.tolerance, settings_.start}, outcome);
    return;
  }
  std::optional<Begun> begun;
  if (!begin(batch, i, begun, outcome)) return;
  PathContact found;
  const PathEnd end = search_(begun->pair, begun->tolerance, most_iterations_, found);
  finish(*begun, end, found, outcome);
}

void LinearCast::solve(const CastBatch& batch, std::span<CastOutcome> outcomes) {
  for (std::size_t i = 0; i < batch.size(); ++i) solve(batch, i, outcomes[i]);
}

bool LinearCast::begin(const CastBatch& batch, std::size_t i, std::optional<Begun>& begun,
                       CastOutcome& outcome) const {
  const MovingBody a = scene_.body(batch, batch.pairs.first[i]);
  const MovingBody b = scene_.body(batch, batch.pairs.second[i]);
  outcome.status = Status::ok;
  outcome.iterations = 0;
  const CentreOffset offset = centre_offset(*a.shape, *a.pose, *b.shape, *b.pose);
  const double reach_a = outer_reach(a), reach_b = outer_reach(b);
  const double metres = settings_.tolerance.value_or(1e-9 * std::max(reach_a, reach_b));
  const BallVerdict balls = ask_balls(offset, a, b, reach_a + reach_b, metres);
  if (balls == BallVerdict::miss) {
    outcome.answer = CastAnswer::miss;
    return false;
  }
  if (balls == BallVerdict::overlap) {
    outcome.answer = CastAnswer::hit;
    outcome.toi = outcome.lower = outcome.upper = 0;
    outcome.point = point_in_balls(offset, a, b);
    return false;
  }
  begun.emplace(a, b, offset, reach_a + reach_b, metres);
  if (begun->pair.is_in_range()) return true;
  outcome.status = Status::degenerate;
  return false;
}

void LinearCast::write_hit(const Begun& begun, double time, const Vec3d& on_a,
                           CastOutcome& outcome) {
  const MovingBody& a = begun.a;
  outcome.answer = CastAnswer::hit;
  outcome.toi = time;
  outcome.point = a.pose->rotation * a.shape->centre + a.pose->translation +
                  time * a.motion->displacement + begun.pair.unit() * on_a;
}

void LinearCast::finish(Begun& begun, PathEnd end, PathContact& found, CastOutcome& outcome) {
  auto& [a, b, pair, tolerance] = begun;
  outcome.iterations = found.iterations;
  if (end == PathEnd::miss) {
    outcome.answer = CastAnswer::miss;
    return;
  }
  outcome.lower = pair.time();
  if (end == PathEnd::open) {
    outcome.status = Status::not_converged;
    return;
  }
  const bool at_start = !(pair.time() > 0);
  if (at_start && approach_) {
    const Approach approach = approach_->ask(pair, tolerance, outcome.iterations);
    if (approach == Approach::unknown) {
      outcome.status = Status::not_converged;
      return;
    }
    if (approach == Approach::no) {
      outcome.answer = CastAnswer::miss;
      outcome.lower = CastOutcome::none;
      return;
    }
  }
  const Vec3d normal = at_start ? touching_normal(pair, found, tolerance) : found.plane;
  if (!normal.isZero(0)) outcome.normal = normal;

  Simplex<double> feature = found.simplex;
  if (found.nearest.inside) {
    // The proof of contact goes on from a face.
    feature.size = 3;
    reduce_to_nearest(feature);
  }
  const DifferencePoint<double> witness =
      found.nearest.inside ? mean_at_origin(found.simplex) : weighted_mean(feature);
  write_hit(begun, pair.time(), pair.between_balls(witness), outcome);

  pair.set_inner_radius(a.inner_radius() + b.inner_radius());
  found.simplex = feature;
  if (const auto by = contact_by(pair, found, normal, outcome.iterations)) outcome.upper = *by;
  // Bodies that approach get deeper into each other than the tolerance, which is proof enough.
  if (at_start && approach_) return;
  keep_to_tolerance(settings_.tolerance, 4 * MovingPair::rounding * pair.unit(), outcome);
}

}  // namespace touchstone
