// Inclusion: halve boxes of time and place on the features until each is free or small, the earliest
// first.
// Paper:   Wang, Ferguson, Schneider, Jiang, Attene, Panozzo, "A Large-Scale Benchmark and an
//          Inclusion-Based Algorithm for Continuous Collision Detection", ACM TOG 40(5), 2021.
// Steps:   1. F(t, u, v) is the point of the second feature less that of the first, at time t; u and v
//             are places on the face or on the edges. F is linear in each, so its values on a box lie
//             in the box of its eight corners.
//          2. Take the box of parameters that begins first. If the box of its values, grown by the
//             rounding error, is further than the separation from the origin: drop it.
//          3. If the corner where its parameters are least is within separation + tolerance of the
//             origin: a hit at its time. All earlier times are free, since no box begins before.
//          4. Otherwise halve it along the parameter in which F varies most.
//          5. No box left: a miss.
// Departs: the order is by time alone, then small boxes first; the paper goes level by level. The
//          error is a bound on this code's rounding, relative to the edges' size, where the paper's
//          filter is relative to max(|x|, 1)^3 for coordinates x (releases of its library since 2022
//          take the min, and miss contacts). A hit is two points within separation + tolerance in the
//          Euclidean norm, where the paper's is a small box.
// Fails:   features that slide in each other's plane need boxes without number: beyond the cap (10,000)
//          the answer is `not_converged`, with the time that is proven, and never a miss. Coordinates
//          whose differences overflow are `degenerate`.
// Cost:    0.2 us a box; a clear miss takes one to ten, a hit some hundreds. Allocates the queue.
//
// Rounding, in the unit of ScaledEdges and u = 2^-53: a vertex at time t is off by 6 u a coordinate. A
// sum a + u' (b - a) + v' (c - a) has two differences off by 14 u each, two products off by 2 u more,
// and two sums below 8: 6 u + 32 u + 8 u. All is below scaled_error, 64 u. Parameters are exact: at
// least 2^-50 wide.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "algorithms/ccd.h"
#include "algorithms/kernels/features/scaled_edges.h"

namespace touchstone {
namespace {

// A box of parameters t, u and v.
struct ParameterBox {
  std::array<double, 3> low, width;

  // The order of the queue, whose top is the greatest.
  friend bool operator<(const ParameterBox& x, const ParameterBox& y) {
    if (x.low[0] != y.low[0]) return x.low[0] > y.low[0];
    return x.width[0] + x.width[1] + x.width[2] > y.width[0] + y.width[1] + y.width[2];
  }
};

constexpr double least_width = 0x1p-50;

// The values of F at the corners: corner k has the upper end of parameter i where bit i is set.
using Corners = std::array<Vec3d, 8>;

Corners corners_of(const ScaledEdges& edges, bool is_face, const ParameterBox& box) {
  Corners corners;
  for (std::size_t late = 0; late < 2; ++late) {
    const double t = box.low[0] + (late == 1 ? box.width[0] : 0);
    std::array<Vec3d, 3> x;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d start(&edges.at[3 * i]), end(&edges.at[3 * i + 9]);
      x[i] = start + t * (end - start);
    }
    // A face's point is x0 + u (x1 - x0) + v (x2 - x0); for edges the second's x1 + v (x2 - x1) less
    // the first's u x0.
    const Vec3d& origin = is_face ? x[0] : x[1];
    const Vec3d along_u = is_face ? Vec3d(x[1] - x[0]) : Vec3d(-x[0]);
    const Vec3d along_v = x[2] - origin;
    for (std::size_t k = 0; k < 4; ++k) {
      const double u = box.low[1] + (k % 2 == 1 ? box.width[1] : 0);
      const double v = box.low[2] + (k / 2 == 1 ? box.width[2] : 0);
      corners[late + 2 * k] = origin + u * along_u + v * along_v;
    }
  }
  return corners;
}

// The square of the distance from the origin to the box of all values: a lower bound.
double least_square(const Corners& corners) {
  Vec3d low = corners[0], high = corners[0];
  for (const Vec3d& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const Vec3d gap = low.cwiseMax(-high).array() - scaled_error;
  return gap.cwiseMax(0.0).squaredNorm() * (1 - 8 * 0x1p-53);
}

// The parameter in which F varies most, among those that can be halved; 3 if there is none.
std::size_t widest(const Corners& corners, const ParameterBox& box) {
  std::size_t best = 3;
  double most = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    if (box.width[i] <= least_width) continue;
    double varies = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      if ((k >> i & 1) == 1) continue;
      const Vec3d change = corners[k | std::size_t{1} << i] - corners[k];
      varies = std::max(varies, change.cwiseAbs().maxCoeff());
    }
    if (varies > most) {
      most = varies;
      best = i;
    }
  }
  return best;
}

