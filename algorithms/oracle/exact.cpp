// Exact: the oracle behind the narrow phase's contract, so that it runs like any other algorithm.
// Paper:   see exact_gjk.h and expander.h. The answer is that of the exact problem in README.md.
// Steps:   1. Make a solid, a core and a ball, of each shape in `bind`.
//          2. Place a pair in doubles and search with GJK (hint); a verdict ends here if a bound on
//             the rounding proves it.
//          3. Place the pair on one grid of integers (grid_pair) and search with integer GJK
//             (exact_gjk).
//          4. If the origin is in the difference, grow a polytope in integers to its nearest face
//             (expander).
//          5. A half-space needs one exact support instead (half_space).
//          6. Compare the core's signed distance with the radii, exactly (signed_root).
//          7. Write distance and witness points from the certificate, rounded once (answer).
// Departs: there is no tolerance and no iteration cap to set; the answer is exact before it is
//          rounded.
// Fails:   curved cores (cylinder, cone, ellipsoid) have an enclosure, about 1e-18 of the size wide
//          when apart and 1e-12 when deep. If it contains zero the answer is `unknown` and the
//          status `not_converged`.
// Cost:    10 to 100 us a query for polytopes, up to some ms for curved cores; allocates.
#include <vector>

#include "algorithms/narrow_phase.h"
#include "algorithms/oracle/answer.h"

namespace touchstone {
namespace {

using oracle::Body;

class Exact final : public NarrowPhase {
 public:
  void bind(std::span<const Shape> shapes) override {
    solids_.clear();
    solids_.reserve(shapes.size());
    for (const Shape& shape : shapes) solids_.emplace_back(shape);
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const auto body = [&](std::uint32_t k) {
        return Body(solids_[batch.pairs.shape_of[k]], batch.pairs.poses[k]);
      };
      outcomes[i].iterations = outcomes[i].support_calls = -1;
      oracle::answer(oracle_, body(batch.pairs.first[i]), body(batch.pairs.second[i]), task,
                     outcomes[i]);
    }
  }

 private:
  std::vector<oracle::Solid> solids_;
  oracle::Oracle oracle_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> oracle_exact() {
  return {{.info = {.name = "exact",
                    .citation = "Touchstone's oracle: GJK and EPA in integers, each answer with a "
                                "certificate",
                    .origin = Origin::oracle},
           .tasks = {all_tasks.begin(), all_tasks.end()},
           .scalars = {Precision::float64},
           .make = [](const NarrowPhaseSettings&) { return std::make_unique<Exact>(); }}};
}

}  // namespace touchstone::entries
