// The expanding polytope algorithm (EPA) as it stands in the textbook: GJK finds a simplex about the origin in the difference
// C = A - B, and a polytope that begins as this simplex grows to the surface of C where that is nearest.
// Paper:   van den Bergen, "Proximity Queries and Penetration Depth Computation on 3D Game Objects", Game Developers Conference
//          2001; the simplex is that of Gilbert, Johnson, Keerthi, 1988.
// Steps:   1. GJK: add the support point in the direction -v to the simplex, where v is its nearest point to the origin, and
//             keep the smallest face that has v. Stop if a support plane separates, or if the origin is at v.
//          2. Give a simplex of fewer than four points the support points across it that are furthest away.
//          3. Take the face of the polytope whose plane is nearest to the origin, and the support point w along its normal.
//          4. If w is on the plane, to the tolerance, the face is on the surface of C: its distance is the depth.
//          5. Otherwise remove all faces that w is in front of, and join w with the edges around the hole. Go on with step 3.
//          6. The projection of the origin on the last face has weights; applied to the points of A and of B, they give the
//             witness points.
// Departs: the polytope need not hold the origin at first: a plane that has the origin in front counts as nearer than those
//          behind, so that the polytope grows over the origin or a support plane separates it. The paper goes on from a simplex
//          on the origin by cases.
// Answers: the depth is that of the support plane at the last face, and `upper` comes from the face: certified bounds, which
//          meet to the tolerance. `touching` within bounds that are at most 6e-14 of the size apart.
// Fails:   not_converged at the cap of iterations, as for bodies that are round and deep in each other, with the verdict and
//          bounds that are known; where rounding spoils a face or the edges around a hole; degenerate if C is flat. Does not take
//          half-spaces.
// Cost:    O(n^2) time for n iterations, each with a support call and a look at all faces; O(n) memory.
#include <algorithm>
#include <array>
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

using textbook::Difference;
using textbook::SupportPoint;
using Points = std::vector<SupportPoint>;
using Edge = std::pair<std::size_t, std::size_t>;

// Returns the nearest point of a simplex to the origin, and keeps the smallest face that has it.
Vec3d keep_nearest_face(Points& simplex) {
  Points best;
  Vec3d nearest = Vec3d::Zero();
  for (unsigned face = 1; face < 1U << simplex.size(); ++face) {
    Points kept;
    Mat3d sides = Mat3d::Zero();
    for (std::size_t i = 0; i < simplex.size(); ++i) {
      if ((face >> i & 1U) == 0) continue;
      if (!kept.empty()) sides.col(static_cast<int>(kept.size()) - 1) = simplex[i].w - kept[0].w;
      kept.push_back(simplex[i]);
    }
    const Vec3d weights = sides.completeOrthogonalDecomposition().solve(-kept[0].w);
    const auto given = weights.head(static_cast<int>(kept.size()) - 1);
    const Vec3d v = kept[0].w + sides * weights;
    const bool is_inside = weights.sum() < 1 && (given.array() > 0).all();
    if (!is_inside || (!best.empty() && !(v.squaredNorm() < nearest.squaredNorm()))) continue;
    best = kept;
    nearest = v;
  }
  simplex = best;
  return nearest;
}

// A triangle of points of C, anticlockwise seen from outside.
struct Face {
  std::array<std::size_t, 3> corners;
  Vec3d normal;
  double distance;  // from the origin to its plane, along the normal
  double doubt;     // the rounding error of the distance; infinite if there is no area
};

class ExpandingPolytope {
 public:
  ExpandingPolytope(Points tetrahedron, double rounding)
      : points_(std::move(tetrahedron)), rounding_(rounding) {
    const Vec3d& p = points_[0].w;
    if ((points_[1].w - p).cross(points_[2].w - p).dot(points_[3].w - p) > 0)
      std::swap(points_[1], points_[2]);
    for (const auto& [i, j, k] : {std::array{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}})
      add_face(i, j, k);
  }

  // Returns the face whose plane is nearest to the origin. Faces may share a plane: of those within `slack` of the nearest
  // it is the one that has the nearest point.
  Face nearest_face(double slack) const {
    const double least = std::ranges::min_element(faces_, {}, &Face::distance)->distance;
    return *std::ranges::min_element(faces_, {}, [&](const Face& face) {
      if (!(face.distance <= least + slack)) return std::numeric_limits<double>::infinity();
      return combine(face, weights(face), &SupportPoint::w).norm();
    });
  }

