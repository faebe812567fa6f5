// The portal search of portal_search.h.
#include "algorithms/kernels/mpr/portal_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algorithms/kernels/gjk/gjk_iteration.h"
#include "algorithms/kernels/minkowski/resolution.h"
#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

template <class Scalar>
DifferencePoint<Scalar> PortalSearch<Scalar>::support(const Vec3<Scalar>& direction) {
  Point point = pair_.support(direction);
  point.a += pair_.radius_a() * direction;
  point.b -= pair_.radius_b() * direction;
  point.difference += pair_.radius() * direction;
  if (point.difference.dot(direction) < -rounding) {
    separated_ = true;
    normal_ = direction;
  }
  return point;
}

template <class Scalar>
typename PortalSearch<Scalar>::Exit PortalSearch<Scalar>::decide(Task task, Outcome& outcome) {
  start_ = {-pair_.centre_b(), Vec3<Scalar>::Zero(), pair_.centre_b()};
  outcome.answer = Answer::unknown;
  outcome.status = Status::not_converged;
  Exit exit = Exit::stuck;
  for (int attempt = 0; attempt < most_starts; ++attempt) {
    const Vec3<Scalar> inside = start_.difference;
    const bool coincident = inside.norm() <= rounding;
    ray_ = coincident ? Vec3<Scalar>::UnitX() : Vec3<Scalar>(-inside.normalized());
    exit = discover(support(ray_));
    if (exit == Exit::done && !separated_) exit = refine(Goal::origin);
    if (separated_) {
      outcome.answer = Answer::separated;
      outcome.status = Status::ok;
      return exit;
    }
    if (exit == Exit::stuck) break;
    if (depth_ > rounding && origin_is_surely_inside(exit)) {
      outcome.answer = Answer::overlapping;
      outcome.status = Status::ok;
      return exit;
    }
    if (is_touching(exit, task, outcome)) return exit;
    move_start();
  }
  clear_numbers(outcome);
  return exit;
}

// Writes `touching` and returns true if the bounds on the signed distance are near enough: from
// below that of a support plane along the normal, from above that of the start or the portal.
template <class Scalar>
bool PortalSearch<Scalar>::is_touching(Exit exit, Task task, Outcome& outcome) {
  Simplex<Scalar> near;
  near.size = exit == Exit::straight ? 1 : 3;
  std::ranges::copy(portal_, near.points.begin());
  Scalar off = reduce_to_nearest(near).distance;
  if (start_.difference.norm() < off) {
    off = start_.difference.norm();
    near = {};
    near.size = 1;
    near.points[0] = start_;
    near.weights[0] = 1;
  }
  if (!(off <= 4 * rounding) || normal_.isZero(0)) return false;
  const Scalar height = support(normal_).difference.dot(normal_);
  const double unit = pair_.unit();
  if (!write_if_touching(-unit * static_cast<double>(std::max(height, Scalar{0}) + rounding),
                         unit * static_cast<double>(off + rounding), unit * resolution<Scalar>,
                         outcome)) {
    return false;
  }
  if (task == Task::intersect) return true;
  outcome.distance = (outcome.lower + outcome.upper) / 2;
  outcome.normal = normal_.template cast<double>().normalized();
  const Point nearest = weighted_mean(near);
  outcome.witness_a = pair_.to_world(nearest.a);
  outcome.witness_b = pair_.to_world(nearest.b);
  return true;
}

// Moves the start inside of C, so that the ray no longer passes an edge or a corner of the portal.
// Three parts that differ make it unlikely that the new one does, even where C is symmetric.
template <class Scalar>
void PortalSearch<Scalar>::move_start() {
  const Vec3<Scalar> side = ray_.unitOrthogonal();
  const auto move = [&](double share, const Vec3<Scalar>& direction) {
    const Point to = pair_.support(direction);
    const auto part = static_cast<Scalar>(share);
    start_.difference += part * (to.difference - start_.difference);
    start_.a += part * (to.a - start_.a);
    start_.b += part * (to.b - start_.b);
  };
  move(0.28, side);
  move(0.17, ray_.cross(side));
  move(0.07, -ray_);
}

