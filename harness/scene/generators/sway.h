// Pairs of bodies that move a little each frame and stay about as far apart as they were placed.
#pragma once

#include "harness/scene/generators/generators.h"
#include "harness/scene/scene.h"

namespace touchstone {

struct Sway {
  double share = 0;      // of the gap, by which the distance may change, about; 0: nothing moves
  int frames = 1;        // of the scene
  double time_step = 0;  // seconds
};

// Reads `sway`, which is refused where the scene says how bodies move.
Sway read_sway(const GeneratorInput& input);

// Sets the pair in motion, so that it passes through the poses given in the middle frame. `normal`
// (unit length) is the direction from a to b there, `gap` the signed distance (metres), and `reach`
// how far each body reaches from its origin.
//
// The two turn together about the origin of a; b slides on and turns about the normal too, and none
// of this changes the distance but in the second order. Last, b tilts a little. Each angle, and the
// length of the slide, is so small that at the first and the last frame it changes the distance by
// about a quarter of share * |gap| at most, as long as the nearest features of the two stay the
// same: where one has slid off the other's edge they are further apart.
void set_swaying(const Sway& sway, const Vec3d& normal, double gap, double reach, Random& random,
                 Body& a, Body& b);

}  // namespace touchstone
