// GJK ray cast: the time of impact of bodies that move without turning, by one run of GJK.
// Paper:   van den Bergen, "Ray casting against general convex objects with application to continuous
//          collision detection", 2004; the simplex: Montanari, Petrinic, Barbieri, ACM TOG 36(3), 2017.
// Steps:   1. Relative to body a, body b's offset moves along a segment; contact is where it meets the
//             difference of the bodies. If a plane parts balls around the bodies all the way, it is a
//             miss.
//          2. Find the support plane along the current direction. The gap along it is linear in time.
//             If it is open at the end of the motion as well, it is a miss; otherwise time grows to
//             where the gap closes, and the points of the simplex move back by as much.
//          3. Add the support point, and reduce the simplex to the feature nearest to the origin
//             (minkowski/simplex). If that is nearer than the radii and the tolerance, it is a hit.
//          4. The next direction is away from the nearest point. Repeat from step 2.
//          5. Prove contact a little later, for the upper end of the bracket: GJK goes on at that time, and at
//             later ones if that fails.
// Departs: time grows only through planes whose gap is proven beyond rounding (MovingPair::rounding), so
//          that no contact is missed and `lower` is certified; giving up is `unknown`, never a miss. The
//          balls of spheres and capsules are taken off first, so that those are points and segments.
//          Half-spaces are solved in closed form (motion/halfspace_cast). gjk-ray-cast-lanes solves boxes
//          in lanes by the times at which their shadows on the 15 axes meet (box_lanes), without a point
//          of contact, spheres and capsules by planes at their nearest points (round_lanes), and one by one as here what is left: contact at the start, grazes, and edges that
//          are nearly parallel.
// Fails:   unknown / not_converged at the cap. Bodies that graze by less than the tolerance are a hit
//          without `upper`. With StartContact::approach, bodies that touch at time 0 and for which no
//          plane is found that they keep to are a hit at 0.
// Cost:    O(1) space; a few support calls for polytopes, one for each digit for curved bodies. Tolerance:
//          1e-9 of the larger body's size, or 3e-13 of the greatest of sizes, offset and path if that is
//          more. Cap: 128 iterations.
#include <algorithm>
#include <optional>
#include <vector>

#include "algorithms/cast.h"
#include "algorithms/cast/gjk_ray_cast/box_lanes.h"
#include "algorithms/cast/gjk_ray_cast/contact_proofs.h"
#include "algorithms/cast/gjk_ray_cast/moving_pair.h"
#include "algorithms/cast/gjk_ray_cast/round_lanes.h"
#include "algorithms/kernels/motion/halfspace_cast.h"
#include "algorithms/kernels/motion/inner_ball.h"
#include "algorithms/kernels/motion/relative_motion.h"

namespace touchstone {
namespace {

class GjkRayCast final : public Cast {
 public:
  GjkRayCast(const CastSettings& settings, bool lanes)
      : settings_(settings),
        most_iterations_(std::max(1, settings.max_iterations.value_or(128))),
        lanes_(lanes) {}

  void bind(std::span<const Shape> shapes) override {
    source_ = shapes;
    shapes_ = make_support_shapes<double>(shapes);
    inner_radii_ = inner_radii(shapes, shapes_);
  }

  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    if (lanes_ && batch.kind_a == ShapeKind::box && batch.kind_b == ShapeKind::box) {
      return solve_lanes(batch, boxes_, load_box_lane, cast_boxes, outcomes);
    }
    if (lanes_ && batch.kind_b <= ShapeKind::capsule) {
      return solve_lanes(batch, round_, load_round_lane, cast_round, outcomes);
    }
    for (std::size_t i = 0; i < batch.size(); ++i) solve_one(batch, i, outcomes[i]);
  }

 private:
  MovingBody moving(const CastBatch& batch, std::uint32_t k) const {
    const std::uint32_t shape = batch.pairs.shape_of[k];
    return {&shapes_[shape], &batch.pairs.poses[k], &batch.motions[k], inner_radii_[shape]};
  }

  void solve_one(const CastBatch& batch, std::size_t i, CastOutcome& outcome) const;
  // `load` and `cast` are those of box_lanes.h and round_lanes.h. `lanes` is scratch memory.
  template <class Lane, class Load, class CastAll>
  void solve_lanes(const CastBatch& batch, std::vector<Lane>& lanes, const Load& load,
                   const CastAll& cast, std::span<CastOutcome> outcomes);

  enum class End { hit, miss, open };

  // The search: the pair is at the greatest time before which it is proven free.
  struct Search {
    Simplex<double> simplex;
    NearestPoint<double> nearest;
    Vec3d plane =
        Vec3d::Zero();  // the normal, from a to b, of the last plane through which time grew
    Vec3d direction = Vec3d::Zero();
    int iterations = 0;
  };

