// Exact: the oracle behind the contract of continuous collision, so that it runs like any other
// algorithm.
// Paper:   the field's exact test (Brochu, Edwards, Bridson, "Efficient Geometrically Exact Continuous
//          Collision Detection", SIGGRAPH 2012) decides a parity; this one isolates the roots, as
//          Collins and Akritas, "Polynomial Real Root Isolation Using Descartes' Rule of Signs",
//          SYMSAC 1976, so it has the first time too.
// Steps:   1. Two boxes of the swept features that are disjoint, or a proof over intervals in doubles
//             (interval_proof), decide most queries.
//          2. The coefficients of the contact polynomials in fixed-width integers, rounded once, are
//             proven over intervals again; contact at time 0 or 1 is decided by integers.
//          3. The rest is decided by algebraic numbers (first_contact): the roots of the cubic, or of
//             all polynomials where it is zero, in order; at each the signs of the other polynomials.
// Departs: there is no tolerance and no cap to set. The time lies in [free_before, contact_by], which
//          are at most 2^-40 apart; toi is the first. `compare` of root.h orders times exactly.
//          A separation > 0 goes from boxes to algebraic numbers (first_within): distances of pairs of
//          vertices, edges and faces have polynomials of degree up to six.
// Cost:    0.1 to 2 us a query where steps 1 and 2 decide, 5 to 50 us where they do not; 0.8 us in the
//          mean of the public sample. Allocates in step 3 alone. A separation > 0 takes
//          0.05 to 2 ms, and up to a second where numbers are from the whole range of doubles.
#include <memory>
#include <vector>

#include "algorithms/ccd.h"
#include "algorithms/oracle/ccd/first_within.h"

namespace touchstone {
namespace {

class ExactCcd final : public Ccd {
 public:
  explicit ExactCcd(const CcdSettings& settings) : settings_(settings) {}

  void solve(FeaturePair pair, std::span<const CcdQuery> queries,
             std::span<CcdOutcome> outcomes) override {
    const int first_count = pair == FeaturePair::vertex_face ? 1 : 2;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      outcomes[i] = {};
      const oracle::ccd::MovingFeatures features{first_count, queries[i].start, queries[i].end};
      const oracle::ccd::Impact impact =
          settings_.separation > 0 ? oracle::ccd::impact_within(features, settings_.separation)
                                   : oracle::ccd::impact_of(features);
      outcomes[i].status = Status::ok;
      outcomes[i].answer = impact.is_hit ? CcdAnswer::hit : CcdAnswer::miss;
      outcomes[i].free_before = impact.free_before;
      if (!impact.is_hit) continue;
      outcomes[i].toi = impact.free_before;
      outcomes[i].contact_by = impact.contact_by;
    }
  }

 private:
  CcdSettings settings_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CcdEntry> oracle_exact_ccd() {
  return {
      {.info = {.name = "exact",
                .citation = "Touchstone's oracle: roots of the coplanarity cubic in integers, "
                            "behind filters",
                .origin = Origin::oracle},
       .separations = true,
       .make = [](const CcdSettings& settings) { return std::make_unique<ExactCcd>(settings); }}};
}

}  // namespace touchstone::entries
