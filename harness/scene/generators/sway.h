// Small-amplitude motion of pairs, which keeps them about as far apart as they were placed. Used by
// the generator `pairs`.
#pragma once

#include "harness/scene/generators/generators.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

struct Sway {
  double share = 0;      // change of the distance relative to the gap, about; 0: nothing moves
  int frames = 1;        // frames of the scene
  double time_step = 0;  // seconds
};

// Reads `sway`. Throws if the scene also sets a motion.
Sway read_sway(const GeneratorInput& input);

// Sets the pair in motion so that it passes through the given poses in the middle frame. `normal`
// (unit length) is the direction from a to b there, `gap` the signed distance (metres), and `reach`
// the extent of each body from its origin.
//
// Both bodies rotate together about the origin of a; b also slides and rotates about the normal.
// These motions change the distance only to second order. Finally b tilts a little. Each angle, and
// the length of the slide, is small enough to change the distance at the first and the last frame
// by at most about a quarter of share * |gap|, if the nearest features stay the same. If one slides
// off the other's edge, the bodies are further apart.
void set_swaying(const Sway& sway, const Vec3d& normal, double gap, double reach,
                 base::Random& random, Body& a, Body& b);

}  // namespace touchstone::scene
