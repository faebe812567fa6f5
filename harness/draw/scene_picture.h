// Draws a frame of a scene. Used by the command `draw`.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/pose.h"
#include "harness/draw/canvas.h"
#include "harness/scene/scene.h"

namespace touchstone::draw {

// The state of a body after both phases.
enum class BodyState : std::uint8_t {
  apart,        // its box overlaps no other: certainly apart
  possible,     // the broad phase reports it in a pair; the narrow phase finds it apart from all
  overlapping,  // the narrow phase finds it in contact
};

// Colours bodies by their state, as the page does: apart grey, possible amber, overlapping red.
// Curved shapes are drawn as polytopes, a half-space as its face near the other bodies. A recording
// has no bodies: `poses` is empty and the boxes are drawn.
void draw_scene(Canvas& canvas, const scene::Scene& scene, std::span<const Pose> poses,
                std::span<const Aabb> boxes, std::span<const BodyState> states);

}  // namespace touchstone::draw
