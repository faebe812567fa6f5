// GJK ray cast: the time of impact of bodies that move without turning, by one run of GJK.
// Paper:   van den Bergen, "Ray casting against general convex objects with application to continuous
//          collision detection", 2004; the simplex: Montanari, Petrinic, Barbieri, ACM TOG 36(3), 2017.
// Steps:   1. Relative to body a, body b's offset moves along a segment; contact is where it meets the
//             difference of the bodies. If a plane parts balls around the bodies all the way, it is a
//             miss; if balls inside of them overlap at time 0, it is a hit there (motion/linear).
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
//          of contact, spheres and capsules by planes at their nearest points (round_lanes), and one by
//          one as here what is left: grazes, edges that are nearly parallel, and from a touch whether bodies approach.
// Fails:   unknown / not_converged at the cap. Bodies that graze by less than the tolerance are a hit
//          without `upper`. With StartContact::approach, EPA tells bodies that get deeper from those that
//          keep to a plane (motion/linear/approach.h); it may leave curved bodies unknown / not_converged.
// Cost:    O(1) space; a few support calls for polytopes, one for each digit for curved bodies. Tolerance:
//          1e-9 of the larger body's size, or 3e-13 of the greatest of sizes, offset and path if that is
//          more. Cap: 128 iterations.
#include <algorithm>
#include <vector>

#include "algorithms/cast.h"
#include "algorithms/cast/gjk_ray_cast/box_lanes.h"
#include "algorithms/cast/gjk_ray_cast/round_lanes.h"
#include "algorithms/kernels/motion/linear/linear_cast.h"

namespace touchstone {
namespace {

class GjkRayCast final : public Cast {
 public:
  GjkRayCast(const CastSettings& settings, bool lanes)
      : one_(settings, search_by_gjk),
        lanes_(lanes),
        asks_approach_(settings.start == StartContact::approach) {}

  void bind(std::span<const Shape> shapes) override {
    source_ = shapes;
    one_.bind(shapes);
  }

  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    if (lanes_ && batch.kind_a == ShapeKind::box && batch.kind_b == ShapeKind::box) {
      return solve_lanes(batch, boxes_, load_box_lane, cast_boxes, outcomes);
    }
    if (lanes_ && batch.kind_b <= ShapeKind::capsule) {
      return solve_lanes(batch, round_, load_round_lane, cast_round, outcomes);
    }
    one_.solve(batch, outcomes);
  }

 private:
  // `load` and `cast` are those of box_lanes.h and round_lanes.h. `lanes` is scratch memory that grows.
  template <class Lane, class Load, class CastAll>
  void solve_lanes(const CastBatch& batch, std::vector<Lane>& lanes, const Load& load,
                   const CastAll& cast, std::span<CastOutcome> outcomes);

  LinearCast one_;
  std::span<const Shape> source_;
  // Scratch: the pairs in lanes, and their places in the batch.
  std::vector<BoxLane> boxes_;
  std::vector<RoundLane> round_;
  std::vector<LaneTimes> times_;
  std::vector<std::size_t> places_;
  bool lanes_, asks_approach_;
};

// What the lanes leave open is solved one pair at a time.
template <class Lane, class Load, class CastAll>
void GjkRayCast::solve_lanes(const CastBatch& batch, std::vector<Lane>& lanes, const Load& load,
                             const CastAll& cast, std::span<CastOutcome> outcomes) {
  const BodyPairs& pairs = batch.pairs;
  lanes.resize(std::max(lanes.size(), batch.size()));
  places_.clear();
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const std::uint32_t a = pairs.first[i], b = pairs.second[i];
    const std::uint32_t shape_a = pairs.shape_of[a], shape_b = pairs.shape_of[b];
    Lane& lane = lanes[places_.size()];
    const LaneLoad loaded = load(source_[shape_a], pairs.poses[a], batch.motions[a],
                                 source_[shape_b], pairs.poses[b], batch.motions[b], lane);
    if (loaded != LaneLoad::loaded) {
      if (loaded == LaneLoad::miss) {
        outcomes[i] = {.answer = CastAnswer::miss, .status = Status::ok, .iterations = 0};
      } else {
        one_.solve(batch, i, outcomes[i]);
      }
      continue;
    }
    lane.tolerance = one_.tolerance(shape_a, shape_b);
    places_.push_back(i);
  }
  times_.resize(places_.size());
  cast(std::span(lanes).first(places_.size()), times_);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const LaneTimes& times = times_[k];
    CastOutcome& outcome = outcomes[places_[k]];
    const bool is_open = !times.is_miss && !times.is_hit;
    if (is_open || (asks_approach_ && times.is_hit && !(times.lower > 0))) {
      one_.solve(batch, places_[k], outcome);
      continue;
    }
    outcome = {};
    outcome.status = Status::ok;
    outcome.iterations = times.iterations;
    outcome.answer = times.is_miss ? CastAnswer::miss : CastAnswer::hit;
    if (times.is_miss) continue;
    outcome.toi = outcome.lower = times.lower;
    outcome.upper = times.upper;
    if (!times.normal.isZero(0)) outcome.normal = times.normal.normalized();
    const std::uint32_t a = pairs.first[places_[k]];
    outcome.point =
        pairs.poses[a].translation + outcome.toi * batch.motions[a].displacement + times.on_a;
  }
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
      .in_time = true,
      .make = [](const CastSettings& settings) {
        return std::make_unique<GjkRayCast>(settings, false);
      }};
  CastEntry lanes = plain;
  lanes.info.name = "gjk-ray-cast-lanes";
  lanes.info.citation +=
      "; boxes in lanes: Gottschalk, Lin, Manocha, \"OBBTree\", SIGGRAPH 1996, "
      "with the time as in Ericson, \"Real-Time Collision Detection\", 2005, "
      "section 5.5.8";
  lanes.lacks_point = [](ShapeKind kind_a, ShapeKind kind_b) {
    return kind_a == ShapeKind::box && kind_b == ShapeKind::box;
  };
  lanes.make = [](const CastSettings& settings) {
    return std::make_unique<GjkRayCast>(settings, true);
  };
  return {plain, lanes};
}

}  // namespace touchstone::entries
