// A query of two bodies by GJK, and by EPA where their cores meet: the loop of gjk_approach.h, and
// what its end says.
// Papers: those of gjk_approach.h and expanding_polytope.h.
#pragma once

#include <optional>

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/epa/expanding_polytope.h"
#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/kernels/gjk/warm_start.h"

namespace touchstone {

struct GjkQuerySettings {
  std::optional<double> tolerance = {};    // as NarrowPhaseSettings have it
  std::optional<double> duality_gap = {};  // so too
  int gjk_cap = 128, epa_cap = 256;        // iterations
  Momentum momentum = Momentum::none;
};

template <class Scalar>
class GjkQuery {
 public:
  explicit GjkQuery(const GjkQuerySettings& settings)
      : settings_(settings), polytope_(settings.epa_cap) {}

  // Of bounded bodies. A verdict is `ok` only where a bound proves it beyond rounding. Bodies whose
  // balls are apart are not walked between, but for their distance. Begins where `start` says,
  // unless it is null, and leaves there what was found.
  void solve(const SupportShape<Scalar>& a, const Pose& pose_a, const SupportShape<Scalar>& b,
             const Pose& pose_b, Task task, WarmStart* start, Outcome& outcome);

  // From now on walks by these, which are for the cores that are to come.
  void walk_by(const CoreWalks<Scalar>& walks) { walks_ = walks; }

  // Of a distance between the bodies, in the pair's unit.
  Scalar tolerance(bool polytopes) const {
    const double smooth = sizeof(Scalar) == 8 ? 1e-10 : 1e-5;
    const double own = polytopes ? 0 : smooth;
    // The pair's unit is up to twice its size.
    return std::max(static_cast<Scalar>(settings_.tolerance.value_or(own) / 2), rounding);
  }

 private:
  static constexpr Scalar rounding = SupportPair<Scalar>::rounding;

  bool walk_decides(SupportPair<Scalar>& pair, Outcome& outcome) const;
  void solve_pair(SupportPair<Scalar>& pair, Task task, WarmStart* start, Outcome& outcome);
  Approach<Scalar> approach_from(SupportPair<Scalar>& pair, const ApproachGoal<Scalar>& goal,
                                 WarmStart* start);
  void solve_contact(SupportPair<Scalar>& pair, const Approach<Scalar>& found, Task task,
                     Outcome& outcome);

  GjkQuerySettings settings_;
  CoreWalks<Scalar> walks_;
  ExpandingPolytope<Scalar> polytope_;
};

extern template class GjkQuery<float>;
extern template class GjkQuery<double>;

}  // namespace touchstone
