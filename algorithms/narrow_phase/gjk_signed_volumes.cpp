// GJK with the signed volumes method in place of Johnson's sub-algorithm: the nearest point of a simplex from signs of lengths,
// areas and volumes.
// Paper:   Montanari, Petrinic, Barbieri, "Improving the GJK Algorithm for Faster and More Reliable Distance Queries Between
//          Convex Objects", ACM Transactions on Graphics 36(3), 2017; the loop around it is that of gjk-textbook.
// Steps:   1. Begin with the simplex of one support point of the difference C = A - B, and with v at this point.
//          2. Take the support point w of C in the direction -v; it bounds the distance from below, and |v| from above.
//          3. Stop if the bounds meet, or if the origin is at v or inside the simplex; otherwise add w to the simplex.
//          4. S3D: if the four volumes that the origin makes with the faces have one sign, it is inside. Otherwise S2D looks
//             at each face whose volume has the other sign.
//          5. S2D: project the origin on the triangle's plane, and compare signs of areas, seen along the axis from which the
//             triangle is greatest. S1D: the same on the line of an edge, with signs of lengths. The nearest point is kept.
//          6. Go on with step 2. The weights of v in its face give the witness points.
// Departs: S2D and S1D look at each part whose sign is wrong, those with the oldest points too. The direction of the next
//          support point is that of the origin's projection on the triangle, not that of the sum of weights: it keeps its digits
//          where v is short. A search that ends at the origin is decided by kernels/textbook/contact.
// Answers: `lower` and `upper` are certified. `touching` within bounds that are at most 6e-14 of the size apart.
// Fails:   not_converged with bounds at the cap of iterations, and where rounding ends the search first, as at slivers and
//          where smooth bodies touch. Does not take half-spaces.
// Cost:    as gjk-textbook: a support call for each iteration, O(1) space.
#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "algorithms/kernels/textbook/contact.h"
#include "algorithms/kernels/textbook/difference.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {
namespace {

using textbook::SupportPoint;

// Support points with the weights of the simplex' nearest point to the origin.
struct WeightedSimplex {
  std::array<SupportPoint, 4> points;
  std::array<double, 4> weights{1, 0, 0, 0};
  int size = 0;
  Vec3d
      projection;  // the nearest point, as the projection of the origin on the simplex' affine hull

  bool has(const SupportPoint& p) const {
    for (int i = 0; i < size; ++i) {
      if (points[i].w == p.w) return true;
    }
    return false;
  }
  Vec3d nearest(Vec3d SupportPoint::*part) const {
    Vec3d sum = Vec3d::Zero();
    for (int i = 0; i < size; ++i) sum += weights[i] * (points[i].*part);
    return sum;
  }
  // The face without point j.
  WeightedSimplex without(int j) const {
    WeightedSimplex face;
    for (int i = 0; i < size; ++i) {
      if (i != j) face.points[face.size++] = points[i];
    }
    return face;
  }
};

WeightedSimplex nearest_face(const WeightedSimplex& simplex);

// Takes the nearest of the faces opposite to the points whose part of the whole does not have the sign of the whole. Returns
// the simplex itself, with the shares as weights, if all have this sign.
WeightedSimplex by_signs(WeightedSimplex simplex, const std::array<double, 4>& parts, double whole,
                         const Vec3d& projection) {
  WeightedSimplex best;
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < simplex.size; ++j) {
    if (parts[j] * whole > 0) continue;
    const WeightedSimplex face = nearest_face(simplex.without(j));
    const double square = face.nearest(&SupportPoint::w).squaredNorm();
    if (best.size > 0 && !(square < least)) continue;
    least = square;
    best = face;
  }
  if (best.size > 0) return best;
  for (int j = 0; j < simplex.size; ++j) simplex.weights[j] = parts[j] / whole;
  simplex.projection = projection;
  return simplex;
}

WeightedSimplex s1d(const WeightedSimplex& simplex) {
  const Vec3d &s1 = simplex.points[0].w, &s2 = simplex.points[1].w;
  const Vec3d edge = s2 - s1;
  const Vec3d p = s1 - (s1.dot(edge) / edge.squaredNorm()) * edge;
  int axis = 0;
  edge.cwiseAbs().maxCoeff(&axis);
  return by_signs(simplex, {s2[axis] - p[axis], p[axis] - s1[axis]}, edge[axis], p);
}

WeightedSimplex s2d(const WeightedSimplex& simplex) {
  const Vec3d &s1 = simplex.points[0].w, &s2 = simplex.points[1].w, &s3 = simplex.points[2].w;
  const Vec3d normal = (s2 - s1).cross(s3 - s1);
  const Vec3d p = (s1.dot(normal) / normal.squaredNorm()) * normal;
  int axis = 0;  // the triangle is greatest if seen along this one
  normal.cwiseAbs().maxCoeff(&axis);
  const auto area = [&](const Vec3d& q, const Vec3d& r, const Vec3d& s) {
    return (r - q).cross(s - q)[axis];
  };
  return by_signs(simplex, {area(p, s2, s3), area(s1, p, s3), area(s1, s2, p)}, normal[axis], p);
}

