// Moving pairs that touch exactly at the start, and what tells whether they get deeper.
#pragma once

#include <optional>

#include "harness/families/moving_pairs.h"

namespace touchstone::families {

// What a pair that touches does along the plane of contact.
enum class AfterTouch : std::uint8_t { rests, slides, parts, approaches };

// Boxes, hulls (flat ones too) and balls whose numbers are quarters, so that they touch exactly: in
// vertices, edges or faces along a plane, or not at all where b was moved along it too far. They
// approach along that plane; another may keep them from getting deeper.
MovingPairCase touching_on_grid(AfterTouch after, Draws& random);

// A body at a place.
struct PlacedShape {
  Shape shape;
  Pose pose;
};

// What a body covers that moves by a displacement without turning, up to rounding; nothing for kinds other
// than sphere, box and hull. Another body that does not move gets as deep into it as the two get along the
// fixed direction in which they get the least deep.
std::optional<PlacedShape> swept(const Shape& shape, const Pose& pose, const Vec3d& displacement);

}  // namespace touchstone::families