class Inclusion final : public Ccd {
 public:
  explicit Inclusion(const CcdSettings& settings) : settings_(settings) {}

  void solve(FeaturePair pair, std::span<const CcdQuery> queries,
             std::span<CcdOutcome> outcomes) override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      outcomes[i] = search(pair == FeaturePair::vertex_face, queries[i]);
    }
  }

 private:
  CcdOutcome search(bool is_face, const CcdQuery& query) {
    CcdOutcome outcome;
    ScaledEdges edges;
    outcome.free_before = 0;
    if (!scale_edges(query.start, query.end, edges)) {
      outcome.status = Status::degenerate;
      return outcome;
    }
    const double separation = settings_.separation * edges.scale * (1 + 0x1p-50);
    const double square = separation * separation * (1 + 0x1p-50);
    const double near = (settings_.separation + settings_.tolerance) * edges.scale * (1 - 0x1p-49) -
                        2 * scaled_error;
    const int cap = settings_.max_iterations.value_or(10000);
    outcome.status = Status::not_converged;
    outcome.iterations = 0;
    queue_.assign(1, {{0, 0, 0}, {1, 1, 1}});
    while (!queue_.empty()) {
      const ParameterBox box = queue_.front();
      outcome.free_before = box.low[0];
      if (outcome.iterations == cap) return outcome;
      ++outcome.iterations;
      std::pop_heap(queue_.begin(), queue_.end());
      queue_.pop_back();
      const Corners corners = corners_of(edges, is_face, box);
      if (least_square(corners) > square) continue;
      if (corners[0].norm() <= near) {
        outcome.answer = CcdAnswer::hit;
        outcome.status = Status::ok;
        outcome.toi = outcome.contact_by = box.low[0];
        return outcome;
      }
      const std::size_t axis = widest(corners, box);
      if (axis == 3) return outcome;
      halve(box, axis, is_face);
    }
    outcome.answer = CcdAnswer::miss;
    outcome.status = Status::ok;
    outcome.free_before = 1;
    return outcome;
  }

  void halve(const ParameterBox& box, std::size_t axis, bool is_face) {
    ParameterBox half = box;
    half.width[axis] /= 2;
    for (int k = 0; k < 2; ++k, half.low[axis] += half.width[axis]) {
      // Beyond the face's third edge.
      if (is_face && half.low[1] + half.low[2] > 1) continue;
      queue_.push_back(half);
      std::push_heap(queue_.begin(), queue_.end());
    }
  }

  CcdSettings settings_;
  std::vector<ParameterBox> queue_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CcdEntry> ccd_inclusion() {
  return {
      {.info = {.name = "inclusion",
                .citation = "Wang, Ferguson, Schneider, Jiang, Attene, Panozzo, \"A Large-Scale "
                            "Benchmark and an Inclusion-Based Algorithm for Continuous "
                            "Collision Detection\", ACM TOG 40(5), 2021"},
       .separations = true,
       .make = [](const CcdSettings& settings) { return std::make_unique<Inclusion>(settings); }}};
}

}  // namespace touchstone::entries
