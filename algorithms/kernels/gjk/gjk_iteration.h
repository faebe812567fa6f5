// GJK's walk with plain products: quick, good to most digits, and no proof of anything but what its
// support planes prove. What it finds is made good, or gone on from, with the care of simplex.h.
#pragma once

#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

enum class WalkEnd : std::uint8_t {
  apart,     // a support plane is further from the origin than the radius: proven
  near,      // the simplex is as near as the tolerance asks for
  inside,    // the origin is in the tetrahedron: proven
  doubtful,  // rounding, or the cap
};

template <class Scalar>
struct Walk {
  WalkEnd end = WalkEnd::doubtful;
  Simplex<Scalar> simplex;  // weights are not set
  Scalar lower = 0;  // of the distance between the cores, by the last plane, in the pair's unit
  Vec3<Scalar> way = Vec3<Scalar>::Zero();  // that plane's normal, away from the origin; any length
  int iterations = 0;
  bool moved = false;  // the simplex is not the one that it began with
};

// Where a walk begins: at the difference of the centres, as a rule.
template <class Scalar>
struct WalkStart {
  explicit WalkStart(const Vec3<Scalar>& towards) : way(towards) {}

  Vec3<Scalar> way;         // from the origin towards the difference, to the simplex' nearest point
  Simplex<Scalar> simplex;  // may be empty; else only corners of the nearest point's feature
};

struct WalkGoal {
  bool only_apart = false;  // a plane that separates the bodies is enough
  int most_iterations = 0;
  bool numbered = false;  // the simplex is wanted with the numbers of its corners
};

// `tolerance` is of the distance, in the pair's unit.
template <class Scalar>
Walk<Scalar> walk(SupportPair<Scalar>& pair, const WalkGoal& goal, Scalar tolerance,
                  const WalkStart<Scalar>& start);
template <class Scalar>
Walk<Scalar> walk(SupportPair<Scalar>& pair, const WalkGoal& goal, Scalar tolerance) {
  return walk(pair, goal, tolerance, WalkStart<Scalar>(-pair.centre_b()));
}

template <class Scalar>
using WalkFunction = Walk<Scalar> (*)(SupportPair<Scalar>&, const WalkGoal&, Scalar,
                                      const WalkStart<Scalar>&);

// Whether the origin is inside a tetrahedron whatever rounding did to its corners.
template <class Scalar>
bool is_surely_inside(const Simplex<Scalar>& simplex);
// An origin that is too near the face of a tetrahedron's first three corners for it to be surely
// inside is well inside one of the three around the axis from its last corner to one beyond that
// face: then the simplex becomes that one, and this is true.
template <class Scalar>
bool goes_around(Simplex<Scalar>& simplex, const DifferencePoint<Scalar>& behind);

extern template bool is_surely_inside(const Simplex<float>&);
extern template bool is_surely_inside(const Simplex<double>&);
extern template bool goes_around(Simplex<float>&, const DifferencePoint<float>&);
extern template bool goes_around(Simplex<double>&, const DifferencePoint<double>&);
extern template Walk<float> walk(SupportPair<float>&, const WalkGoal&, float,
                                 const WalkStart<float>&);
extern template Walk<double> walk(SupportPair<double>&, const WalkGoal&, double,
                                  const WalkStart<double>&);

}  // namespace touchstone