// Returns true if the start and the portal contain the origin whatever rounding did to them. Where
// the ray leaves C at a single point, they do so if the ball around the start, which is as large as
// the radii, reaches far enough.
template <class Scalar>
bool PortalSearch<Scalar>::origin_is_surely_inside(Exit exit) const {
  if (exit == Exit::straight) {
    const Scalar length = from_start(portal_[0]).norm();
    return depth_ * pair_.radius() > 4 * rounding * (length + pair_.radius());
  }
  Simplex<Scalar> simplex;
  simplex.size = 4;
  simplex.points = {portal_[0], portal_[1], portal_[2], start_};
  return is_surely_inside(simplex);
}

template <class Scalar>
typename PortalSearch<Scalar>::Depth PortalSearch<Scalar>::settle_from_portal() {
  const Exit exit = refine(Goal::surface);
  const Depth reached{depth_, normal_, false};
  return exit == Exit::done && !separated_ ? settle(reached) : reached;
}

template <class Scalar>
typename PortalSearch<Scalar>::Depth PortalSearch<Scalar>::settle(Depth from) {
  start_ = {Vec3<Scalar>::Zero(), Vec3<Scalar>::Zero(), Vec3<Scalar>::Zero()};
  // Portals on a curved surface are too narrow to turn over their edges.
  const bool flat = pair_.is_polytope() && pair_.radius() == 0;
  Depth least = from;
  Vec3<Scalar> ray = from.normal;
  for (int loop = 0; loop < max_iterations_; ++loop) {
    if (flat && is_portal_of(ray)) {
      // The portal is on the surface and contains the projection of the origin on its own plane.
      least.settled = ray == normal_ && depth_ == least.depth;
      if (least.settled) break;
    } else {
      const Exit exit = flat ? turn() : cast(ray, support(ray));
      if (separated_ || (exit != Exit::done && exit != Exit::straight)) break;
      if (exit == Exit::straight) return {std::min(depth_, least.depth), ray, true};
    }
    if (refine(Goal::surface) != Exit::done || separated_) break;
    least.settled = !(depth_ < least.depth - tolerance_);
    if (depth_ < least.depth) {
      least.depth = depth_;
      least.normal = normal_;
    }
    if (least.settled) break;
    ray = normal_;
  }
  return least;
}

template <class Scalar>
typename PortalSearch<Scalar>::Exit PortalSearch<Scalar>::cast(const Vec3<Scalar>& ray,
                                                               const Point& furthest) {
  start_ = {Vec3<Scalar>::Zero(), Vec3<Scalar>::Zero(), Vec3<Scalar>::Zero()};
  ray_ = ray;
  return discover(furthest);
}

// Starts with support points in directions beside the ray: for a flat face they are its corners.
template <class Scalar>
typename PortalSearch<Scalar>::Exit PortalSearch<Scalar>::cast_along_normal(const Vec3<Scalar>& ray,
                                                                            const Point& furthest) {
  constexpr Scalar tilt = Scalar{0.0625};
  const Vec3<Scalar> side = tilt * ray.unitOrthogonal();
  const Vec3<Scalar> back = Scalar{-0.5} * side;
  const Vec3<Scalar> across = std::sqrt(Scalar{3}) / 2 * ray.cross(side);
  const auto& [v1, v2, v3] =
      portal_ = {support((ray + side).normalized()), support((ray + back + across).normalized()),
                 support((ray + back - across).normalized())};
  const Vec3<Scalar> normal = (v2.difference - v1.difference).cross(v3.difference - v1.difference);
  const bool has_area = normal.dot(ray) > rounding;
  return has_area ? Exit::done : cast(ray, furthest);
}

template <class Scalar>
typename PortalSearch<Scalar>::Exit PortalSearch<Scalar>::discover(const Point& furthest) {
  auto& [v1, v2, v3] = portal_;
  v1 = furthest;
  if (separated_) return Exit::done;
  const Vec3<Scalar> normal = ray_.cross(from_start(v1));
  if (!(normal.norm() > rounding * from_start(v1).norm())) {
    v2 = v3 = v1;
    normal_ = ray_;
    depth_ = v1.difference.dot(ray_);
    return Exit::straight;
  }
  v2 = support(normal.normalized());
  if (separated_) return Exit::done;
  if (side(v1, v2) < 0) std::swap(v1, v2);
  return close();
}

