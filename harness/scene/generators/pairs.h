// Places two bodies at a given exact distance, as the generator `pairs` does.
#pragma once

#include "algorithms/oracle/oracle.h"
#include "harness/base/random.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

// Places two bodies at a given exact distance.

// Moves b along the shortest connection, or separating translation, until the signed distance
// (metres) is correct to one millionth of it or to 4e-16. The nearest features may change on the
// way. Returns false if this does not converge.
bool settle(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a,
            const oracle::Solid& b, Pose& at_b, double distance);

// Moves b straight along `way`, a unit vector, to the first place where the signed distance is
// correct to that precision. It must be greater at the start. Returns false if there is no such
// place.
bool meet(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a, const oracle::Solid& b,
          Pose& at_b, const Vec3d& way, double distance);

// How the second body of a pair rests on the first, both of them boxes, or but in a wall hulls.
enum class Rest : std::uint8_t {
  stacked,  // on top of it
  turned,   // on top of it, both turned about the vertical
  tumbled,  // on top of it, the stack turned in space
  wall,     // beside it, at a face, an edge or a corner
  floor,    // the first stands on a half-space, which the second is
};

// Rounds the sides of the boxes to multiples of 1/32 m, so that faces meet to the last digit where
// nothing is turned.
void snap_boxes(Scene& scene);

// Places the bodies at rest, `gap` metres apart along the first axis on which they touch. Hulls lie
// on faces. Body a has a random rotation before.
void place_resting(Rest rest, double gap, base::Random& random, Scene& scene, Body& a, Body& b);

}  // namespace touchstone::scene
