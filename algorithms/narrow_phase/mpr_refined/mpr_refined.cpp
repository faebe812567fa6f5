// Minkowski portal refinement down to a local minimum of the penetration depth, and a look at what
// is around it, so that the depth is often the least, and then proven to be.
// Paper:   Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008;
//          Zhang et al., "Incremental penetration depth estimation between convex geometries",
//          arXiv 2304.07357, 2023 (rays from the origin along the last portal's normal, warm
//          start).
// Departs: where the difference C = A - B of the bodies is a polytope, portals all around the
//          origin hold a lower bound of the depth. The lowest is divided by the support point along
//          its normal, and the search goes down again from a normal that has less; until none is
//          below the depth, which is then proven to be the least, or many are.
// Answers: moving b by the depth along the normal separates, and no direction near that has less.
//          `lower` and `upper` are certified: they are together where it is proven to be the least.
//          For a half-space the exact depth (kernels/halfspace.h).
// Warm:    keeps the last normal. Bodies that it still separates take one support point. From a
//          normal that was proven to be the best the search goes down first, and ends if that is
//          proven again; if not, the lesser of its depth and the cold one is the answer.
// Fails:   as mpr does. Not the least depth for about a third of the pairs that are deep in each
//          other, for a tenth of shallow ones. Curved bodies: nothing around is looked at.
// Cost:    mpr's, and for polytopes a support point for the first lower bound and for each portal
//          that is divided, eight at most.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "algorithms/kernels/batch/shape_prefetch.h"
#include "algorithms/kernels/minkowski/halfspace.h"
#include "algorithms/kernels/mpr/portal_search.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/mpr_refined/portal_subdivision.h"

namespace touchstone {
namespace {

// What a PairMemory holds: the last normal, from a to b in world axes (zero: none), and whether it
// was proven to have the least depth (not 0: a memory of foreign bytes must be safe to read).
struct Memory {
  std::array<double, 3> normal{};
  std::uint64_t is_least = 0;
};
static_assert(sizeof(Memory) <= sizeof(PairMemory));

// One query on two bounded bodies.
template <class Scalar>
class RefinedDepth {
 public:
  RefinedDepth(SupportPair<Scalar>& pair, int max_iterations, Scalar tolerance)
      : pair_(pair), tolerance_(tolerance), search_(pair, max_iterations, tolerance) {}

  void solve(Task task, PairMemory* memory, Outcome& outcome) {
    Memory last;
    if (memory != nullptr) std::memcpy(&last, memory->bytes.data(), sizeof last);
    answer(task, last, outcome);
    outcome.iterations = search_.iterations();
    outcome.support_calls = pair_.support_calls();
    if (memory == nullptr || outcome.answer == Answer::unknown) return;
    const bool has_depth = outcome.answer == Answer::overlapping && task == Task::penetration;
    const Vec3<Scalar>& normal = has_depth ? best_.normal : search_.normal();
    for (int k = 0; k < 3; ++k) last.normal[k] = static_cast<double>(normal[k]);
    last.is_least = has_depth && is_least() ? 1 : 0;
    std::memcpy(memory->bytes.data(), &last, sizeof last);
  }

 private:
  using Search = PortalSearch<Scalar>;
  using Point = typename Search::Point;
  using Depth = typename Search::Depth;
  using Exit = typename Search::Exit;
  static constexpr Scalar rounding = Search::rounding;
  // With more portals below the depth than these, no proof is near.
  static constexpr int most_open = 3;

  // The least of those considered; it has a witness where it is settled.
  void consider(const Depth& found) {
    if (!(found.depth < best_.depth)) return;
    best_ = found;
    if (found.settled) witness_ = search_.passage();
  }
  bool is_least() const { return best_.settled && lower_ >= enough(); }
  Scalar enough() const { return best_.depth - 2 * tolerance_; }

