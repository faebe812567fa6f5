// GJK's distance loop for any two cores: each support call selects the core's code at run time.
// Used by gjk, gjk-lanes and certified.
#include "algorithms/kernels/gjk/gjk_distance.inl"

namespace touchstone {
namespace {

struct GenericCores {
  static constexpr bool start_warm = true;

  template <class Scalar>
  static DifferencePoint<Scalar> support(SupportPair<Scalar>& pair, const Vec3<Scalar>& direction) {
    return pair.support(direction);
  }
  template <class Scalar>
  static FastGjkResult<Scalar> fast_gjk(SupportPair<Scalar>& pair, const FastGjkGoal& goal,
                                        Scalar tolerance, const FastGjkStart<Scalar>& start) {
    return touchstone::fast_gjk(pair, goal, tolerance, start);
  }
};

}  // namespace

template <class Scalar>
GjkDistanceResult<Scalar> gjk_distance(SupportPair<Scalar>& pair,
                                       const GjkDistanceGoal<Scalar>& goal,
                                       const LastFrame<Scalar>* last) {
  return gjk_distance_by<GenericCores>(pair, goal, last);
}

template GjkDistanceResult<float> gjk_distance(SupportPair<float>&, const GjkDistanceGoal<float>&,
                                               const LastFrame<float>*);
template GjkDistanceResult<double> gjk_distance(SupportPair<double>&,
                                                const GjkDistanceGoal<double>&,
                                                const LastFrame<double>*);

}  // namespace touchstone
