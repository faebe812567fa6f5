// GJK as it stands in the textbook: the point of the difference C = A - B that is nearest to the origin, from one support point
// after the other.
// Paper:   Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex objects in
//          three-dimensional space", IEEE J. Robotics and Automation 4(2), 1988; termination by van den Bergen, "A fast and
//          robust GJK implementation for collision detection of convex objects", J. Graphics Tools 4(2), 1999.
// Steps:   1. Begin with the simplex of one support point, and with v at this point.
//          2. Take the support point w of C in the direction -v. The plane through w across v has all of C behind it, so
//             v . w / |v| bounds the distance from below; |v| bounds it from above.
//          3. Stop if the bounds meet. Stop if the origin is at v, or inside the simplex.
//          4. Add w to the simplex. Johnson's sub-algorithm finds v anew: the nearest point of the simplex, and the smallest
//             face of it that has this point. Keep that face, and go on with step 2.
//          5. The weights of v in its face, applied to the points of A and of B, give the witness points.
// Departs: the sub-algorithm looks at all faces of the simplex and takes the nearest of their points, which is the paper's
//          backup procedure, always. A search that ends at the origin is decided by kernels/textbook/contact.
// Answers: `lower` and `upper` are certified. `touching` within bounds that are at most 6e-14 of the size apart.
// Fails:   not_converged with bounds at the cap of iterations, and where rounding ends the search first: the direction -v has
//          lost its digits where v is as short as the rounding of the points, and the cofactors where the simplex is flat.
//          Does not take half-spaces.
// Cost:    a support call for each iteration, which looks at every vertex of a hull. Few iterations for polytopes, a few for
//          each digit on curved surfaces. O(1) space.
#include <array>
#include <bit>
#include <limits>
#include <memory>
#include <vector>

#include "algorithms/kernels/textbook/contact.h"
#include "algorithms/kernels/textbook/difference.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {
namespace {

using textbook::SupportPoint;

// At most four affinely independent support points, with the weights of the nearest point to the origin.
class Simplex {
 public:
  explicit Simplex(const SupportPoint& first) { add(first); }

  int size() const { return size_; }
  const SupportPoint& operator[](int i) const { return points_[i]; }
  bool has(const SupportPoint& p) const {
    for (int i = 0; i < size_; ++i) {
      if (points_[i].w == p.w) return true;
    }
    return false;
  }

  // The nearest point of the simplex to the origin, as a combination of the members `part` of the support points.
  Vec3d nearest(Vec3d SupportPoint::*part) const {
    Vec3d sum = Vec3d::Zero();
    for (int i = 0; i < size_; ++i) sum += weights_[i] * (points_[i].*part);
    return sum;
  }

  // Adds a point, and keeps the smallest face that has the nearest point.
  void add(const SupportPoint& p) {
    points_[size_++] = p;
    keep_nearest_face();
  }

 private:
  // Johnson's distance sub-algorithm. A face X is a set of points, one bit each. Its affine hull has its nearest point at
  // the weights delta_i(X) / sum of delta(X), and this point is within the face if all cofactors delta_i(X) are positive.
  void keep_nearest_face() {
    std::array<std::array<double, 4>, 16> delta{};
    double least = std::numeric_limits<double>::infinity(), sum_of_best = 1;
    unsigned best = 1;
    for (unsigned face = 1; face < 1U << size_; ++face) {
      bool is_inside = true;
      double sum = 0;
      Vec3d v = Vec3d::Zero();
      for (int j = 0; j < size_; ++j) {
        if ((face >> j & 1U) == 0) continue;
        delta[face][j] = cofactor(delta, face & ~(1U << j), j);
        is_inside = is_inside && delta[face][j] > 0;
        sum += delta[face][j];
        v += delta[face][j] * points_[j].w;
      }
      if (!is_inside || !((v / sum).squaredNorm() < least)) continue;
      least = (v / sum).squaredNorm();
      sum_of_best = sum;
      best = face;
    }
    int kept = 0;
    for (int i = 0; i < size_; ++i) {
      if ((best >> i & 1U) == 0) continue;
      weights_[kept] = std::popcount(best) == 1 ? 1 : delta[best][i] / sum_of_best;
      points_[kept++] = points_[i];
    }
    size_ = kept;
  }

  // delta_j(X + j) = sum over i in X of delta_i(X) (y_i . y_k - y_i . y_j), where k is any point of X; 1 for an empty X.
  double cofactor(const std::array<std::array<double, 4>, 16>& delta, unsigned rest, int j) const {
    if (rest == 0) return 1;
    const Vec3d edge = points_[std::countr_zero(rest)].w - points_[j].w;
    double sum = 0;
    for (int i = 0; i < size_; ++i) {
      if ((rest >> i & 1U) != 0) sum += delta[rest][i] * points_[i].w.dot(edge);
    }
    return sum;
  }

  std::array<SupportPoint, 4> points_;
  std::array<double, 4> weights_{};
  int size_ = 0;
};

class GjkTextbook final : public NarrowPhase {
 public:
  explicit GjkTextbook(const NarrowPhaseSettings& settings)
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
    Simplex simplex;
    textbook::Bounds distance;
    bool is_enclosed;  // the origin is inside the simplex

    Vec3d direction() const { return simplex.nearest(&SupportPoint::w).normalized(); }
  };

  Search search(textbook::Difference& c, bool wants_distance, int& iterations) const {
    Vec3d toward = -c.origins();
    Search found{Simplex(c.support(toward.isZero(0) ? Vec3d(1, 1, 1) : toward)), {0, 0}, false};
    Simplex& simplex = found.simplex;
    Vec3d v = simplex.nearest(&SupportPoint::w);
    for (int k = 0;; ++k, ++iterations) {
      found.distance.upper = v.norm() + c.rounding();
      if (simplex.size() == 4) {
        found.is_enclosed = textbook::encloses_origin(
            {simplex[0].w, simplex[1].w, simplex[2].w, simplex[3].w}, c.rounding());
        return found;
      }
      if (v.norm() <= c.rounding() || k == max_iterations_) return found;
      const SupportPoint w = c.support(-v);
      found.distance.lower = std::max(found.distance.lower, v.dot(w.w) / v.norm() - c.rounding());
      const bool is_apart = found.distance.lower > 0;
      if (is_apart && (!wants_distance || found.distance.have_met(tolerance_, c))) return found;
      if (simplex.has(w)) return found;
      Simplex next = simplex;
      next.add(w);
      const Vec3d nearer = next.nearest(&SupportPoint::w);
      if (!(nearer.squaredNorm() < v.squaredNorm())) return found;  // rounding ends the descent
      simplex = next;
      v = nearer;
    }
  }

  int max_iterations_;
  double tolerance_;  // in the unit of C
  std::vector<textbook::BoundShape> shapes_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_gjk_textbook() {
  return {{.info = {.name = "gjk-textbook",
                    .citation = "Gilbert, Johnson, Keerthi, \"A fast procedure for computing the "
                                "distance between complex "
                                "objects in three-dimensional space\", IEEE J. Robotics and "
                                "Automation 4(2), 1988, as "
                                "published; termination of van den Bergen, 1999"},
           .tasks = {Task::intersect, Task::distance},
           .scalars = {Precision::float64},
           .supports = textbook::are_bounded,
           .tolerance = "the gap between both bounds on a distance; 1e-10",
           .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
             return std::make_unique<GjkTextbook>(settings);
           }}};
}

}  // namespace touchstone::entries
