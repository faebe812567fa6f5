// Additive advancement: go on by the distance divided by a bound on the speed, again and again.
// Paper:   Li, Kaufman, Jiang, "Codimensional Incremental Potential Contact", ACM TOG 40(4), 2021,
//          algorithm 1 (additive CCD).
// Steps:   1. Take the mean motion of the four vertices away. The greatest speed of a vertex of one
//             feature plus that of the other bounds how fast the distance shrinks.
//          2. Find the distance at time t. Within separation + tolerance: a hit at t.
//          3. Go on by the distance less the separation, over that speed. Beyond 1: a miss.
// Departs: the paper ends at a tenth of the first distance, which says nothing of how near the
//          features are; this ends at the tolerance. The paper takes nine tenths of each step against
//          rounding; this takes the whole step of a lower bound on the distance, which is the gap of
//          all vertices along the direction of the closest points, less its rounding. Positions are
//          computed from the start, so rounding does not add up.
// Fails:   features that slide along each other, or graze, take steps as short as the distance: beyond
//          the cap (1,000) the answer is `not_converged`, with the time that is proven, and never a
//          miss. Coordinates whose differences overflow are `degenerate`.
// Cost:    50 to 100 ns a step. No memory.
//
// Rounding, in the unit of ScaledEdges and u = 2^-53: a vertex at time t is off by 6 u a coordinate,
// so 11 u; a gap of two vertices along a direction of norm at most 1 + 4 u by 22 u, 14 u and the
// product's 11 u; a step by 3 u of the time, at a speed of at most 7. Together below scaled_error.
// Points with weights in [0, 1] are off by 7 u a coordinate more than the vertices: below it too.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include "algorithms/ccd.h"
#include "algorithms/kernels/features/scaled_edges.h"

namespace touchstone {
namespace {

// The closest points of two features: what leads from the first feature's to the second's, and a
// direction like it, of any length, square to the parts on which they lie.
struct Closest {
  Vec3d between = Vec3d::Zero();
  Vec3d direction = Vec3d::Zero();
  double square = std::numeric_limits<double>::infinity();

  // The segment from `a` to `b` seen from p, or p seen from the segment.
  void try_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b, double sign) {
    const Vec3d edge = b - a, w = a - p;
    const double length = edge.squaredNorm();
    const double place = length > least ? -w.dot(edge) / length : 0;
    const Vec3d from_p = w + std::clamp(place, 0.0, 1.0) * edge;
    if (!(from_p.squaredNorm() < square)) return;
    square = from_p.squaredNorm();
    between = direction = sign * from_p;
    if (place > 0 && place < 1) direction -= direction.dot(edge) / length * edge;
  }

  // Both are nearest inside; the normal is then the direction.
  void take_inside(const Vec3d& from_first, const Vec3d& normal, double height) {
    between = from_first;
    direction = height > 0 ? normal : Vec3d(-normal);
  }

  static constexpr double least = 1e-200;  // of squares that count as more than nothing
};

// The vertices 1, 2 and 3 relative to the vertex 0.
using Edges = std::array<Vec3d, 3>;

Closest closest_of_face(const Edges& x) {
  const auto& [a, b, c] = x;
  Closest closest;
  closest.try_segment(Vec3d::Zero(), a, b, 1);
  closest.try_segment(Vec3d::Zero(), b, c, 1);
  closest.try_segment(Vec3d::Zero(), c, a, 1);
  const Vec3d normal = (c - b).cross(a - c);
  const double wa = normal.dot(b.cross(c)), wb = normal.dot(c.cross(a)),
               wc = normal.dot(a.cross(b));
  const double sum = wa + wb + wc;
  if (wa >= 0 && wb >= 0 && wc >= 0 && sum > Closest::least) {
    closest.take_inside(wa / sum * a + wb / sum * b + wc / sum * c, normal, normal.dot(a));
  }
  return closest;
}

Closest closest_of_edges(const Edges& x) {
  const auto& [b, c, d] = x;
  const Vec3d zero = Vec3d::Zero();
  Closest closest;
  closest.try_segment(zero, c, d, 1);
  closest.try_segment(b, c, d, 1);
  closest.try_segment(c, zero, b, -1);
  closest.try_segment(d, zero, b, -1);
  const Vec3d along = d - c, normal = b.cross(along);
  const double square = normal.squaredNorm();
  if (!(square > Closest::least)) return closest;
  const double s = c.cross(along).dot(normal) / square, t = c.cross(b).dot(normal) / square;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
    closest.take_inside(c + t * along - s * b, normal, normal.dot(c));
  }
  return closest;
}

