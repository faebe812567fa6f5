// Pairs of bodies to ask the oracle about, each kind of which is hard in its own way.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/oracle/solid.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone::oracle {

struct Placed {
  std::shared_ptr<const Solid> solid;
  Pose pose;
  std::optional<std::array<double, 4>> quaternion = {};

  Body body() const {
    return quaternion ? Body(*solid, *quaternion, pose.translation) : Body(*solid, pose);
  }
};
struct Sample {
  Placed a, b;
};

using touchstone::reference::Random;

// A kind of pair. The numbers are the least that must come of each answer, in percent, and how many
// pairs are compared with which reference.
struct Regime {
  const char* name;
  Sample (*make)(Random& random, int number);
  int separated, touching, overlapping;
  int count;             // proven, and their certificates verified
  int by_axes, by_cgal;  // of these, the first so many are compared with a reference as well
};

// Regimes of polytopes with or without balls, whose answers are exact.
std::vector<Regime> exact_regimes();

// Cylinders, cones and ellipsoids with each other and with all the rest.
Sample curved_sample(Random& random, int number);
// A half-space and any other body, or another half-space.
Sample halfspace_sample(Random& random, int number);
// Boxes, tetrahedra and needles beside balls that touch or miss each other by what filters in
// double precision cannot tell.
Sample nearly_touching_sample(Random& random, int number);

}  // namespace touchstone::oracle
