// FCL: its cubic for moving vertices, faces and edges, which its mesh traversals call.
// Paper:   Tang, Curtis, Yoon, Manocha, "Interactive Continuous Collision Detection between Deformable
//          Models Using Connectivity-Based Culling", SPM 2008; the library is FCL 0.7,
//          fcl::detail::Intersect<double>, with its interval Newton.
// Departs: tolerance and max_iterations have no counterpart there. FCL never reports a failure.
// Fails:   misses contacts: at time 1 and 0 and at corners and edges of faces, where rounding puts the
//          root or the point outside; in plane motion, where the cubic is zero; of degenerate
//          features; and of small ones, as thresholds (1e-5 on edges and their parallelism) are
//          absolute. Reports contacts that are none, by the same thresholds.
// Cost:    0.2 us a query.
#include <cstddef>
#include <memory>

#include "algorithms/ccd.h"

#ifdef TOUCHSTONE_HAS_FCL
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

namespace touchstone {
namespace {

class FclCubic final : public Ccd {
 public:
  explicit FclCubic(const CcdSettings& settings) : settings_(settings) {}

  void solve(FeaturePair pair, std::span<const CcdQuery> queries,
             std::span<CcdOutcome> outcomes) override {
    using Intersect = fcl::detail::Intersect<double>;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      CcdOutcome& outcome = outcomes[i];
      outcome = {};
      if (settings_.separation > 0) continue;
      const auto& [p0, q0, r0, s0] = queries[i].start;
      const auto& [p1, q1, r1, s1] = queries[i].end;
      double time = CcdOutcome::none;
      Vec3d point;
      const bool is_hit =
          pair == FeaturePair::vertex_face
              ? Intersect::intersect_VF(q0, r0, s0, p0, q1, r1, s1, p1, &time, &point)
              : Intersect::intersect_EE(p0, q0, r0, s0, p1, q1, r1, s1, &time, &point);
      outcome.answer = is_hit ? CcdAnswer::hit : CcdAnswer::miss;
      outcome.status = Status::not_reported;
      if (is_hit) outcome.toi = time;
    }
  }

 private:
  CcdSettings settings_;
};

std::unique_ptr<Ccd> make_cubic(const CcdSettings& settings) {
  return std::make_unique<FclCubic>(settings);
}

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<CcdEntry> peers_fcl_ccd() {
  return {
      {.info = {.name = "fcl-cubic",
                .citation = "FCL 0.7, fcl::detail::Intersect<double>::intersect_VF and "
                            "intersect_EE",
                .origin = Origin::peer,
                .known_defect = "misses contacts: at corners, at times 0 and 1, in plane motion, "
                                "of degenerate and of small features"},
       .make = make_cubic}};
}

}  // namespace touchstone::entries
