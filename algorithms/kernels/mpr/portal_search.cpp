// The portal search of portal_search.h.
#include "algorithms/kernels/mpr/portal_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
typename PortalSearch<Scalar>::Exit PortalSearch<Scalar>::decide(Outcome& outcome) {
  const Vec3<Scalar> inside = -pair_.centre_b();
  const bool coincident = inside.norm() <= rounding;
  start_ = {inside, Vec3<Scalar>::Zero(), pair_.centre_b()};
  ray_ = coincident ? Vec3<Scalar>::UnitX() : Vec3<Scalar>(-inside.normalized());
  Exit exit = discover(support(ray_));
  if (exit == Exit::done && !separated_) exit = refine(Goal::origin);
  outcome.status = Status::ok;
  if (separated_) {
    outcome.answer = Answer::separated;
  } else if ((exit == Exit::straight || coincident || origin_is_inside()) && depth_ > rounding) {
    outcome.answer = Answer::overlapping;
  } else {
    outcome.answer = Answer::unknown;
    outcome.status = Status::not_converged;
  }
  return exit;
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
    if (goal == Goal::origin && nearest > rounding) return Exit::done;
    const Point v4 = support(normal_);
    if (separated_) return Exit::done;
    depth_ = v4.difference.dot(normal_);
    // This form of the comparison ends the loop for NaN. Until the origin is inside, only the limit
    // of precision ends the search.
    const Scalar slack = nearest > rounding ? tolerance_ : rounding / 4;
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

// Returns true if the origin is, up to rounding, a mean of the start and the portal with
// non-negative weights.
template <class Scalar>
bool PortalSearch<Scalar>::origin_is_inside() const {
  const auto& [v1, v2, v3] = portal_;
  const Vec3<Scalar>&p0 = start_.difference, &p1 = v1.difference, &p2 = v2.difference,
        &p3 = v3.difference;
  Eigen::Matrix<Scalar, 4, 1> weight(p1.cross(p2).dot(p3), -p0.cross(p2).dot(p3),
                                     p0.cross(p1).dot(p3), -p0.cross(p1).dot(p2));
  if (weight.sum() < 0) weight = -weight;
  weight = weight.cwiseMax(Scalar{0});
  const Scalar total = weight.sum();
  if (!(total > 0)) return false;
  const Vec3<Scalar> mean = (weight[0] * p0 + weight[1] * p1 + weight[2] * p2 + weight[3] * p3);
  return mean.norm() <= rounding * total;
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
