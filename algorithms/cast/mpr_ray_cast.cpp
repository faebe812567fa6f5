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
//          closes or it has no area, where the bodies are in contact at the start, and where the path is below 1e-6 of
//          the pair's unit.
// Fails:   as gjk-ray-cast.
// Cost:    O(1) space; a support call for each corner of the first portal, and one for each refinement, which
//          takes no distance of a simplex. Tolerance and cap: as gjk-ray-cast.
#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/kernels/motion/linear/linear_cast.h"

namespace touchstone {
namespace {

// A support point, and the same relative to the path: the line is the one through the origin along the path.
struct Corner {
  DifferencePoint<double> point;
  Vec3d place;
};

// The corners that are in use, by their places in an array of four.
struct Portal {
  std::array<Corner, 4> corners;
  std::array<std::uint8_t, 4> order = {0, 1, 2, 3};  // the last is free

  Corner& operator[](std::size_t k) { return corners[order[k]]; }
  Corner& free() { return corners[order[3]]; }
  // Puts the free corner where the k-th is, which becomes the free one.
  void replace(std::size_t k) { std::swap(order[k], order[3]); }
};

// The search for a pair whose cores are known when this is compiled.
template <class CoreOfA, class CoreOfB>
class PortalSearch {
 public:
  PortalSearch(MovingPair& pair, PathContact& found) : pair_(pair), found_(found) {}

  PathEnd search(double tolerance, int most_iterations);

 private:
  enum class Step : std::uint8_t { closed, miss, open };

  // Returns true if the support plane along the unit direction parts the bodies to the end.
  bool take(const Vec3d& direction, Corner& corner) {
    ++found_.iterations;
    corner.point = pair_.support<CoreOfA, CoreOfB>(direction);
    corner.place = corner.point.a - corner.point.b - pair_.start();
    return part_by_plane(pair_, direction, -direction.dot(corner.point.difference), found_);
  }
  // Positive if the line passes on the left of the way from p to q, seen against the path.
  double side(const Corner& p, const Corner& q) const { return q.place.cross(p.place).dot(along_); }

  Vec3d entry_normal() const;
  bool take_beside(const Vec3d& across, Corner& corner);
  Step discover(int most_iterations);
  Step refine(double tolerance, int most_iterations);