// Finds the third point and may replace the first two on the way. The ray is on the positive side
// of the plane through start, first and second.
template <class Scalar>
typename PortalSearch<Scalar>::Exit PortalSearch<Scalar>::close() {
  auto& [v1, v2, v3] = portal_;
  for (int loop = 0; loop < max_iterations_; ++loop) {
    ++iterations_;
    const Vec3<Scalar> w1 = from_start(v1), w2 = from_start(v2);
    Vec3<Scalar> normal = w1.cross(w2);
    // All points are in line with the start: the ray's component across that line is used.
    const bool in_line = !(normal.norm() > rounding * w1.norm() * w2.norm());
    if (in_line) normal = ray_;
    // If they are almost in line, the cross product is no longer perpendicular to the first point.
    normal -= normal.dot(w1) / w1.squaredNorm() * w1;
    if (!(normal.squaredNorm() > 0)) return Exit::stuck;
    v3 = support(normal.normalized());
    if (separated_) return Exit::done;
    if (side(v1, v3) > 0) {
      v2 = v3;
    } else if (side(v3, v2) > 0) {
      v1 = v3;
    } else {
      return Exit::done;
    }
  }
  return Exit::capped;
}

template <class Scalar>
bool PortalSearch<Scalar>::is_portal_of(const Vec3<Scalar>& ray) {
  const auto& [v1, v2, v3] = portal_;
  ray_ = ray;
  return side(v1, v2) >= 0 && side(v2, v3) >= 0 && side(v3, v1) >= 0;
}

// Changes the portal to one of a new ray from the same start that the old one does not contain.
template <class Scalar>
typename PortalSearch<Scalar>::Exit PortalSearch<Scalar>::turn() {
  auto& [v1, v2, v3] = portal_;
  const Scalar of_12 = side(v1, v2), of_23 = side(v2, v3), of_31 = side(v3, v1);
  const Scalar least = std::min({of_12, of_23, of_31});
  // The edge that the ray is beyond, reversed.
  if (least == of_12) {
    std::swap(v1, v2);
  } else if (least == of_23) {
    v1 = v3;
  } else {
    v2 = v3;
  }
  return close();
}

template <class Scalar>
typename PortalSearch<Scalar>::Exit PortalSearch<Scalar>::refine(Goal goal) {
  constexpr Scalar clearly = 16 * rounding;
  auto& [v1, v2, v3] = portal_;
  for (int loop = 0; loop < max_iterations_; ++loop) {
    ++iterations_;
    const Vec3<Scalar> normal =
        (v2.difference - v1.difference).cross(v3.difference - v1.difference);
    const Scalar length = normal.norm();
    if (!(length > 0)) return Exit::stuck;
    normal_ = normal / length;
    const Scalar nearest = std::min(
        {v1.difference.dot(normal_), v2.difference.dot(normal_), v3.difference.dot(normal_)});
    depth_ = nearest;
    if (goal == Goal::origin && nearest > clearly) return Exit::done;
    const Point v4 = support(normal_);
    if (separated_) return Exit::done;
    depth_ = v4.difference.dot(normal_);
    // This form of the comparison ends the loop for NaN. Until the origin is clearly inside, only the
    // limit of precision ends the search.
    const Scalar slack = nearest > clearly ? tolerance_ : rounding / 4;
    if (!(depth_ - nearest > slack)) return Exit::done;
    // The point v4 makes three portals with two old corners each. The search keeps the one that the
    // ray passes most clearly; signs alone are noise if the ray passes a corner.
    const Scalar of_1 = side(v4, v1), of_2 = side(v4, v2), of_3 = side(v4, v3);
    const Scalar over_12 = std::min(of_1, -of_2), over_23 = std::min(of_2, -of_3),
                 over_31 = std::min(of_3, -of_1);
    Point& dropped = over_12 >= over_23 && over_12 >= over_31 ? v3 : over_23 >= over_31 ? v1 : v2;
    dropped = v4;
  }
  return Exit::capped;
}

template <class Scalar>
DifferencePoint<Scalar> PortalSearch<Scalar>::passage() const {
  const auto& [v1, v2, v3] = portal_;
  Vec3<Scalar> weight = Vec3<Scalar>(side(v2, v3), side(v3, v1), side(v1, v2)).cwiseMax(Scalar{0});
  const Scalar total = weight.sum();
  weight = total > 0 ? Vec3<Scalar>(weight / total) : Vec3<Scalar>::Constant(Scalar{1} / 3);
  const auto mean = [&](auto part) {
    return Vec3<Scalar>(weight[0] * part(v1) + weight[1] * part(v2) + weight[2] * part(v3));
  };
  return {mean([](const Point& p) { return p.difference; }),
          mean([](const Point& p) { return p.a; }), mean([](const Point& p) { return p.b; })};
}

template class PortalSearch<float>;
template class PortalSearch<double>;

}  // namespace touchstone