  void answer(Task task, const Memory& last, Outcome& outcome) {
    const Vec3<Scalar> normal = Vec3d(last.normal.data()).cast<Scalar>().normalized();
    const bool warm = normal.squaredNorm() > Scalar{0.5};
    Point furthest;
    outcome.status = Status::ok;
    if (warm) {
      furthest = search_.support(normal);
      if (!search_.separated() && task == Task::penetration && last.is_least != 0) {
        settle_from(normal, furthest);
        if (!search_.separated()) look_around(nullptr);
        if (is_least()) {
          outcome.answer = Answer::overlapping;
          return write(outcome);
        }
      }
      if (search_.separated()) {
        outcome.answer = Answer::separated;
        return;
      }
    }
    // All that a cold start does, so that a warm one is never worse.
    const Depth before = std::exchange(best_, {});
    const Point witness_before = witness_;
    const Exit exit = search_.decide(outcome);
    if (outcome.answer != Answer::overlapping || task != Task::penetration) return;
    const auto& [p, q, r] = search_.portal();
    const std::array<Point, 4> tetrahedron{p, q, r, search_.start()};
    consider(exit == Exit::straight ? leave_corner() : search_.settle_from_portal());
    look_around(&tetrahedron);
    if (before.depth < best_.depth) {
      best_ = before;
      witness_ = witness_before;
    } else if (warm && furthest.difference.dot(normal) < enough()) {
      settle_from(normal, furthest);
    }
    write(outcome);
  }

  void settle_from(const Vec3<Scalar>& normal, const Point& furthest) {
    if (search_.cast_along_normal(normal, furthest) != Exit::done || search_.separated()) return;
    consider(search_.settle({.normal = normal}));
  }

  // Where the ray leaves C in the point furthest along it, that may be the nearest way out, as for
  // balls, or the way to a corner: then directions beside it have less.
  Depth leave_corner() {
    const Depth along{search_.depth(), search_.normal(), true};
    const Vec3<Scalar> across = along.normal.unitOrthogonal();
    Depth least = along;
    Point furthest;
    for (const Vec3<Scalar>& side : {across, Vec3<Scalar>(along.normal.cross(across))}) {
      for (const Scalar tilt : {Scalar{0.0625}, Scalar{-0.0625}}) {
        const Vec3<Scalar> direction = (along.normal + tilt * side).normalized();
        const Point point = search_.support(direction);
        const Scalar depth = point.difference.dot(direction);
        if (!(depth < least.depth - tolerance_)) continue;
        least = {depth, direction, false};
        furthest = point;
      }
    }
    if (least.settled) return along;
    if (search_.cast(least.normal, furthest) != Exit::done) return least;
    return search_.settle(least);
  }

  // Raises the lower bound, and goes down from normals that have less, until none is left or too
  // many are. The cover begins with the portal and the point opposite, or with the tetrahedron.
  void look_around(const std::array<Point, 4>* tetrahedron) {
    if (!best_.settled || !pair_.is_polytope() || pair_.radius() > 0) return;
    const auto& [p, q, r] = search_.portal();
    PortalSubdivision<Scalar> cover;
    if (!cover.start({p, q, r, search_.support(-best_.normal)}) &&
        (tetrahedron == nullptr || !cover.start(*tetrahedron))) {
      return;
    }
    Depth least = best_;
    Scalar bound = 0;
    for (int divisions = 0;; ++divisions) {
      const Scalar enough = least.depth - 2 * tolerance_;
      const auto portal = cover.lowest();
      bound = std::min(portal.lower, enough);
      if (!(portal.lower < enough) || divisions == PortalSubdivision<Scalar>::most_divisions ||
          cover.count_below(enough) > most_open) {
        break;
      }
      const Point point = search_.support(portal.normal);
      const Scalar depth = point.difference.dot(portal.normal);
      if (depth < enough) {
        least = {depth, portal.normal, false};
        search_.set_portal(cover.points(portal));
      }
      cover.divide_lowest(point);
    }
    if (!least.settled) {
      const Depth found = search_.settle(least);
      if (found.settled) consider(found);
    }
    lower_ = std::max(lower_, std::min(bound, enough()));
  }

