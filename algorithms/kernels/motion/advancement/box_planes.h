// The plane along a face or two edges of boxes that is likely to part them for longest while they move. Used by
// the loop of conservative advancement (advancement.h).
//
// Boxes that are apart are so along one of fifteen axes: the normals of their faces, and the products of their edges.
// Each axis turns with its features, so its gap has a rate that is known, and is used up after gap / rate.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree: a hierarchical structure for rapid interference detection",
//          SIGGRAPH 1996 (the axes); the rates are ours.
// Fails:   it is a choice, not a proof: rounding is not bounded, nor how the rates change. Boxes whose nearest features
//          are a corner and an edge may be further apart than along any axis.
// Cost:    about that of two steps of GJK.
#pragma once

#include <optional>

#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/kernels/motion/advancement/pair_motion.h"

namespace touchstone {

struct BoxPlane {
  Vec3d normal;   // unit vector from a to b
  Vec3d turning;  // its angular velocity with the features that it belongs to
};

// True if both bodies are boxes.
inline bool are_boxes(SupportPair<double>& pair) {
  return pair.a().shape().core == SupportCore::box && pair.b().shape().core == SupportCore::box;
}

// For a pair of boxes. Nothing if no axis parts them by more than `least_gap` (in the pair's unit).
std::optional<BoxPlane> longest_open_plane(SupportPair<double>& pair, const PairMotion& motion,
                                           double least_gap);

}  // namespace touchstone