  // The radius of a ball about the origin that is in C whatever the rounding; below zero if there is none. A closed surface
  // whose faces all have the origin behind them encloses it.
  double inside() const {
    double radius = std::numeric_limits<double>::infinity();
    for (const Face& face : faces_) radius = std::min(radius, face.distance - face.doubt);
    return radius;
  }

  // Grows the polytope by a point. Returns false if the edges around the hole make no closed line.
  bool expand(const SupportPoint& w) {
    std::vector<Edge> horizon;
    std::erase_if(faces_, [&](const Face& face) {
      if (!(face.normal.dot(w.w) > face.distance + rounding_)) return false;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t tail = face.corners[k], head = face.corners[(k + 1) % 3];
        // An edge between two removed faces is no edge of the hole.
        if (std::erase(horizon, Edge(head, tail)) == 0) horizon.emplace_back(tail, head);
      }
      return true;
    });
    points_.push_back(w);
    for (const auto& [tail, head] : horizon) {
      if (std::ranges::count(horizon, tail, &Edge::first) != 1) return false;
      add_face(tail, head, points_.size() - 1);
    }
    return true;
  }

  // The weights of the origin's projection on a face, none below zero.
  Vec3d weights(const Face& face) const {
    const Vec3d projection = face.distance * face.normal;
    Vec3d parts;
    for (int k = 0; k < 3; ++k) {
      const Vec3d &next = corner(face, (k + 1) % 3).w, &last = corner(face, (k + 2) % 3).w;
      parts[k] = std::max(0.0, (next - projection).cross(last - projection).dot(face.normal));
    }
    return parts / parts.sum();
  }
  Vec3d combine(const Face& face, const Vec3d& weights, Vec3d SupportPoint::*part) const {
    return weights[0] * (corner(face, 0).*part) + weights[1] * (corner(face, 1).*part) +
           weights[2] * (corner(face, 2).*part);
  }

 private:
  const SupportPoint& corner(const Face& face, int k) const {
    return points_[face.corners[static_cast<std::size_t>(k)]];
  }

  void add_face(std::size_t i, std::size_t j, std::size_t k) {
    const Vec3d side = points_[j].w - points_[i].w, other = points_[k].w - points_[i].w;
    const Vec3d area = side.cross(other);
    // The error of a normal grows as its two sides become parallel.
    const double doubt = rounding_ * (3 + side.norm() * other.norm() / area.norm());
    const Vec3d normal = area.normalized();
    faces_.push_back({{i, j, k}, normal, normal.dot(points_[i].w), doubt});
  }

  Points points_;
  double rounding_;
  std::vector<Face> faces_;
};

class EpaTextbook final : public NarrowPhase {
 public:
  explicit EpaTextbook(const NarrowPhaseSettings& settings)
      : max_iterations_(settings.max_iterations.value_or(256)),
        tolerance_(settings.tolerance.value_or(1e-10)) {}

  void bind(std::span<const Shape> shapes) override { shapes_ = textbook::bind_shapes(shapes); }

  void solve(Task /*task*/, const PairBatch& batch, std::span<Outcome> outcomes) override {
    textbook::for_each_difference(shapes_, batch.pairs, outcomes,
                                  [&](Difference& c, Outcome& outcome) { solve_pair(c, outcome); });
  }

 private:
  void solve_pair(Difference& c, Outcome& outcome) const {
    Points simplex;
    if (gjk_separates(c, simplex, outcome)) {
      outcome.answer = Answer::separated;
      outcome.status = Status::ok;
    } else if (complete(c, simplex)) {
      expand(c, ExpandingPolytope(simplex, c.rounding()), outcome);
    }
  }