  void write(Outcome& outcome) const {
    outcome.distance = -pair_.unit() * static_cast<double>(best_.depth);
    outcome.lower = -pair_.unit() * static_cast<double>(best_.depth + rounding);
    outcome.upper = -pair_.unit() * static_cast<double>(std::max(lower_ - rounding, Scalar{0}));
    outcome.normal = best_.normal.template cast<double>().normalized();
    if (!best_.settled) {
      outcome.status = Status::not_converged;
      return;
    }
    outcome.witness_a = pair_.to_world(witness_.a);
    outcome.witness_b = pair_.to_world(witness_.b);
  }

  SupportPair<Scalar>& pair_;
  Scalar tolerance_;
  PortalSearch<Scalar> search_;
  Depth best_;
  Point witness_;
  Scalar lower_ = 0;  // of the least depth
};

template <class Scalar>
class MprRefined final : public NarrowPhase {
 public:
  explicit MprRefined(const NarrowPhaseSettings& settings)
      : max_iterations_(settings.max_iterations.value_or(256)), tolerance_(settings.tolerance) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<Scalar>(shapes);
    ahead_.bind(shapes_);
  }

  void solve(const PairBatch& batch, std::span<Outcome> outcomes) override {
    ahead_.begin({batch.first, batch.second, batch.shape_of, batch.poses}, true);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      ahead_.before(i);
      const std::uint32_t first = batch.first[i], second = batch.second[i];
      const SupportShape<Scalar>& a = shapes_[batch.shape_of[first]];
      const SupportShape<Scalar>& b = shapes_[batch.shape_of[second]];
      const Pose &pose_a = batch.poses[first], &pose_b = batch.poses[second];
      if (batch.kind_b == ShapeKind::halfspace) {
        const auto solve_plane =
            batch.kind_a == batch.kind_b ? solve_halfspaces<Scalar> : solve_halfspace<Scalar>;
        solve_plane(a, pose_a, b, pose_b, batch.task, outcomes[i]);
      } else {
        SupportPair<Scalar> pair(a, pose_a, b, pose_b);
        PairMemory* memory = batch.memory.empty() ? nullptr : &batch.memory[batch.memory_of[i]];
        RefinedDepth<Scalar>(pair, max_iterations_, tolerance_for(pair))
            .solve(batch.task, memory, outcomes[i]);
      }
    }
  }

 private:
  // On a curved surface a portal as narrow as the root of this still has a normal.
  static constexpr double curved_tolerance = 1e-10;

  Scalar tolerance_for(const SupportPair<Scalar>& pair) const {
    const double own = pair.is_polytope() && pair.radius() == 0 ? 0 : curved_tolerance;
    return std::max(static_cast<Scalar>(tolerance_.value_or(own)),
                    4 * SupportPair<Scalar>::rounding);
  }

  int max_iterations_;
  std::optional<double> tolerance_;  // in units of the pair
  std::vector<SupportShape<Scalar>> shapes_;
  ShapePrefetch<Scalar> ahead_;
};

}  // namespace
}  // namespace touchstone

TOUCHSTONE_NARROW_PHASE {
  using namespace touchstone;
  return {
      {.info = {.name = "mpr-refined",
                .citation = "Snethen, XenoCollide: Complex Collision Made Simple, Game "
                            "Programming Gems 7, 2008; Zhang et al., Incremental penetration "
                            "depth estimation between convex geometries, arXiv 2304.07357, 2023"},
       .tasks = {Task::intersect, Task::penetration},
       .scalars = {Precision::float32, Precision::float64},
       .depth_is_bound = true,
       .starts_warm = true,
       .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
         if (settings.scalar == Precision::float32)
           return std::make_unique<MprRefined<float>>(settings);
         return std::make_unique<MprRefined<double>>(settings);
       }}};
}
