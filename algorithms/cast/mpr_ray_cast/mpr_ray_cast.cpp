// MPR ray cast: the time of impact of polytopes that move without turning, by a portal around the path.
// Paper:   Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008.
// Steps:   1. Relative to body a, body b's offset moves along a segment; contact is where it meets the
//             difference of the bodies. If a plane parts balls around the bodies all the way, it is a
//             miss; if balls inside of them overlap at time 0, it is a hit there.
//          2. Take the support point along the direction at which the path enters a ball around the
//             difference, and support points beside it, until three of them close a portal: a triangle
//             that the path's line passes through.
//          3. Take the support point along the portal's normal, against the path. Where that is on the
//             portal, the portal is a face, and the path enters there. Otherwise the point makes three
//             portals with the old corners: keep the one that the line passes, and repeat.
//          4. Every support plane on the way proves the bodies free until it closes, or, if it is open at
//             the end too, a miss.
//          5. Prove contact a little later, for the upper end of the bracket (motion/linear).
// Departs: the paper's ray leaves the difference; this one enters it. Time grows only through planes whose gap is
//          proven beyond rounding (MovingPair::rounding), as in gjk-ray-cast. GJK searches instead where no portal
//          closes or it has no area, where the bodies overlap at the start, and where the path is below 1e-6 of
//          the pair's unit. mpr-ray-cast-lanes takes the same steps for pairs of hulls, one in each lane of vectors
//          (portal_lanes), each hull scanned by all of a vector, from 65 vertices on in floats first; a lane that has ended takes the next pair.
// Fails:   as gjk-ray-cast.
// Cost:    O(1) space; a support call for each corner of the first portal, and one for each refinement, which
//          takes no distance of a simplex. Lanes pay from two pairs in a batch; a pair alone takes longer in them.
//          Tolerance and cap: as gjk-ray-cast.
#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "algorithms/cast/mpr_ray_cast/path_portal.h"
#include "algorithms/cast/mpr_ray_cast/portal_lanes.h"

namespace touchstone {
namespace {

class MprRayCast final : public Cast {
 public:
  MprRayCast(const CastSettings& settings, bool lanes)
      : one_(settings, search_by_portal),
        lanes_(lanes),
        asks_approach_(settings.start == StartContact::approach) {}

  void bind(std::span<const Shape> shapes) override { one_.bind(shapes); }
  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    if (!lanes_ || batch.kind_a != ShapeKind::hull || batch.kind_b != ShapeKind::hull) {
      return one_.solve(batch, outcomes);
    }
    for (std::size_t i = 0; i < batch.size(); i += most_in_lanes)
      solve_lanes(batch, i, std::min(i + most_in_lanes, batch.size()), outcomes);
  }

 private:
  // Pairs whose numbers stay in a near cache from the search's begin to its end.
  static constexpr std::size_t most_in_lanes = 128;

  void solve_lanes(const CastBatch& batch, std::size_t first, std::size_t last,
                   std::span<CastOutcome> outcomes);
  static void write_proven(const PortalAnswer& answer, const LinearCast::Begun& begun,
                           CastOutcome& outcome);
  PathEnd end_of(const PortalQuery& query, const PortalAnswer& answer, MovingPair& pair,
                 PathContact& found) const;

  LinearCast one_;
  bool lanes_, asks_approach_;
  // Scratch: the pairs in lanes, and their places in the batch. The queries point to the pairs.
  std::vector<std::optional<LinearCast::Begun>> begun_;
  std::vector<std::size_t> places_;
  std::vector<PortalQuery> queries_;
  std::vector<PortalAnswer> answers_;
};

void MprRayCast::solve_lanes(const CastBatch& batch, std::size_t first, std::size_t last,
                             std::span<CastOutcome> outcomes) {
  begun_.resize(most_in_lanes);
  places_.clear();
  queries_.clear();
  for (std::size_t i = first; i < last; ++i) {
    outcomes[i] = {};
    std::optional<LinearCast::Begun>& begun = begun_[queries_.size()];
    if (!one_.begin(batch, i, begun, outcomes[i])) continue;
    begun->pair.set_inner_radius(begun->a.inner_radius() + begun->b.inner_radius());
    places_.push_back(i);
    queries_.push_back({&begun->pair, lean_of(begun->pair), begun->tolerance});
  }
  answers_.resize(queries_.size());
  search_portals(queries_, one_.most_iterations(), answers_);
  for (std::size_t k = 0; k < queries_.size(); ++k) {
    CastOutcome& outcome = outcomes[places_[k]];
    if (answers_[k].is_proven && (answers_[k].time > 0 || !asks_approach_)) {
      write_proven(answers_[k], *begun_[k], outcome);
      continue;
    }
    PathContact found;
    const PathEnd end = end_of(queries_[k], answers_[k], begun_[k]->pair, found);
    one_.finish(*begun_[k], end, found, outcome);
  }
}

// As LinearCast::finish, where the lanes have found all of it.
void MprRayCast::write_proven(const PortalAnswer& answer, const LinearCast::Begun& begun,
                              CastOutcome& outcome) {
  Vec3d on_a = Vec3d::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    on_a += answer.weights[k] * begun.pair.corner_of_a(answer.corners[k].a);
  LinearCast::write_hit(begun, answer.time, on_a, outcome);
  outcome.iterations = answer.iterations;
  outcome.lower = answer.time;
  outcome.upper = answer.upper;
  outcome.normal = answer.plane;
}

// As search_by_portal ends: GJK searches where the lanes end open.
PathEnd MprRayCast::end_of(const PortalQuery& query, const PortalAnswer& answer, MovingPair& pair,
                           PathContact& found) const {
  found.iterations = answer.iterations;
  found.plane = answer.plane;
  if (answer.end == PortalEnd::miss) return PathEnd::miss;
  pair.move_to(answer.time, found.simplex);
  if (answer.end == PortalEnd::closed) {
    for (std::size_t k = 0; k < 3; ++k)
      found.simplex.points[k] = pair.of_corners(answer.corners[k]);
    if (meet_portal(pair, answer.along, answer.places, query.tolerance, found) == PathEnd::hit)
      return PathEnd::hit;
  }
  found.simplex.size = 0;
  return search_by_gjk(pair, query.tolerance, found.iterations + one_.most_iterations(), found);
}

bool is_polytope(ShapeKind kind) { return kind == ShapeKind::box || kind == ShapeKind::hull; }

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CastEntry> cast_mpr_ray_cast() {
  CastEntry plain{
      .info = {.name = "mpr-ray-cast",
               .citation = "Snethen, \"XenoCollide: Complex Collision Made Simple\", Game "
                           "Programming Gems 7, 2008; time grows only through planes proven "
                           "beyond rounding"},
      .scalars = {Precision::float64},
      .rotation = false,
      .approach = true,
      .in_time = true,
      .supports = [](ShapeKind kind_a, ShapeKind kind_b,
                     bool) { return is_polytope(kind_a) && is_polytope(kind_b); },
      .make =
          [](const CastSettings& settings) {
            return std::make_unique<MprRayCast>(settings, false);
          }};
  CastEntry lanes = plain;
  lanes.info.name = "mpr-ray-cast-lanes";
  lanes.make = [](const CastSettings& settings) {
    return std::make_unique<MprRayCast>(settings, true);
  };
  return {plain, lanes};
}

}  // namespace touchstone::entries
