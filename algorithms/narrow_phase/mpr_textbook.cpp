// Minkowski portal refinement (MPR, XenoCollide) as it stands in the textbook: a ray from inside the difference C = A - B through
// the origin leaves C by a portal, a triangle of support points, that is pushed outward.
// Paper:   Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008.
// Steps:   1. v0 is a point inside C. The origin ray goes from v0 to the origin, and on.
//          2. Discover a portal: three support points v1, v2, v3 such that the ray passes through their triangle. A point that
//             misses the ray is replaced by the support point across the side by which it does.
//          3. Refine it: take the support point v4 along the portal's normal. If v4 is behind the origin, its plane separates.
//             If the portal is beyond the origin, the bodies overlap.
//          4. Otherwise v4 and two of the three make the next portal: the ray is on one side of each of the three planes
//             through v0, v4 and a corner.
//          5. For a depth go on until the surface of C is the portal, to the tolerance. The depth is that along its normal.
// Departs: v0 is inside C beside its centre, so that the ray seldom passes through an edge where bodies are aligned. Overlap is
//          said only if the origin is inside the tetrahedron of v0 and the portal by more than rounding.
// Answers: the depth is that along the normal of the last portal. Moving b by it separates, so it is an upper bound, and in
//          general not the least. `lower` is certified; `upper` is 0. No witness points: the paper has one point of contact, where
//          the ray passes the portal. `touching` within bounds that are at most 6e-14 of the size apart.
// Fails:   not_converged at the cap of iterations and where rounding ends the search, as at slivers; degenerate if a portal has
//          no area. Does not take half-spaces.
// Cost:    a support call for each iteration; few for polytopes, a hundred or more for the depth of curved bodies. O(1) space.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "algorithms/kernels/textbook/contact.h"
#include "algorithms/kernels/textbook/difference.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {
namespace {

template <class Weight>
Vec3d mean(const Hull& hull, const Weight& weight) {
  Vec3d sum = Vec3d::Zero();
  double weights = 0;
  for (std::size_t k = 0; k < hull.vertices.size(); ++k) {
    sum += weight(k) * (hull.vertices[k] - hull.vertices[0]);
    weights += weight(k);
  }
  return hull.vertices[0] + sum / weights;
}

// A point inside a body, in body coordinates, beside its centre.
Vec3d point_inside(const Shape& shape) {
  if (shape.kind != ShapeKind::hull) {
    const Vec3d round(shape.radius, shape.radius, shape.half_length);
    Vec3d extents = round;
    if (shape.kind == ShapeKind::sphere) extents = Vec3d::Constant(shape.radius);
    if (shape.kind == ShapeKind::box) extents = shape.half_extents;
    if (shape.kind == ShapeKind::ellipsoid) extents = shape.radii;
    return extents.cwiseProduct(Vec3d(0.031, 0.047, 0.073));
  }
  // A mean of the vertices with unequal weights.
  return mean(*shape.hull,
              [](std::size_t k) { return 1 + std::fmod(0.618034 * static_cast<double>(k), 1.0); });
}

Vec3d centre(const Shape& shape) {
  return shape.kind == ShapeKind::hull ? mean(*shape.hull, [](std::size_t) { return 1.0; })
                                       : Vec3d(0, 0, 0);
}

class MprTextbook final : public NarrowPhase {
 public:
  explicit MprTextbook(const NarrowPhaseSettings& settings)
      : max_iterations_(settings.max_iterations.value_or(256)),
        tolerance_(settings.tolerance.value_or(1e-10)) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = textbook::bind_shapes(shapes);
    inside_.clear();
    centres_.clear();
    for (const Shape& shape : shapes) {
      inside_.push_back(shape.kind == ShapeKind::halfspace ? Vec3d::Zero() : point_inside(shape));
      centres_.push_back(centre(shape));
    }
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    const BodyPairs& pairs = batch.pairs;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t a = pairs.first[i], b = pairs.second[i];
      const std::uint32_t shape_a = pairs.shape_of[a], shape_b = pairs.shape_of[b];
      const Pose &pose_a = pairs.poses[a], &pose_b = pairs.poses[b];
      textbook::Difference c(shapes_[shape_a], pose_a, shapes_[shape_b], pose_b);
      outcomes[i] = {.status = Status::degenerate};
      if (!c.is_finite()) continue;
      const Vec3d v0 =
          c.origins() +
          (pose_a.rotation * inside_[shape_a] - pose_b.rotation * centres_[shape_b]) / c.unit();
      solve_pair(c, v0, task == Task::penetration, outcomes[i]);
      outcomes[i].support_calls = c.support_calls();
    }
  }

 private:
  // Returns true, and writes it, if the plane through the support point across a direction leaves the origin outside. Keeps
  // the least height of such planes otherwise: the bodies overlap by no more.
  struct Planes {
    const textbook::Difference& c;
    Outcome& outcome;
    double least = std::numeric_limits<double>::infinity();

    bool separate(const Vec3d& point, const Vec3d& direction) {
      const double height = point.dot(direction) / direction.norm();
      if (height < -c.rounding()) {
        outcome.answer = Answer::separated;
        outcome.status = Status::ok;
        return true;
      }
      least = std::min(least, height);
      return false;
    }
  };

  void solve_pair(textbook::Difference& c, const Vec3d& v0, bool wants_depth,
                  Outcome& outcome) const {
    outcome.iterations = 0;
    const auto support = [&](const Vec3d& direction) { return c.support(direction).w; };
    Planes planes{c, outcome};
    if (v0.norm() <= c.rounding()) return;
    // Portal discovery.
    Vec3d v1 = support(-v0);
    if (planes.separate(v1, -v0)) return;
    Vec3d normal = v1.cross(v0);
    if (normal.norm() <= 4 * c.rounding() * v0.norm()) {
      if (is_enclosed_beside_ray(c, v0, v1))
        return write_depth(c, -v1.dot(v0.normalized()), -v0.normalized(), outcome);
      normal = v0.unitOrthogonal();
    }
    Vec3d v2 = support(normal);
    if (planes.separate(v2, normal)) return;
    normal = (v1 - v0).cross(v2 - v0);
    if (normal.dot(v0) > 0) {
      std::swap(v1, v2);
      normal = -normal;
    }
    Vec3d v3 = Vec3d::Zero();
    for (;; ++outcome.iterations) {
      if (!(normal.squaredNorm() > 0)) return;
      if (outcome.iterations == max_iterations_) return give_up(outcome);
      v3 = support(normal);
      if (planes.separate(v3, normal)) return;
      if (v1.cross(v3).dot(v0) < 0) {
        v2 = v3;  // the origin is outside of the plane through v0, v1, v3
      } else if (v3.cross(v2).dot(v0) < 0) {
        v1 = v3;
      } else {
        break;
      }
      normal = (v1 - v0).cross(v2 - v0);
    }
    // Portal refinement.
    bool is_enclosed = false;  // once the origin is, the bodies overlap whatever the later portals
    for (;; ++outcome.iterations) {
      normal = (v2 - v1).cross(v3 - v1);
      if (!(normal.squaredNorm() > 0)) return;
      normal.normalize();
      is_enclosed = is_enclosed || textbook::encloses_origin({v0, v1, v2, v3}, c.rounding());
      if (is_enclosed && !wants_depth) return textbook::write_overlapping(outcome);
      const Vec3d v4 = support(normal);
      if (planes.separate(v4, normal)) return;
      const double height = normal.dot(v4), beyond = height - normal.dot(v1);
      const bool is_surface = beyond <= (is_enclosed ? tolerance_ : 0) + 2 * c.rounding();
      if (is_surface && is_enclosed) return write_depth(c, height, normal, outcome);
      if (is_surface) {
        // The ray passes the portal at this part of v0.
        const double part = normal.dot(v1) / normal.dot(v0);
        const double upper = std::abs(part) * v0.norm() + c.rounding();
        textbook::write_undecided(c, -(std::max(planes.least, 0.0) + c.rounding()), upper, outcome);
        return;
      }
      if (outcome.iterations >= max_iterations_) return give_up(outcome);
      const Vec3d across = v4.cross(v0);
      if (across.dot(v1) > 0) {
        (across.dot(v2) > 0 ? v1 : v3) = v4;
      } else {
        (across.dot(v3) > 0 ? v2 : v1) = v4;
      }
    }
  }

  // Whether the origin, which is between v0 and v1, is inside the tetrahedron of v1 and three support points around the ray.
  static bool is_enclosed_beside_ray(textbook::Difference& c, const Vec3d& v0, const Vec3d& v1) {
    const Vec3d back = v0.normalized(), u = back.unitOrthogonal(), w = back.cross(u);
    const auto support = [&](double x, double y) { return c.support(back + x * u + y * w).w; };
    return textbook::encloses_origin({v1, support(1, 0), support(-0.5, 0.9), support(-0.5, -0.9)},
                                     c.rounding());
  }

  static void give_up(Outcome& outcome) { outcome.status = Status::not_converged; }

  static void write_depth(const textbook::Difference& c, double height, const Vec3d& normal,
                          Outcome& outcome) {
    textbook::write_overlapping(outcome);
    outcome.distance = -c.unit() * height;
    outcome.lower = -c.unit() * (height + c.rounding());
    outcome.upper = 0;
    outcome.normal = normal;
  }

  int max_iterations_;
  double tolerance_;  // in the unit of C
  std::vector<textbook::BoundShape> shapes_;
  std::vector<Vec3d> inside_, centres_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_mpr_textbook() {
  return {{.info = {.name = "mpr-textbook",
                    .citation = "Snethen, XenoCollide: Complex Collision Made Simple, Game "
                                "Programming Gems 7, 2008, as "
                                "published"},
           .tasks = {Task::intersect, Task::penetration},
           .scalars = {Precision::float64},
           .supports = textbook::are_bounded,
           .traits = {.depth_is_bound = true},
           .tolerance = "how far the surface is beyond the portal, along its normal; 1e-10: no "
                        "error of the depth, which is "
                        "an upper bound",
           .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
             return std::make_unique<MprTextbook>(settings);
           }}};
}

}  // namespace touchstone::entries
