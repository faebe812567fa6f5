// The frame in which the parts of two placed bodies are compared. Used by mid-phases and concave
// phases.
#pragma once

#include "algorithms/core/pose.h"

namespace touchstone {

// Two bodies, both seen from the first one. The frame is its own, and its points are taken as they stand:
// common points are the same in any frame. Only if its rotation has no inverse to 1e-10, the frame is the
// world, moved by its translation.
struct CommonFrame {
  bool is_of_a = true;
  // The maps into the frame; `a` is the identity if is_of_a.
  Pose a, b;
  // A point that is mapped in doubles is off from its exact place, in each coordinate, by at most
  // this (metres), and so is a point of a by being taken as it stands.
  double error = 0;
};

// `reach_a` and `reach_b` are at least the greatest magnitude of a coordinate of the bodies' points,
// in their own frames (metres).
CommonFrame common_frame(const Pose& a, double reach_a, const Pose& b, double reach_b);

// The same with the world, moved by a's translation, for the frame whatever the rotations are:
// lengths in it are those of the world.
CommonFrame world_frame(const Pose& a, double reach_a, const Pose& b, double reach_b);

// `inner` followed by `outer`, in doubles. `reach` bounds the coordinates of the points that are
// mapped. Each point is off by at most `error` (metres), which is 0 if nothing was rounded.
struct ComposedPose {
  Pose pose;
  double error;
};
ComposedPose composed(const Pose& outer, const Pose& inner, double reach);

}  // namespace touchstone
