// Minkowski portal refinement: a ray from inside the Minkowski difference C = A - B to the origin;
// a triangle of support points that it passes through is pushed outward until the origin is inside,
// or a plane has it outside.
// Paper:   Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008.
// Departs: any ray, not only one to the origin: where the centres coincide it starts along x, and
//          for a depth the ray is cast again from the origin along the portal's normal until that
//          stays, which lowers the bound each time. A hit is believed only where weights of the
//          four points give the origin up to rounding; a portal that is a sliver does not pass.
// Answers: the depth is that along the normal of the last portal, so moving b by it separates: an
//          upper bound of the penetration depth, not in general the least. `lower` is certified,
//          `upper` is 0. For a half-space the exact depth (kernels/halfspace.h).
// Fails:   says not_converged at the cap, and where rounding hides on which side of C the origin
//          is; flat and very thin differences end there sooner (plates of 1:1e8 at gaps of 1e-6).
// Cost:    a support call an iteration; few iterations for polytopes, and a hundred or more for the
//          depth of curved shapes.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "algorithms/kernels/halfspace.h"
#include "algorithms/kernels/support.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {
namespace {

// One query on two bounded bodies.
template <class Scalar>
class PortalSearch {
 public:
  PortalSearch(SupportPair<Scalar>& pair, int max_iterations, Scalar tolerance)
      : pair_(pair), max_iterations_(max_iterations), tolerance_(tolerance) {}

  void solve(Task task, Outcome& outcome) {
    const Vec3<Scalar> inside = -pair_.centre_b();
    const bool coincident = inside.norm() <= rounding;
    const Point start{inside, Vec3<Scalar>::Zero(), pair_.centre_b()};
    const Vec3<Scalar> ray =
        coincident ? Vec3<Scalar>::UnitX() : Vec3<Scalar>(-inside.normalized());
    const Exit exit = search(start, ray, Goal::verdict);
    if (separated_) {
      outcome.answer = Answer::separated;
      outcome.status = Status::ok;
    } else if ((exit == Exit::straight || coincident || origin_is_inside()) && depth_ > rounding) {
      outcome.answer = Answer::overlapping;
      outcome.status = Status::ok;
      if (task == Task::penetration) find_depth(exit, outcome);
    } else {
      outcome.answer = Answer::unknown;
      outcome.status = Status::not_converged;
    }
    outcome.iterations = iterations_;
    outcome.support_calls = pair_.support_calls();
  }

 private:
  using Point = DifferencePoint<Scalar>;
  enum class Goal : std::uint8_t { verdict, surface };
  enum class Exit : std::uint8_t { done, straight, capped, stuck };
  static constexpr Scalar rounding = SupportPair<Scalar>::rounding;

  // Of the bodies with their radii; the direction has unit length.
  Point support(const Vec3<Scalar>& direction) {
    Point point = pair_.support(direction);
    point.a += pair_.radius_a() * direction;
    point.b -= pair_.radius_b() * direction;
    point.difference += pair_.radius() * direction;
    // All of C is on the other side of this plane.
    if (point.difference.dot(direction) < -rounding) separated_ = true;
    return point;
  }

  Vec3<Scalar> from_start(const Point& point) const { return point.difference - start_.difference; }
  // Positive where the ray passes the plane of start, p and q on its positive side.
  Scalar side(const Point& p, const Point& q) const {
    return from_start(p).cross(from_start(q)).dot(ray_);
  }

  // Finds a portal for the ray and pushes it outward: up to the origin (verdict) or to the surface.
  // Ends at once where a support plane separates.
  Exit search(const Point& start, const Vec3<Scalar>& ray, Goal goal) {
    start_ = start;
    ray_ = ray;
    const Exit found = discover();
    return found != Exit::done || separated_ ? found : refine(goal);
  }