  End search(MovingPair& pair, double tolerance, Search& found) const;
  static Vec3d touching_normal(MovingPair& pair, const Search& found, double tolerance);
  static std::optional<double> contact_by(MovingPair& pair, const Search& found,
                                          const Vec3d& normal, int& iterations);
  void cast_bounded(const MovingBody& a, const MovingBody& b, CastOutcome& outcome) const;

  CastSettings settings_;
  int most_iterations_;
  std::vector<SupportShape<double>> shapes_;
  std::vector<double> inner_radii_;  // metres, one for each shape
  std::span<const Shape> source_;
  // Scratch: the pairs in lanes, and their places in the batch.
  std::vector<BoxLane> boxes_;
  std::vector<RoundLane> round_;
  std::vector<LaneTimes> times_;
  std::vector<std::size_t> places_;
  bool lanes_;
};

void GjkRayCast::solve_one(const CastBatch& batch, std::size_t i, CastOutcome& outcome) const {
  const MovingBody a = moving(batch, batch.pairs.first[i]);
  const MovingBody b = moving(batch, batch.pairs.second[i]);
  outcome = {};
  if (batch.kind_b == ShapeKind::halfspace) {
    cast_halfspace(*a.shape, *a.pose, *a.motion, *b.shape, *b.pose, *b.motion,
                   {settings_.tolerance.value_or(0), settings_.start}, outcome);
  } else {
    cast_bounded(a, b, outcome);
  }
}

// What the lanes leave open is solved one pair at a time.
template <class Lane, class Load, class CastAll>
void GjkRayCast::solve_lanes(const CastBatch& batch, std::vector<Lane>& lanes, const Load& load,
                             const CastAll& cast, std::span<CastOutcome> outcomes) {
  const BodyPairs& pairs = batch.pairs;
  lanes.clear();
  places_.clear();
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const std::uint32_t a = pairs.first[i], b = pairs.second[i];
    const std::uint32_t shape_a = pairs.shape_of[a], shape_b = pairs.shape_of[b];
    Lane& lane = lanes.emplace_back();
    if (!load(source_[shape_a], pairs.poses[a], batch.motions[a], source_[shape_b], pairs.poses[b],
              batch.motions[b], lane)) {
      lanes.pop_back();
      solve_one(batch, i, outcomes[i]);
      continue;
    }
    const auto size = [&](std::uint32_t k) { return shapes_[k].size + shapes_[k].radius; };
    lane.tolerance = settings_.tolerance.value_or(1e-9 * std::max(size(shape_a), size(shape_b)));
    places_.push_back(i);
  }
  times_.resize(lanes.size());
  cast(lanes, times_);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const LaneTimes& times = times_[k];
    CastOutcome& outcome = outcomes[places_[k]];
    if (!times.is_miss && !times.is_hit) {
      solve_one(batch, places_[k], outcome);
      continue;
    }
    outcome = {};
    outcome.status = Status::ok;
    outcome.iterations = times.iterations;
    outcome.answer = times.is_miss ? CastAnswer::miss : CastAnswer::hit;
    if (times.is_miss) continue;
    outcome.toi = outcome.lower = times.lower;
    outcome.upper = times.upper;
    outcome.normal = times.normal.normalized();
    const std::uint32_t a = pairs.first[places_[k]];
    outcome.point =
        pairs.poses[a].translation + outcome.toi * batch.motions[a].displacement + times.on_a;
  }
}

GjkRayCast::End GjkRayCast::search(MovingPair& pair, double tolerance, Search& found) const {
  constexpr double rounding = MovingPair::rounding;
  const double radius = pair.radius();
  Simplex<double>& simplex = found.simplex;
  // Comparisons are written so that NaN ends the loop.
  while (found.iterations < most_iterations_) {
    ++found.iterations;
    DifferencePoint<double> point = pair.support(found.direction);
    const double gap = -found.direction.dot(point.difference) - radius;
    bool advanced = false;
    if (gap > rounding) {
      const double speed = found.direction.dot(pair.velocity());
      if (gap + (1 - pair.time()) * speed > rounding) return End::miss;
      const double time = std::min(pair.time() + (gap - rounding) / -speed, 1.0);
      if (time > pair.time()) {
        advanced = true;
        found.plane = found.direction;
        pair.move_to(time, simplex);
        point.difference = point.a - (point.b + pair.offset());
      }
    }
    bool known = false;
    for (int i = 0; i < simplex.size; ++i) {
      known = known || simplex.points[static_cast<std::size_t>(i)].difference == point.difference;
    }
    if (known && !advanced) return End::open;
    if (!known) simplex.points[static_cast<std::size_t>(simplex.size++)] = point;
    found.nearest = reduce_to_nearest(simplex);
    if (found.nearest.inside || found.nearest.distance <= radius + tolerance) return End::hit;
    if (!(found.nearest.distance > 0)) return End::open;
    found.direction = -found.nearest.direction;
  }
  return End::open;
}

