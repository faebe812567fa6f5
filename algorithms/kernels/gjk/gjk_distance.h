// GJK's loop: how near the difference of two cores comes to the origin, from both sides.
//
// Each simplex bounds the distance from above, each support plane from below. The quick walk of
// simplex_walk.h comes first; this one makes its end good with the care of simplex.h, or goes on
// from there. Where the frame before left something (warm_start.h), it is looked at first, and the
// walk begins there: one support call ends a query for which nothing has changed.
// Paper: Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex
// objects in three-dimensional space", IEEE J. Robotics and Automation 4(2), 1988; with momentum:
// Montaut, Le Lidec, Petrik, Sivic, Carpentier, "Collision detection accelerated: an optimization
// perspective", RSS 2022, algorithm 3.
#pragma once

#include <limits>
#include <optional>

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/gjk/gjk_iteration.h"
#include "algorithms/kernels/gjk/warm_start.h"

namespace touchstone {

// Where to look for the next support point. `where_it_pays`: with momentum only between bodies
// without corners and edges that are less than about their size apart; published counts of
// iterations halve there, and triple where bodies are far from each other.
enum class Momentum : std::uint8_t { none, nesterov, where_it_pays };

template <class Scalar>
struct ApproachGoal {
  Task task = Task::intersect;
  Scalar tolerance = 0;                    // of the distance, in the pair's unit
  std::optional<double> duality_gap = {};  // square metres; instead of the tolerance
  int most_iterations = 0;
  Momentum momentum = Momentum::none;

  // Whether a lower bound is too far below the nearest point's distance to stop, both of the cores.
  bool is_open(const SupportPair<Scalar>& pair, Scalar nearest, Scalar lower) const {
    const Scalar difference = nearest - lower;
    if (!duality_gap) return difference > tolerance;
    const double area = pair.unit() * pair.unit();
    return difference > SupportPair<Scalar>::rounding &&
           2 * area * static_cast<double>(nearest * difference) > *duality_gap;
  }
};

// What GJK knows of the distance between the cores, in the pair's unit.
template <class Scalar>
struct Approach {
  enum class End {
    decided,    // as far as the task needs
    contact,    // the origin is inside the simplex, or on it up to rounding
    no_better,  // rounding
    cap,
  };
  End end = End::cap;
  Simplex<Scalar> simplex;
  NearestPoint<Scalar> nearest;
  Scalar lower = 0;
  Scalar upper = std::numeric_limits<Scalar>::infinity();
  Vec3<Scalar> direction = Vec3<Scalar>::Zero();  // unit length, of the last plane; zero: none
  bool as_before = false;  // what the frame before left was all that was needed
  int iterations = 0;
};

// `start`: what is known from the frame before; null: nothing.
template <class Scalar>
Approach<Scalar> approach(SupportPair<Scalar>& pair, const ApproachGoal<Scalar>& goal,
                          const WarmStart* start = nullptr);

template <class Scalar>
using ApproachFunction = Approach<Scalar> (*)(SupportPair<Scalar>&, const ApproachGoal<Scalar>&,
                                              const WarmStart*);

extern template Approach<float> approach(SupportPair<float>&, const ApproachGoal<float>&,
                                         const WarmStart*);
extern template Approach<double> approach(SupportPair<double>&, const ApproachGoal<double>&,
                                          const WarmStart*);

// The code that walks between two cores: for any, as long as nothing else is put in.
template <class Scalar>
struct CoreWalks {
  ApproachFunction<Scalar> approach = touchstone::approach<Scalar>;
  WalkFunction<Scalar> walk = touchstone::walk<Scalar>;
};

// How far the nearest point, as the simplex's weights have it, is from the origin.
template <class Scalar>
Scalar off_core(const Simplex<Scalar>& simplex) {
  Vec3<Scalar> sum = Vec3<Scalar>::Zero();
  for (int i = 0; i < simplex.size; ++i) sum += simplex.weights[i] * simplex.points[i].difference;
  return sum.norm();
}

}  // namespace touchstone
