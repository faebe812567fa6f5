// Exact: the oracle behind the narrow phase's contract, to be asked like any other algorithm.
// Paper:   see exact_gjk.h and expander.h; the answer is that of the exact problem in README.md
// here. Departs: distances are rounded once, at the end; tolerance and iteration cap have nothing
// to cut. Fails:   curved cores (cylinder, cone, ellipsoid) have an enclosure, about 1e-18 of the
// size wide
//          apart and 1e-12 deep; where zero is in it the answer is unknown, not_converged.
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

  void solve(const PairBatch& batch, std::span<Outcome> outcomes) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const auto body = [&](std::uint32_t k) {
        return Body(solids_[batch.shape_of[k]], batch.poses[k]);
      };
      oracle::answer(oracle_, body(batch.first[i]), body(batch.second[i]), batch.task, outcomes[i]);
    }
  }

 private:
  std::vector<oracle::Solid> solids_;
  oracle::Oracle oracle_;
};

}  // namespace
}  // namespace touchstone

TOUCHSTONE_NARROW_PHASE {
  using namespace touchstone;
  return {{.info = {.name = "exact",
                    .citation = "Touchstone's oracle: GJK and EPA in integers, each answer with a "
                                "certificate",
                    .origin = Origin::oracle},
           .tasks = {Task::intersect, Task::distance, Task::penetration},
           .scalars = {Precision::float64},
           .make = [](const NarrowPhaseSettings&) { return std::make_unique<Exact>(); }}};
}