// The least gap along a direction from a vertex of the first feature to one of the second.
double gap_along(const Vec3d& direction, const Edges& x, bool is_face) {
  const double one = direction.dot(x[0]), two = direction.dot(x[1]), three = direction.dot(x[2]);
  return is_face ? std::min({one, two, three}) : std::min(two, three) - std::max(0.0, one);
}

// An upper bound on the speed at which two vertices of different features approach.
double speed_of(const Edges& start, const Edges& end, bool is_face) {
  std::array<Vec3d, 4> motion = {Vec3d::Zero(), end[0] - start[0], end[1] - start[1],
                                 end[2] - start[2]};
  const Vec3d mean = 0.25 * (motion[1] + motion[2] + motion[3]);
  std::array<double, 2> fastest = {0, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    double& side = fastest[i >= (is_face ? 1u : 2u) ? 1 : 0];
    side = std::max(side, (motion[i] - mean).norm());
  }
  return (fastest[0] + fastest[1]) * (1 + 32 * 0x1p-53) + scaled_error;
}

class AdditiveAdvancement final : public Ccd {
 public:
  explicit AdditiveAdvancement(const CcdSettings& settings) : settings_(settings) {}

  void solve(FeaturePair pair, std::span<const CcdQuery> queries,
             std::span<CcdOutcome> outcomes) override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      outcomes[i] = advance(pair == FeaturePair::vertex_face, queries[i]);
    }
  }

 private:
  CcdOutcome advance(bool is_face, const CcdQuery& query) const {
    CcdOutcome outcome;
    ScaledEdges scaled;
    outcome.free_before = 0;
    if (!scale_edges(query.start, query.end, scaled)) {
      outcome.status = Status::degenerate;
      return outcome;
    }
    Edges start, end;
    for (std::size_t i = 0; i < 3; ++i) {
      start[i] = Vec3d(&scaled.at[3 * i]);
      end[i] = Vec3d(&scaled.at[3 * i + 9]);
    }
    const double speed = speed_of(start, end, is_face);
    const double separation = settings_.separation * scaled.scale;
    const double near = (separation + settings_.tolerance * scaled.scale) * (1 - 8 * 0x1p-53);
    const int cap = settings_.max_iterations.value_or(1000);
    outcome.status = Status::not_converged;
    for (outcome.iterations = 1; outcome.iterations <= cap; ++outcome.iterations) {
      const double t = outcome.free_before;
      Edges x;
      for (std::size_t i = 0; i < 3; ++i) x[i] = start[i] + t * (end[i] - start[i]);
      const Closest closest = is_face ? closest_of_face(x) : closest_of_edges(x);
      if (closest.between.norm() <= near - scaled_error) {
        outcome.answer = CcdAnswer::hit;
        outcome.status = Status::ok;
        outcome.toi = outcome.contact_by = t;
        return outcome;
      }
      const double length = closest.direction.norm();
      if (!(length > 0)) break;
      const double gap = gap_along(closest.direction / length, x, is_face);
      const double free = gap - separation * (1 + 8 * 0x1p-53) - scaled_error;
      const double next = t + free / speed;
      if (!(next > t)) break;
      if (next > 1) {
        outcome.answer = CcdAnswer::miss;
        outcome.status = Status::ok;
        outcome.free_before = 1;
        return outcome;
      }
      outcome.free_before = next;
    }
    outcome.iterations = std::min(outcome.iterations, cap);
    return outcome;
  }

  CcdSettings settings_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CcdEntry> ccd_additive_advancement() {
  return {{.info = {.name = "additive-advancement",
                    .citation = "Li, Kaufman, Jiang, \"Codimensional Incremental Potential "
                                "Contact\", ACM TOG 40(4), 2021"},
           .separations = true,
           .make = [](const CcdSettings& settings) {
             return std::make_unique<AdditiveAdvancement>(settings);
           }}};
}

}  // namespace touchstone::entries
