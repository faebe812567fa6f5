// Boxes that move, by the fifteen axes of which one parts them if they are apart: the normals of their faces, and the
// products of their edges. Used by the loop of conservative advancement (advancement.h).
//
// Each axis turns with its features, so its gap has a rate that is known, and is used up after gap / rate.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree: a hierarchical structure for rapid interference detection",
//          SIGGRAPH 1996 (the axes); the rates are ours.
// Steps:   1. Of the axes that part the boxes by more than the least gap, choose the one whose gap lasts longest.
//          2. If there is none, the axis with the widest gap tells the features that are nearest: a corner and a face,
//             or two edges. Their closest points are points of the boxes.
// Fails:   it is a choice, not a proof: rounding is not bounded, nor how the rates change. Where a corner or an edge is
//          next to an edge or a corner, the boxes may be further apart than along any axis, and the points than the
//          boxes.
// Cost:    about that of two steps of GJK.
#pragma once

#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/kernels/motion/advancement/pair_motion.h"

namespace touchstone {

struct BoxLook {
  enum class State {
    open,     // an axis parts them by more than the least gap
    near,     // none does, and none is closed by as much
    overlap,  // or nothing is known
  };
  State state = State::overlap;
  // If not in overlap: unit vector from a to b, and its angular velocity with its features.
  Vec3d normal = Vec3d::Zero(), turning = Vec3d::Zero();
  // If near: points of the boxes that may be the closest, each from its own centre, in the pair's unit.
  Vec3d on_a = Vec3d::Zero(), on_b = Vec3d::Zero();
};

// True if both bodies are boxes.
inline bool are_boxes(SupportPair<double>& pair) {
  return pair.a().shape().core == SupportCore::box && pair.b().shape().core == SupportCore::box;
}

// For a pair of boxes; `least_gap` is in the pair's unit.
BoxLook look_at_boxes(SupportPair<double>& pair, const PairMotion& motion, double least_gap);

}  // namespace touchstone
