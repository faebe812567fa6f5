// GJK's distance loop: bounds the distance of two cores from both sides. Used by gjk, gjk-lanes,
// gjk-templated, certified, smooth and clipped-faces.
//
// Each simplex bounds the distance from above, each support plane from below.
// Paper:   Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex
//          objects in three-dimensional space", IEEE J. Robotics and Automation 4(2), 1988; with
//          momentum: Montaut, Le Lidec, Petrik, Sivic, Carpentier, "Collision detection
//          accelerated: an optimization perspective", RSS 2022, algorithm 3.
// Steps:   1. If the previous frame left a simplex or a direction, test it first (warm_start); one
//             support call ends a query for which nothing has changed.
//          2. Run the fast iteration (gjk_iteration). If it decides, stop; otherwise continue from
//             its simplex.
//          3. Find the support point towards the origin; its plane raises the lower bound.
//          4. If the bounds decide the task, or the point is already in the simplex, stop.
//          5. Add the point and reduce the simplex to the feature nearest to the origin
//             (minkowski/simplex); its distance lowers the upper bound.
//          6. If the origin is inside the simplex or on it up to rounding, end with `contact`.
//          7. Choose the next direction: towards the origin, or with momentum (nesterov_direction).
//             Repeat from step 3 until the bounds decide, the distance stalls or the cap is
//             reached.
#pragma once

#include <limits>
#include <optional>

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/gjk/gjk_iteration.h"
#include "algorithms/kernels/gjk/simplex_face.h"
#include "algorithms/kernels/gjk/warm_start.h"

namespace touchstone {

// Choice of the next search direction. `where_it_pays` uses momentum only between bodies without
// corners and edges that are less than about their size apart. In published counts the iterations
// halve there, and triple if bodies are far from each other.
enum class Momentum : std::uint8_t { none, nesterov, where_it_pays };

template <class Scalar>
struct GjkDistanceGoal {
  Task task = Task::intersect;
  Scalar tolerance = 0;  // of the distance, in the pair's unit
  // Bodies that are proven to be further apart need no distance; in the pair's unit.
  Scalar margin = std::numeric_limits<Scalar>::infinity();
  std::optional<double> duality_gap = {};  // square metres; replaces the tolerance
  int most_iterations = 0;
  Momentum momentum = Momentum::none;
  // End where cores without radius touch at a face, both bounds within rounding.
  bool ends_at_face = false;

  // Returns true if the lower bound is too far below the nearest point's distance to stop. Both are
  // for the cores.
  bool is_open(const SupportPair<Scalar>& pair, Scalar nearest, Scalar lower) const {
    const Scalar difference = nearest - lower;
    if (!duality_gap) return difference > tolerance;
    const double area = pair.unit() * pair.unit();
    return difference > SupportPair<Scalar>::rounding &&
           2 * area * static_cast<double>(nearest * difference) > *duality_gap;
  }
};

// Bounds on the distance between the cores, in the pair's unit.
template <class Scalar>
struct GjkDistanceResult {
  enum class End {
    decided,    // the bounds suffice for the task
    at_face,    // `face` holds the contact; only if the goal asks for that
    contact,    // the origin is inside the simplex, or on it up to rounding
    no_better,  // rounding prevents progress
    cap,
  };
  End end = End::cap;
  Simplex<Scalar> simplex;
  NearestPoint<Scalar> nearest;
  Scalar lower = 0;
  Scalar upper = std::numeric_limits<Scalar>::infinity();
  Vec3<Scalar> direction = Vec3<Scalar>::Zero();  // unit normal of that lower bound; zero: none
  std::optional<FaceContact<Scalar>> face = {};
  bool warm_hit = false;  // the previous frame's result sufficed
  int iterations = 0;
};

// `last`: what the previous frame left, or null.
template <class Scalar>
GjkDistanceResult<Scalar> gjk_distance(SupportPair<Scalar>& pair,
                                       const GjkDistanceGoal<Scalar>& goal,
                                       const LastFrame<Scalar>* last = nullptr);

template <class Scalar>
using GjkDistanceFunction = GjkDistanceResult<Scalar> (*)(SupportPair<Scalar>&,
                                                          const GjkDistanceGoal<Scalar>&,
                                                          const LastFrame<Scalar>*);

extern template GjkDistanceResult<float> gjk_distance(SupportPair<float>&,
                                                      const GjkDistanceGoal<float>&,
                                                      const LastFrame<float>*);
extern template GjkDistanceResult<double> gjk_distance(SupportPair<double>&,
                                                       const GjkDistanceGoal<double>&,
                                                       const LastFrame<double>*);

// The functions that iterate between two cores; by default those for any cores.
template <class Scalar>
struct CoreFunctions {
  GjkDistanceFunction<Scalar> gjk_distance = touchstone::gjk_distance<Scalar>;
  FastGjkFunction<Scalar> fast_gjk = touchstone::fast_gjk<Scalar>;
};

// Distance of the simplex's nearest point from the origin, computed from its weights.
template <class Scalar>
Scalar distance_from_origin(const Simplex<Scalar>& simplex) {
  Vec3<Scalar> sum = Vec3<Scalar>::Zero();
  for (int i = 0; i < simplex.size; ++i) sum += simplex.weights[i] * simplex.points[i].difference;
  return sum.norm();
}

}  // namespace touchstone
