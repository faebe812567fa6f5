// GJK's distance loop for any two cores: each support call selects the core's code at run time.
// Used by gjk, gjk-lanes and certified.
#include "algorithms/kernels/gjk/gjk_distance.inl"

namespace touchstone {
namespace {

struct AnyCores {
  static constexpr bool start_warm = true;

  template <class Scalar>
  static DifferencePoint<Scalar> support(SupportPair<Scalar>& pair, const Vec3<Scalar>& direction) {
    return pair.support(direction);
  }
  template <class Scalar>
  static Walk<Scalar> walk(SupportPair<Scalar>& pair, const WalkGoal& goal, Scalar tolerance,
                           const WalkStart<Scalar>& start) {
    return touchstone::walk(pair, goal, tolerance, start);
  }
};

}  // namespace

template <class Scalar>
Approach<Scalar> approach(SupportPair<Scalar>& pair, const ApproachGoal<Scalar>& goal,
                          const WarmStart* start) {
  return approach_by<AnyCores>(pair, goal, start);
}

template Approach<float> approach(SupportPair<float>&, const ApproachGoal<float>&,
                                  const WarmStart*);
template Approach<double> approach(SupportPair<double>&, const ApproachGoal<double>&,
                                   const WarmStart*);

}  // namespace touchstone
