// A query of two bodies by GJK, and by EPA if their cores meet. Used by gjk, gjk-templated,
// gjk-lanes and smooth.
// Paper:   see gjk_distance.h and expanding_polytope.h.
#pragma once

#include <limits>
#include <optional>

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/epa/expanding_polytope.h"
#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/kernels/gjk/warm_start.h"

namespace touchstone {

struct GjkQuerySettings {
  std::optional<double> tolerance = {};                     // as in NarrowPhaseSettings
  std::optional<double> duality_gap = {};                   // as in NarrowPhaseSettings
  double margin = std::numeric_limits<double>::infinity();  // metres; as in NarrowPhaseSettings
  int gjk_cap = 128, epa_cap = 256;                         // iterations
  Momentum momentum = Momentum::none;
};

template <class Scalar>
class GjkQuery {
 public:
  explicit GjkQuery(const GjkQuerySettings& settings)
      : settings_(settings), polytope_(settings.epa_cap) {}

  // Solves a pair of bounded bodies. A verdict is `ok` only if a bound proves it beyond rounding.
  // If their bounding balls are apart, no iteration is made except for a distance; nor for that if
  // they are by more than the margin. Starts from `start` unless it is null, and stores the result
  // there; its plane is the caller's to try before.
  void solve(const SupportShape<Scalar>& a, const Pose& pose_a, const SupportShape<Scalar>& b,
             const Pose& pose_b, Task task, WarmStart* start, Outcome& outcome);

  // Sets the functions for the next queries; they must fit the cores of those queries.
  void set_functions(const CoreFunctions<Scalar>& functions) { functions_ = functions; }

  // Tolerance of a distance between the bodies, in the pair's unit.
  Scalar tolerance(bool polytopes) const {
    const double smooth = sizeof(Scalar) == 8 ? 1e-10 : 1e-5;
    const double own = polytopes ? 0 : smooth;
    // The pair's unit is up to twice its size.
    return std::max(static_cast<Scalar>(settings_.tolerance.value_or(own) / 2), rounding);
  }

 private:
  static constexpr Scalar rounding = SupportPair<Scalar>::rounding;

  std::optional<CentreOffset> offset_unless_apart(const SupportShape<Scalar>& a, const Pose& pose_a,
                                                  const SupportShape<Scalar>& b, const Pose& pose_b,
                                                  Task task, Outcome& outcome) const;
  bool takes_fast_gjk(const SupportShape<Scalar>& a, const SupportShape<Scalar>& b) const;
  void decide(const CentreOffset& offset, const SupportShape<Scalar>& a, const Pose& pose_a,
              const SupportShape<Scalar>& b, const Pose& pose_b, Outcome& outcome);
  GjkDistanceResult<Scalar> solve_pair(SupportPair<Scalar>& pair, Task task,
                                       const LastFrame<Scalar>* last, Outcome& outcome);
  void solve_contact(SupportPair<Scalar>& pair, const GjkDistanceResult<Scalar>& found, Task task,
                     Outcome& outcome);

  GjkQuerySettings settings_;
  CoreFunctions<Scalar> functions_;
  ExpandingPolytope<Scalar> polytope_;
};

extern template class GjkQuery<float>;
extern template class GjkQuery<double>;

}  // namespace touchstone
