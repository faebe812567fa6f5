// Part of gjk-templated: fills a part of the table of specialised_gjk.h. Included by the files that
// share the compilation.
#include "algorithms/kernels/gjk/gjk_distance.inl"
#include "algorithms/kernels/simd/target_attributes.h"
#include "algorithms/narrow_phase/gjk_templated/specialised_gjk.h"

// The loops are those of gjk_iteration.cpp, in which the sanitizers see all levels. One level
// suffices here, in a quarter of the time.
#if defined(__SANITIZE_ADDRESS__) && !defined(TOUCHSTONE_ONE_LEVEL)
#define TOUCHSTONE_ONE_LEVEL
#endif
#include "algorithms/kernels/gjk/gjk_iteration_levels.inl"

namespace touchstone {
namespace {

template <SupportCore a, SupportCore b>
struct SpecialisedCores {
  static constexpr bool start_warm = false;

  template <class Scalar>
  static DifferencePoint<Scalar> support(SupportPair<Scalar>& pair, const Vec3<Scalar>& direction) {
    return pair.template support<SpecialisedCore<a>, SpecialisedCore<b>>(direction);
  }
  template <class Scalar>
  static FastGjkResult<Scalar> fast_gjk(SupportPair<Scalar>& pair, const FastGjkGoal& goal,
                                        Scalar tolerance, const FastGjkStart<Scalar>& start) {
    return fast_gjk_at_level<false, SpecialisedCore<a>, SpecialisedCore<b>>(pair, goal, tolerance,
                                                                            start);
  }
};

// Adds core a with each of the others, none of which comes before it.
template <SupportCore a, SupportCore... others, class Scalar>
void add_pairs(CoreTable<Scalar>& table) {
  const auto place = [](SupportCore core) { return static_cast<std::size_t>(core); };
  ((table[place(a)][place(others)] = {&gjk_distance_by<SpecialisedCores<a, others>, Scalar>,
                                      &SpecialisedCores<a, others>::template fast_gjk<Scalar>}),
   ...);
}

}  // namespace
}  // namespace touchstone
