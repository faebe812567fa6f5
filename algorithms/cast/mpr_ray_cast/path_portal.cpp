// The search for a portal, with the cores of both bodies known when it is compiled.
#include "algorithms/cast/mpr_ray_cast/path_portal.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

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

// Where a search starts: the unit direction of the path, and the normal at which it enters a ball that holds the
// difference, or passes it.
struct Path {
  Vec3d along, entry;
};

// None where the path is too short.
std::optional<Path> path_of(const MovingPair& pair) {
  const double length = pair.velocity().norm();
  if (!(length > least_path)) return {};
  Path path;
  path.along = pair.velocity() / length;
  const double ahead = -pair.start().dot(path.along);
  const Vec3d nearest = pair.start() + ahead * path.along;
  const double back = pair.reach() * pair.reach() - nearest.squaredNorm();
  path.entry = (back > 0 ? Vec3d(nearest - std::sqrt(back) * path.along) : nearest).normalized();
  return path;
}

// Positive if the line along the path passes on the left of the way from p to q, seen against the path.
double side(const Vec3d& p, const Vec3d& q, const Vec3d& along) { return q.cross(p).dot(along); }

}  // namespace

// The more corners the bodies have, the nearer to the entry are those of the face there. The factor is the one with
// the fewest support calls in trials on boxes and on hulls of 32 and 128 vertices.
double lean_of(const MovingPair& pair) {
  const auto corners = [](const SupportShape<double>& shape) {
    return shape.core == SupportCore::box ? 8.0 : static_cast<double>(shape.corners.size());
  };
  return 0.45 * std::sqrt(0.5 * (corners(pair.shape_a()) + corners(pair.shape_b())));
}

Vec3d portal_normal(const std::array<Vec3d, 3>& places) {
  const Vec3d cross = (places[1] - places[0]).cross(places[2] - places[0]);
  const double length = cross.norm();
  return length > least_area ? Vec3d(cross / length) : Vec3d::Zero();
}

PathEnd meet_portal(MovingPair& pair, const Vec3d& along, const std::array<Vec3d, 3>& places,
                    double tolerance, PathContact& found) {
  // Rounding may put the path a little outside of the portal; the weights are those of a point in it.
  const double weights[3] = {std::max(side(places[1], places[2], along), 0.0),
                             std::max(side(places[2], places[0], along), 0.0),
                             std::max(side(places[0], places[1], along), 0.0)};
  const double sum = weights[0] + weights[1] + weights[2];
  if (!(sum > 0)) return PathEnd::open;
  found.simplex.size = 3;
  for (std::size_t k = 0; k < 3; ++k) found.simplex.weights[k] = weights[k] / sum;
  pair.move_to(pair.time(), found.simplex);
  found.nearest = {};
  found.nearest.distance = weighted_mean(found.simplex).difference.norm();
  found.nearest.direction = -portal_normal(places);
  return found.nearest.distance <= tolerance ? PathEnd::hit : PathEnd::open;
}

namespace {

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
  double side_of(const Corner& p, const Corner& q) const {
    return side(p.place, q.place, path_.along);
  }

  bool take_beside(const Vec3d& across, Corner& corner);
  Step discover(int most_iterations);
  Step refine(double tolerance, int most_iterations);

  MovingPair& pair_;
  PathContact& found_;
  Path path_;
  double lean_ = 1;
  Portal portal_;
};

// Takes a support point along a direction that leans from the entry across the path, or, if that point is not
// beyond the line, straight across.
template <class CoreOfA, class CoreOfB>
bool PortalSearch<CoreOfA, CoreOfB>::take_beside(const Vec3d& across, Corner& corner) {
  if (take((across + lean_ * path_.entry).normalized(), corner)) return true;
  return !(corner.place.dot(across) > 0) && take(across, corner);
}

template <class CoreOfA, class CoreOfB>
auto PortalSearch<CoreOfA, CoreOfB>::discover(int most_iterations) -> Step {
  const int most_corners = std::min(24, most_iterations);
  if (take(path_.entry, portal_[0])) return Step::miss;
  const Vec3d& first = portal_[0].place;
  Vec3d across = first.dot(path_.along) * path_.along - first;
  double length = across.norm();
  if (!(length > 0)) return Step::open;
  if (take_beside(across / length, portal_[1])) return Step::miss;
  // The edge that the line is outside of, and the corner that the next one replaces.
  std::size_t from = 0, to = 1, next = 2;
  for (int k = 0; k < most_corners; ++k) {
    across = (portal_[to].place - portal_[from].place).cross(path_.along);
    length = across.norm();
    if (!(length > 0)) return Step::open;
    length = std::copysign(length, -across.dot(portal_[from].place));
    if (take_beside(across / length, portal_[next])) return Step::miss;
    const double edges[3] = {side_of(portal_[1], portal_[2]), side_of(portal_[2], portal_[0]),
                             side_of(portal_[0], portal_[1])};
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
    if (!(length > least_area)) return Step::open;
    const Vec3d normal = cross / length;
    Corner& next = portal_.free();
    if (take(normal, next)) return Step::miss;
    const double speed = -normal.dot(path_.along);
    const double beyond = normal.dot(next.place - p.place);
    if (!(beyond > tolerance * speed) || !(beyond > MovingPair::rounding / 16)) {
      return speed > 0 ? Step::closed : Step::open;
    }
    // Of the three new portals the line passes one most clearly.
    const double of_p = side_of(next, p), of_q = side_of(next, q), of_r = side_of(next, r);
    const double over[3] = {std::min(of_q, -of_r), std::min(of_r, -of_p), std::min(of_p, -of_q)};
    std::size_t dropped = over[1] > over[0] ? 1 : 0;
    dropped = over[2] > over[dropped] ? 2 : dropped;
    portal_.replace(dropped);
  }
  return Step::open;
}

template <class CoreOfA, class CoreOfB>
PathEnd PortalSearch<CoreOfA, CoreOfB>::search(double tolerance, int most_iterations) {
  const std::optional<Path> path = path_of(pair_);
  if (!path) return PathEnd::open;
  path_ = *path;
  lean_ = lean_of(pair_);
  Step step = discover(most_iterations);
  if (step == Step::closed) step = refine(tolerance, most_iterations);
  if (step == Step::miss) return PathEnd::miss;
  if (step == Step::open) return PathEnd::open;
  for (std::size_t k = 0; k < 3; ++k) found_.simplex.points[k] = portal_[k].point;
  return meet_portal(pair_, path_.along, {portal_[0].place, portal_[1].place, portal_[2].place},
                     tolerance, found_);
}

using BoxCore = SpecialisedCore<SupportCore::box>;
using HullCore = SpecialisedCore<SupportCore::hull>;

}  // namespace

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

}  // namespace touchstone
