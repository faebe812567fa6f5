// GJK's fast iteration with plain products. It is accurate to most digits; only its support planes
// and tetrahedra are proofs. The distance loop (gjk_distance) and minkowski/simplex refine its
// result. Used by the GJK family, certified, mpr-refined and the room mpr (is_surely_inside).
// Steps:   1. Start at the difference of the centres, or at a given simplex.
//          2. Find the support point towards the origin, in vectors of four numbers.
//          3. If its plane is further from the origin than the radii (and the margin, if the
//             distance is searched), or the bounds meet to the tolerance, stop. Stop also at the first
//             plane, if the goal asks for that.
//          4. If the point is already in the simplex, stop.
//          5. Add the point and reduce the simplex to the nearest feature that contains it.
//          6. If a tetrahedron remains, test that it contains the origin beyond rounding. If that
//             is open, try the tetrahedra with a support point behind the face that the search came
//             through, and stop.
//          7. Stop if the distance did not fall; otherwise repeat from step 2.
#pragma once

#include <limits>

#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

enum class FastGjkEnd : std::uint8_t {
  apart,     // a support plane is further from the origin than the radius, and the margin if it
             // is no search for separation only: proven
  near,      // the simplex's distance is within the tolerance
  inside,    // the tetrahedron contains the origin: proven
  at_plane,  // the first support plane is at the origin or in front of it, if the goal asks for that
  doubtful,  // rounding or the cap ended the iteration
};

template <class Scalar>
struct FastGjkResult {
  FastGjkEnd end = FastGjkEnd::doubtful;
  Simplex<Scalar> simplex;  // weights are not set
  Scalar lower = 0;         // lower bound on the cores' distance, in the pair's unit
  // The last support plane's normal, away from the origin; any length.
  Vec3<Scalar> direction = Vec3<Scalar>::Zero();
  int iterations = 0;
  bool moved = false;  // the simplex differs from the initial one
};

// The start of an iteration: usually the difference of the centres.
template <class Scalar>
struct FastGjkStart {
  explicit FastGjkStart(const Vec3<Scalar>& towards) : direction(towards) {}

  Vec3<Scalar>
      direction;  // from the origin to the simplex's nearest point, or towards the difference
  Simplex<Scalar> simplex;  // may be empty; otherwise only corners of the nearest point's feature
};

struct FastGjkGoal {
  bool only_apart = false;  // stop at a plane that separates the bodies
  int most_iterations = 0;
  bool numbered = false;  // the simplex must hold the indices of its corners
  // Stop at a plane that separates the bodies by more than this, in the pair's unit.
  double margin = std::numeric_limits<double>::infinity();
  bool ends_at_plane = false;  // stop if the first support plane is within rounding of the origin
  bool ends_behind = false;  // with that: stop also if the origin is behind the first support plane
};

// `tolerance` applies to the distance, in the pair's unit.
template <class Scalar>
FastGjkResult<Scalar> fast_gjk(SupportPair<Scalar>& pair, const FastGjkGoal& goal, Scalar tolerance,
                               const FastGjkStart<Scalar>& start);
template <class Scalar>
FastGjkResult<Scalar> fast_gjk(SupportPair<Scalar>& pair, const FastGjkGoal& goal,
                               Scalar tolerance) {
  return fast_gjk(pair, goal, tolerance, FastGjkStart<Scalar>(-pair.centre_b()));
}

template <class Scalar>
using FastGjkFunction = FastGjkResult<Scalar> (*)(SupportPair<Scalar>&, const FastGjkGoal&, Scalar,
                                                  const FastGjkStart<Scalar>&);

// How far rounding moves a corner, proven in certified/proven_rounding.h, with what is lost in sums
// of lengths.
template <class Scalar>
inline constexpr Scalar corner_rounding = 56 * std::numeric_limits<Scalar>::epsilon();

// Returns true if a tetrahedron contains the origin whatever rounding did to its corners.
template <class Scalar>
bool is_surely_inside(const Simplex<Scalar>& simplex);
// If rounding leaves open whether the origin is inside because it is close to face 012, tries the
// three tetrahedra that share the edge from vertex 3 to `behind` (a support point beyond that
// face). Replaces `simplex` by the one that contains the origin and returns true; otherwise returns
// false.
template <class Scalar>
bool find_enclosing_tetrahedron(Simplex<Scalar>& simplex, const DifferencePoint<Scalar>& behind);

extern template bool is_surely_inside(const Simplex<float>&);
extern template bool is_surely_inside(const Simplex<double>&);
extern template bool find_enclosing_tetrahedron(Simplex<float>&, const DifferencePoint<float>&);
extern template bool find_enclosing_tetrahedron(Simplex<double>&, const DifferencePoint<double>&);
extern template FastGjkResult<float> fast_gjk(SupportPair<float>&, const FastGjkGoal&, float,
                                              const FastGjkStart<float>&);
extern template FastGjkResult<double> fast_gjk(SupportPair<double>&, const FastGjkGoal&, double,
                                               const FastGjkStart<double>&);

}  // namespace touchstone