// The normal, from a to b, of a plane along which bodies that are in contact at time 0 are no deeper
// than the tolerance in each other; zero if none is found. Rounding may have turned the nearest point's.
Vec3d GjkRayCast::touching_normal(MovingPair& pair, const Search& found, double tolerance) {
  if (found.nearest.inside) return Vec3d::Zero();
  for (const Vec3d& normal : {Vec3d(-found.nearest.direction), found.nearest.direction}) {
    const double gap = -normal.dot(pair.support(normal).difference) - pair.radius();
    if (gap > -tolerance) return normal;
  }
  return Vec3d::Zero();
}

// Returns a time by which the bodies are proven to share a point, if it finds one.
std::optional<double> GjkRayCast::contact_by(MovingPair& pair, const Search& found,
                                             const Vec3d& normal, int& iterations) {
  constexpr int most_tries = 7;
  constexpr double growth = 16;
  const double begin = pair.time();
  if (!(begin > 0) && contact_is_proven(pair, found.simplex, 0, iterations)) return 0;
  const double depth =
      found.nearest.inside ? 0.0 : std::max(found.nearest.distance - pair.radius(), 0.0);
  // First to where they are so deep along the plane that rounding does not hide it.
  const double least = depth + 256 * MovingPair::rounding;
  const double speed = -normal.dot(pair.velocity());
  double step = speed > 0 ? least / speed : least;
  for (int k = 0; k < most_tries; ++k, step *= growth) {
    const double time = std::min(begin + step, 1.0);
    if (contact_is_proven(pair, found.simplex, time, iterations)) return time;
    if (!(time < 1)) break;
  }
  return {};
}

void GjkRayCast::cast_bounded(const MovingBody& a, const MovingBody& b,
                              CastOutcome& outcome) const {
  constexpr double rounding = MovingPair::rounding;
  MovingPair pair(*a.shape, *a.pose, *a.motion, *b.shape, *b.pose, *b.motion);
  outcome.status = Status::ok;
  outcome.iterations = 0;
  if (!pair.is_in_range()) {
    outcome.status = Status::degenerate;
    return;
  }
  Search found;
  if (pair.balls_miss(found.direction)) {
    outcome.answer = CastAnswer::miss;
    return;
  }
  const double asked =
      settings_.tolerance ? *settings_.tolerance / pair.unit() : 1e-9 * pair.size();
  // A gap that rounding hides can be told neither from contact nor from a miss.
  const double tolerance = std::max(asked, 4 * rounding);
  const End end = search(pair, tolerance, found);
  outcome.iterations = found.iterations;
  if (end == End::miss) {
    outcome.answer = CastAnswer::miss;
    return;
  }
  outcome.lower = pair.time();
  if (end == End::open) {
    outcome.status = Status::not_converged;
    return;
  }
  const bool at_start = !(pair.time() > 0);
  if (at_start && settings_.start == StartContact::approach &&
      never_deeper(pair, tolerance, most_iterations_, outcome.iterations)) {
    outcome.answer = CastAnswer::miss;
    outcome.lower = CastOutcome::none;
    return;
  }
  outcome.answer = CastAnswer::hit;
  outcome.toi = pair.time();
  const Vec3d normal = at_start ? touching_normal(pair, found, tolerance) : found.plane;
  if (!normal.isZero(0)) outcome.normal = normal;

  Simplex<double> feature = found.simplex;
  if (found.nearest.inside) {
    // Weights of an inner point are not known; a face's are good enough for the witness.
    feature.size = 3;
    reduce_to_nearest(feature);
  }
  const DifferencePoint<double> witness = weighted_mean(feature);
  outcome.point = a.pose->rotation * a.shape->centre + a.pose->translation +
                  outcome.toi * a.motion->displacement + pair.unit() * pair.on_a(witness, normal);

  pair.set_inner_radius(a.inner_radius() + b.inner_radius());
  found.simplex = feature;
  if (const auto by = contact_by(pair, found, normal, outcome.iterations)) outcome.upper = *by;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CastEntry> cast_gjk_ray_cast() {
  CastEntry plain{
      .info = {.name = "gjk-ray-cast",
               .citation = "van den Bergen, \"Ray casting against general convex objects with "
                           "application to continuous collision detection\", 2004; time grows "
                           "only through planes proven beyond rounding"},
      .scalars = {Precision::float64},
      .rotation = false,
      .approach = true,
      .make = [](const CastSettings& settings) {
        return std::make_unique<GjkRayCast>(settings, false);
      }};
  CastEntry lanes = plain;
  lanes.info.name = "gjk-ray-cast-lanes";
  lanes.info.citation +=
      "; boxes in lanes: Gottschalk, Lin, Manocha, \"OBBTree\", SIGGRAPH 1996, "
      "with the time as in Ericson, \"Real-Time Collision Detection\", 2005, "
      "section 5.5.8";
  lanes.make = [](const CastSettings& settings) {
    return std::make_unique<GjkRayCast>(settings, true);
  };
  return {plain, lanes};
}

}  // namespace touchstone::entries