  // Three support points around the ray, anticlockwise as seen against it.
  Exit discover() {
    auto& [v1, v2, v3] = portal_;
    v1 = support(ray_);
    if (separated_) return Exit::done;
    Vec3<Scalar> normal = ray_.cross(from_start(v1));
    if (!(normal.norm() > rounding * from_start(v1).norm())) {
      // The ray leaves C in the point that lies furthest along it.
      v2 = v3 = v1;
      normal_ = ray_;
      depth_ = v1.difference.dot(ray_);
      return Exit::straight;
    }
    v2 = support(normal.normalized());
    if (separated_) return Exit::done;
    if (side(v1, v2) < 0) std::swap(v1, v2);
    for (int loop = 0; loop < max_iterations_; ++loop) {
      ++iterations_;
      const Vec3<Scalar> w1 = from_start(v1), w2 = from_start(v2);
      normal = w1.cross(w2);
      // All in line with the start: what of the ray is across them.
      const bool in_line = !(normal.norm() > rounding * w1.norm() * w2.norm());
      if (in_line) normal = ray_;
      // Almost in line, the product is not across the first any more.
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

  Exit refine(Goal goal) {
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
      if (goal == Goal::verdict && nearest > rounding) return Exit::done;
      const Point v4 = support(normal_);
      if (separated_) return Exit::done;
      depth_ = v4.difference.dot(normal_);
      // Written so that NaN ends the loop. Before the origin is inside, only the end of the
      // precision stops the search.
      const Scalar slack = nearest > rounding ? tolerance_ : rounding / 4;
      if (!(depth_ - nearest > slack)) return Exit::done;
      // Of the three portals that v4 makes with two of the old corners, the one that the ray passes
      // most clearly: signs alone are noise where it passes a corner.
      const Scalar of_1 = side(v4, v1), of_2 = side(v4, v2), of_3 = side(v4, v3);
      const Scalar over_12 = std::min(of_1, -of_2), over_23 = std::min(of_2, -of_3),
                   over_31 = std::min(of_3, -of_1);
      Point& dropped = over_12 >= over_23 && over_12 >= over_31 ? v3 : over_23 >= over_31 ? v1 : v2;
      dropped = v4;
    }
    return Exit::capped;
  }

  // The origin is, up to rounding, a mean with weights >= 0 of the start and the portal.
  bool origin_is_inside() const {
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

  // The point where the ray passes the portal, as points of the two bodies.
  Point passage() const {
    const auto& [v1, v2, v3] = portal_;
    Vec3<Scalar> weight =
        Vec3<Scalar>(side(v2, v3), side(v3, v1), side(v1, v2)).cwiseMax(Scalar{0});
    const Scalar total = weight.sum();
    weight = total > 0 ? Vec3<Scalar>(weight / total) : Vec3<Scalar>::Constant(Scalar{1} / 3);
    const auto mean = [&](auto part) {
      return Vec3<Scalar>(weight[0] * part(v1) + weight[1] * part(v2) + weight[2] * part(v3));
    };
    return {mean([](const Point& p) { return p.difference; }),
            mean([](const Point& p) { return p.a; }), mean([](const Point& p) { return p.b; })};
  }

  // The origin is inside: casts rays from it along the normal of the last portal, each portal being
  // nearer than the one before, until the passage lies along the normal.
  void find_depth(Exit exit, Outcome& outcome) {
    bool settled = exit == Exit::straight;
    if (!settled) exit = refine(Goal::surface);
    const Point origin{Vec3<Scalar>::Zero(), Vec3<Scalar>::Zero(), Vec3<Scalar>::Zero()};
    Vec3<Scalar> normal = normal_;
    Scalar depth = depth_;
    for (int loop = 0; loop < max_iterations_ && exit == Exit::done && !settled; ++loop) {
      exit = search(origin, normal, Goal::surface);
      settled = exit == Exit::straight || !(depth_ < depth - tolerance_);
      if (depth_ < depth) {
        depth = depth_;
        normal = normal_;
      }
    }
    outcome.distance = -pair_.unit() * static_cast<double>(depth);
    outcome.lower = -pair_.unit() * static_cast<double>(depth + rounding);
    outcome.upper = 0;
    outcome.normal = normal.template cast<double>().normalized();
    if (!settled) {
      outcome.status = Status::not_converged;
      return;
    }
    const Point point = passage();
    outcome.witness_a = pair_.to_world(point.a);
    outcome.witness_b = pair_.to_world(point.b);
  }

  SupportPair<Scalar>& pair_;
  int max_iterations_;
  Scalar tolerance_;
  Point start_;
  Vec3<Scalar> ray_;
  std::array<Point, 3> portal_;
  // Of the last portal: its outward normal, and how far C reaches along it.
  Vec3<Scalar> normal_ = Vec3<Scalar>::Zero();
  Scalar depth_ = 0;
  bool separated_ = false;
  int iterations_ = 0;
};

template <class Scalar>
class Mpr final : public NarrowPhase {
 public:
  explicit Mpr(const NarrowPhaseSettings& settings)
      : max_iterations_(settings.max_iterations.value_or(256)),
        tolerance_(std::max(static_cast<Scalar>(settings.tolerance.value_or(default_tolerance)),
                            4 * SupportPair<Scalar>::rounding)) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<Scalar>(shapes);
  }

  void solve(const PairBatch& batch, std::span<Outcome> outcomes) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
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
        PortalSearch<Scalar>(pair, max_iterations_, tolerance_).solve(batch.task, outcomes[i]);
      }
    }
  }

 private:
  // On a curved surface a portal as narrow as the root of this still has a normal.
  static constexpr double default_tolerance = 1e-10;

  int max_iterations_;
  Scalar tolerance_;  // in units of the pair
  std::vector<SupportShape<Scalar>> shapes_;
};

}  // namespace
}  // namespace touchstone

TOUCHSTONE_NARROW_PHASE {
  using namespace touchstone;
  return {{.info = {.name = "mpr",
                    .citation = "Snethen, XenoCollide: Complex Collision Made Simple, Game "
                                "Programming Gems 7, 2008"},
           .tasks = {Task::intersect, Task::penetration},
           .scalars = {Precision::float32, Precision::float64},
           .depth_is_bound = true,
           .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
             if (settings.scalar == Precision::float32)
               return std::make_unique<Mpr<float>>(settings);
             return std::make_unique<Mpr<double>>(settings);
           }}};
}
