// Directional advancement: along the direction of the closest points, find how long no vertex pair
// comes near; go there; again.
// Paper:   conservative advancement (Mirtich, "Impulse-based Dynamic Simulation of Rigid Body Systems",
//          PhD thesis, Berkeley 1996), with the bound on the speed along a direction (Zhang, Lee, Kim,
//          "Interactive Continuous Collision Detection for Non-Convex Polyhedra", The Visual Computer
//          2006) replaced by the exact time at which a direction ceases to separate.
// Steps:   1. Find the closest points of the features at time t, and the direction d between them. If
//             they are within separation + tolerance: a hit at t.
//          2. For each vertex of the first feature and each of the second, the gap along d is linear
//             in time. Find the first time after t at which one falls below the separation and a
//             quarter of the tolerance. Until then there is no contact.
//          3. If that is 1 or later: a miss. Otherwise go on at that time.
//          Before the first step, the axes are tried as directions.
// Departs: as many queries at once as two vectors have lanes (8 with AVX2 and without, 16 with
//          AVX-512); lanes are refilled as they end. A direction need not be right: the gaps prove the
//          interval whatever it is.
// Fails:   a tolerance below 1e-14 of the coordinates is out of reach of doubles: `not_converged`, with
//          the time that is proven. It is never a miss. Slow where features slide along each other
//          nearer than the tolerance and never touch: each step is short; the cap is 512 steps.
//          Coordinates whose differences overflow are `degenerate`.
// Cost:    1.8 steps a query of the public sample, each 15 ns a lane and less with AVX-512. No memory.
//
// Rounding. Let u = 2^-53. A query is scaled by a power of two, so that all coordinates of the edges
// (vertices less vertex 0) are below 1, and their differences and norms below 2 and 2 sqrt(3).
//   d: of norm at most 1 + 4 u, so a gap is at most a distance times that       14 u
//   edges: one rounding each, u a coordinate, for both vertices of a gap         4 u
//   d . x: 3 u of sum |d_k x_k| <= sqrt(3), for both; and their difference      14 u
//   the crossing (a - c) / (a - b): 3 u of at most 1, times a slope of 4 sqrt(3) 21 u
//   the threshold itself, below 4 where any gap reaches it                      8 u
// The sum is below 64 u: with a threshold of the separation and 64 u more, no gap that is computed
// free is in contact, at any time of the interval; times between are convex combinations. A tolerance
// above gives more. For the hit: a vertex at time t is off by 6 u a coordinate, points on features
// with weights in [0, 1] by 7 u more each, and the length by 4 u of itself: below 64 u as well.
#include <algorithm>
#include <bit>
#include <limits>
#include <memory>

#include "algorithms/ccd/directional_advancement/lane_advance.h"
#include "algorithms/core/isa.h"
#include "algorithms/kernels/features/scaled_edges.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

// Writes the outcome of a query that takes no step.
void decide(const CcdQuery& query, const LaneBatch& batch, CcdAnswer answer, Status status,
            double free_before) {
  CcdOutcome& outcome = batch.outcomes[static_cast<std::size_t>(&query - batch.queries.data())];
  outcome = {};
  outcome.answer = answer;
  outcome.status = status;
  outcome.free_before = free_before;
  outcome.iterations = 0;
}

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/ccd/directional_advancement/lane_advance.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

class DirectionalAdvancement final : public Ccd {
 public:
  explicit DirectionalAdvancement(const CcdSettings& settings) : settings_(settings) {}

  void solve(FeaturePair pair, std::span<const CcdQuery> queries,
             std::span<CcdOutcome> outcomes) override {
    const bool is_face = pair == FeaturePair::vertex_face;
    const LaneBatch batch{queries,
                          outcomes,
                          settings_.tolerance,
                          settings_.separation,
                          settings_.max_iterations.value_or(512),
                          is_face};
    switch (isa()) {
      case Isa::avx512:
        return is_face ? avx512::advance_all<true>(batch) : avx512::advance_all<false>(batch);
      case Isa::avx2:
        return is_face ? avx2::advance_all<true>(batch) : avx2::advance_all<false>(batch);
      case Isa::baseline: break;
    }
    return is_face ? baseline::advance_all<true>(batch) : baseline::advance_all<false>(batch);
  }

 private:
  CcdSettings settings_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CcdEntry> ccd_directional_advancement() {
  return {{.info = {.name = "directional-advancement",
                    .citation = "Touchstone: conservative advancement by the time at which the "
                                "direction of the closest points ceases to separate, in lanes"},
           .separations = true,
           .make = [](const CcdSettings& settings) {
             return std::make_unique<DirectionalAdvancement>(settings);
           }}};
}

}  // namespace touchstone::entries