WeightedSimplex s3d(const WeightedSimplex& simplex) {
  const auto volume = [&](int q, int r, int s) {
    return simplex.points[q].w.dot(simplex.points[r].w.cross(simplex.points[s].w));
  };
  const std::array<double, 4> parts{volume(1, 2, 3), volume(0, 3, 2), volume(0, 1, 3),
                                    volume(0, 2, 1)};
  return by_signs(simplex, parts, parts[0] + parts[1] + parts[2] + parts[3], Vec3d::Zero());
}

// Returns the smallest face that has the nearest point to the origin, with its weights.
WeightedSimplex nearest_face(const WeightedSimplex& simplex) {
  if (simplex.size == 4) return s3d(simplex);
  if (simplex.size == 3) return s2d(simplex);
  if (simplex.size == 2) return s1d(simplex);
  WeightedSimplex point = simplex;
  point.weights = {1, 0, 0, 0};
  point.projection = point.points[0].w;
  return point;
}

class GjkSignedVolumes final : public NarrowPhase {
 public:
  explicit GjkSignedVolumes(const NarrowPhaseSettings& settings)
      : max_iterations_(settings.max_iterations.value_or(128)),
        tolerance_(settings.tolerance.value_or(1e-10)) {}

  void bind(std::span<const Shape> shapes) override { shapes_ = textbook::bind_shapes(shapes); }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    textbook::for_each_difference(
        shapes_, batch.pairs, outcomes, [&](textbook::Difference& c, Outcome& outcome) {
          int iterations = 0;
          textbook::answer_distance(
              c, task, tolerance_,
              [&](bool wants_distance) { return search(c, wants_distance, iterations); }, outcome);
          outcome.iterations = iterations;
        });
  }

 private:
  // A simplex with the bounds that it ended with, in the unit of C.
  struct Search {
    WeightedSimplex simplex;
    textbook::Bounds distance{0, 0};
    bool is_enclosed = false;  // the origin is inside the simplex

    Vec3d direction() const {
      const double length = simplex.projection.norm();
      return length > 0 ? Vec3d(simplex.projection / length)
                        : simplex.nearest(&SupportPoint::w).normalized();
    }
  };

  Search search(textbook::Difference& c, bool wants_distance, int& iterations) const {
    const Vec3d toward = -c.origins();
    Search found;
    WeightedSimplex& simplex = found.simplex;
    simplex.points[simplex.size++] = c.support(toward.isZero(0) ? Vec3d(1, 1, 1) : toward);
    simplex = nearest_face(simplex);
    for (int k = 0;; ++k, ++iterations) {
      const Vec3d v = simplex.nearest(&SupportPoint::w);
      found.distance.upper = v.norm() + c.rounding();
      if (simplex.size == 4) {
        const auto& p = simplex.points;
        found.is_enclosed =
            textbook::encloses_origin({p[0].w, p[1].w, p[2].w, p[3].w}, c.rounding());
        return found;
      }
      if (v.norm() <= c.rounding() || k == max_iterations_) return found;
      const Vec3d direction = found.direction();
      const SupportPoint w = c.support(-direction);
      found.distance.lower = std::max(found.distance.lower, direction.dot(w.w) - c.rounding());
      const bool is_apart = found.distance.lower > 0;
      if (is_apart && (!wants_distance || found.distance.have_met(tolerance_, c))) return found;
      if (simplex.has(w)) return found;
      WeightedSimplex next = simplex;
      next.points[next.size++] = w;
      next = nearest_face(next);
      // Rounding ends the descent.
      if (!(next.nearest(&SupportPoint::w).squaredNorm() < v.squaredNorm())) return found;
      simplex = next;
    }
  }

  int max_iterations_;
  double tolerance_;  // in the unit of C
  std::vector<textbook::BoundShape> shapes_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_gjk_signed_volumes() {
  return {{.info = {.name = "gjk-signed-volumes",
                    .citation = "Montanari, Petrinic, Barbieri, \"Improving the GJK Algorithm for "
                                "Faster and More Reliable "
                                "Distance Queries Between Convex Objects\", ACM Transactions on "
                                "Graphics 36(3), 2017, as "
                                "published"},
           .tasks = {Task::intersect, Task::distance},
           .scalars = {Precision::float64},
           .supports = textbook::are_bounded,
           .tolerance = "the gap between both bounds on a distance; 1e-10",
           .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
             return std::make_unique<GjkSignedVolumes>(settings);
           }}};
}

}  // namespace touchstone::entries