  MovingPair& pair_;
  PathContact& found_;
  Vec3d along_ = Vec3d::Zero(), entry_ = Vec3d::Zero();
  double lean_ = 1;
  Portal portal_;
};

// The direction at which the path enters a ball that holds the difference, or passes it.
template <class CoreOfA, class CoreOfB>
Vec3d PortalSearch<CoreOfA, CoreOfB>::entry_normal() const {
  const double ahead = -pair_.start().dot(along_);
  const Vec3d nearest = pair_.start() + ahead * along_;
  const double back = pair_.reach() * pair_.reach() - nearest.squaredNorm();
  return (back > 0 ? Vec3d(nearest - std::sqrt(back) * along_) : nearest).normalized();
}

// Takes a support point along a direction that leans from the entry across the path, or, if that point is not
// beyond the line, straight across.
template <class CoreOfA, class CoreOfB>
bool PortalSearch<CoreOfA, CoreOfB>::take_beside(const Vec3d& across, Corner& corner) {
  if (take((across + lean_ * entry_).normalized(), corner)) return true;
  return !(corner.place.dot(across) > 0) && take(across, corner);
}

template <class CoreOfA, class CoreOfB>
auto PortalSearch<CoreOfA, CoreOfB>::discover(int most_iterations) -> Step {
  const int most_corners = std::min(24, most_iterations);
  if (take(entry_, portal_[0])) return Step::miss;
  const Vec3d& first = portal_[0].place;
  Vec3d across = first.dot(along_) * along_ - first;
  double length = across.norm();
  if (!(length > 0)) return Step::open;
  if (take_beside(across / length, portal_[1])) return Step::miss;
  // The edge that the line is outside of, and the corner that the next one replaces.
  std::size_t from = 0, to = 1, next = 2;
  for (int k = 0; k < most_corners; ++k) {
    across = (portal_[to].place - portal_[from].place).cross(along_);
    length = across.norm();
    if (!(length > 0)) return Step::open;
    length = std::copysign(length, -across.dot(portal_[from].place));
    if (take_beside(across / length, portal_[next])) return Step::miss;
    const double edges[3] = {side(portal_[1], portal_[2]), side(portal_[2], portal_[0]),
                             side(portal_[0], portal_[1])};
    const double area = edges[0] + edges[1] + edges[2];
    if (!(area != 0)) return Step::open;
    const double sense = std::copysign(1.0, area);
    next = sense * edges[1] < sense * edges[0] ? 1 : 0;
    next = sense * edges[2] < sense * edges[next] ? 2 : next;
    if (sense * edges[next] >= 0) {
      if (sense < 0) std::swap(portal_.order[1], portal_.order[2]);
      return Step::closed;
    }
    from = (next + 1) % 3;
    to = (next + 2) % 3;
  }
  return Step::open;
}

template <class CoreOfA, class CoreOfB>
auto PortalSearch<CoreOfA, CoreOfB>::refine(double tolerance, int most_iterations) -> Step {
  while (found_.iterations < most_iterations) {
    const Corner &p = portal_[0], &q = portal_[1], &r = portal_[2];
    const Vec3d cross = (q.place - p.place).cross(r.place - p.place);
    const double length = cross.norm();
    if (!(length > 0)) return Step::open;
    const Vec3d normal = cross / length;
    Corner& next = portal_.free();
    if (take(normal, next)) return Step::miss;
    const double speed = -normal.dot(along_);
    const double beyond = normal.dot(next.place - p.place);
    if (!(beyond > tolerance * speed) || !(beyond > MovingPair::rounding / 16)) {
      return speed > 0 ? Step::closed : Step::open;
    }
    // Of the three new portals the line passes one most clearly.
    const double of_p = side(next, p), of_q = side(next, q), of_r = side(next, r);
    const double over[3] = {std::min(of_q, -of_r), std::min(of_r, -of_p), std::min(of_p, -of_q)};
    std::size_t dropped = over[1] > over[0] ? 1 : 0;
    dropped = over[2] > over[dropped] ? 2 : dropped;
    portal_.replace(dropped);
  }
  return Step::open;
}

template <class CoreOfA, class CoreOfB>
PathEnd PortalSearch<CoreOfA, CoreOfB>::search(double tolerance, int most_iterations) {
  const double length = pair_.velocity().norm();
  if (!(length > 1e-6)) return PathEnd::open;
  along_ = pair_.velocity() / length;
  entry_ = entry_normal();
  // The more corners the bodies have, the nearer to the entry are those of the face there. The factor is the one
  // with the fewest support calls in trials on boxes and on hulls of 32 and 128 vertices.
  const auto corners = [](const SupportShape<double>& shape) {
    return shape.core == SupportCore::box ? 8.0 : static_cast<double>(shape.corners.size());
  };
  lean_ = 0.45 * std::sqrt(0.5 * (corners(pair_.shape_a()) + corners(pair_.shape_b())));
  Step step = discover(most_iterations);
  if (step == Step::closed) step = refine(tolerance, most_iterations);
  if (step == Step::miss) return PathEnd::miss;
  if (step == Step::open || !(pair_.time() > 0)) return PathEnd::open;
  const double weights[3] = {side(portal_[1], portal_[2]), side(portal_[2], portal_[0]),
                             side(portal_[0], portal_[1])};
  const double sum = weights[0] + weights[1] + weights[2];
  if (!(sum > 0)) return PathEnd::open;
  found_.simplex.size = 3;
  for (std::size_t k = 0; k < 3; ++k) {
    found_.simplex.points[k] = portal_[k].point;
    found_.simplex.weights[k] = std::max(weights[k] / sum, 0.0);
  }
  pair_.move_to(pair_.time(), found_.simplex);
  found_.nearest = {};
  found_.nearest.distance = weighted_mean(found_.simplex).difference.norm();
  return found_.nearest.distance <= tolerance ? PathEnd::hit : PathEnd::open;
}

using BoxCore = SpecialisedCore<SupportCore::box>;
using HullCore = SpecialisedCore<SupportCore::hull>;

PathEnd search_by_portal(MovingPair& pair, double tolerance, int most_iterations,
                         PathContact& found) {
  const bool box_a = pair.shape_a().core == SupportCore::box,
             box_b = pair.shape_b().core == SupportCore::box;
  const auto with = [&]<class A, class B>(A, B) {
    return PortalSearch<A, B>(pair, found).search(tolerance, most_iterations);
  };
  const PathEnd end = box_a ? (box_b ? with(BoxCore{}, BoxCore{}) : with(BoxCore{}, HullCore{}))
                            : (box_b ? with(HullCore{}, BoxCore{}) : with(HullCore{}, HullCore{}));
  if (end != PathEnd::open) return end;
  found.simplex.size = 0;
  return search_by_gjk(pair, tolerance, found.iterations + most_iterations, found);
}

class MprRayCast final : public Cast {
 public:
  explicit MprRayCast(const CastSettings& settings) : one_(settings, search_by_portal) {}

  void bind(std::span<const Shape> shapes) override { one_.bind(shapes); }
  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    one_.solve(batch, outcomes);
  }

 private:
  LinearCast one_;
};

bool is_polytope(ShapeKind kind) { return kind == ShapeKind::box || kind == ShapeKind::hull; }

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CastEntry> cast_mpr_ray_cast() {
  return {
      {.info = {.name = "mpr-ray-cast",
                .citation = "Snethen, \"XenoCollide: Complex Collision Made Simple\", Game "
                            "Programming Gems 7, 2008; time grows only through planes proven "
                            "beyond rounding"},
       .scalars = {Precision::float64},
       .rotation = false,
       .approach = true,
       .supports = [](ShapeKind kind_a, ShapeKind kind_b,
                      bool) { return is_polytope(kind_a) && is_polytope(kind_b); },
       .make =
           [](const CastSettings& settings) { return std::make_unique<MprRayCast>(settings); }}};
}

}  // namespace touchstone::entries