  bool gjk_separates(Difference& c, Points& simplex, Outcome& outcome) const {
    const Vec3d toward = -c.origins();
    simplex = {c.support(toward.isZero(0) ? Vec3d(1, 1, 1) : toward)};
    Vec3d v = simplex[0].w;
    for (; outcome.iterations < max_iterations_; ++outcome.iterations) {
      if (simplex.size() == 4 || v.norm() <= c.rounding()) return false;
      const SupportPoint w = c.support(-v);
      if (v.dot(w.w) / v.norm() > c.rounding()) return true;
      Points next = simplex;
      next.push_back(w);
      const Vec3d nearer = keep_nearest_face(next);
      if (!(nearer.squaredNorm() < v.squaredNorm())) return false;
      simplex = next;
      v = nearer;
    }
    return false;
  }

  // Adds support points until there are four that are no plane. Returns false if there are none.
  static bool complete(Difference& c, Points& simplex) {
    while (simplex.size() < 4) {
      const Vec3d& p = simplex[0].w;
      std::vector<Vec3d> across{Vec3d::UnitX(), Vec3d::UnitY(), Vec3d::UnitZ()};
      if (simplex.size() == 2) {
        const Vec3d along = (simplex[1].w - p).normalized(), up = along.unitOrthogonal();
        across = {up, along.cross(up)};
      }
      if (simplex.size() == 3) across = {(simplex[1].w - p).cross(simplex[2].w - p).normalized()};
      SupportPoint farthest;
      double most = 4 * c.rounding();
      for (const Vec3d& d : across) {
        for (const SupportPoint& w : {c.support(d), c.support(-d)}) {
          const double away = std::abs((w.w - p).dot(d));
          if (away > most) farthest = w;
          most = std::max(most, away);
        }
      }
      if (!(most > 4 * c.rounding())) return false;
      simplex.push_back(farthest);
    }
    return true;
  }

  void expand(Difference& c, ExpandingPolytope polytope, Outcome& outcome) const {
    double least_height = std::numeric_limits<double>::infinity(), inside = 0;
    for (int k = 0; k <= max_iterations_; ++k, ++outcome.iterations) {
      const double slack = (inside > 0 ? tolerance_ : 0) + 2 * c.rounding();
      const Face face = polytope.nearest_face(slack);
      if (!(face.doubt < 1)) break;
      const SupportPoint w = c.support(face.normal);
      const double height = face.normal.dot(w.w);
      if (height < -c.rounding()) {
        outcome.answer = Answer::separated;
        outcome.status = Status::ok;
        return;
      }
      least_height = std::min(least_height, height);
      inside = std::max(inside, polytope.inside());
      if (height - face.distance <= slack) {
        const Vec3d weights = polytope.weights(face);
        const double upper =
            polytope.combine(face, weights, &SupportPoint::w).norm() + c.rounding();
        if (!(inside > 0))
          return textbook::write_undecided(c, -std::max(height, 0.0) - c.rounding(), upper,
                                           outcome);
        if (height - inside > 2 * tolerance_ + 16 * c.rounding()) break;
        textbook::write_overlapping(outcome);
        outcome.distance = -c.unit() * height;
        outcome.normal = face.normal;
        if (upper > height + 1e-6) break;  // no face has the projection, whose points are unknown
        outcome.witness_a = c.to_world(polytope.combine(face, weights, &SupportPoint::a));
        outcome.witness_b = c.to_world(polytope.combine(face, weights, &SupportPoint::b));
        break;
      }
      if (!polytope.expand(w)) break;
    }
    if (outcome.status != Status::ok) outcome.status = Status::not_converged;
    if (inside > 0) outcome.answer = Answer::overlapping;
    if (std::isinf(least_height)) return;
    outcome.lower = -c.unit() * (least_height + c.rounding());
    outcome.upper = inside > 0 ? -c.unit() * inside : Outcome::none;
  }

  int max_iterations_;
  double tolerance_;  // in the unit of C
  std::vector<textbook::BoundShape> shapes_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_epa_textbook() {
  return {{.info = {.name = "epa-textbook",
                    .citation = "van den Bergen, \"Proximity Queries and Penetration Depth "
                                "Computation on 3D Game Objects\", GDC 2001, as published"},
           .tasks = {Task::penetration},
           .scalars = {Precision::float64},
           .supports = textbook::are_bounded,
           .tolerance = "how far the surface is beyond the nearest face of the polytope; 1e-10",
           .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
             return std::make_unique<EpaTextbook>(settings);
           }}};
}

}  // namespace touchstone::entries
