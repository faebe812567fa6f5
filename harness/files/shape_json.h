// Bodies in the format of cases: {"shape": {"type": ...}, "translation": ..., "rotation": ...}.
#pragma once

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "harness/files/json_line.h"

namespace touchstone {

// Throws InputError, as read_cases says. An axis other than z is turned into z by permuting the
// columns of the rotation.
void read_body(const JsonNode& body, Shape& shape, Pose& pose);

// The axis that a capsule, cylinder or cone lies along: 0, 1 or 2; z where it does not say.
int read_axis(const JsonNode& shape);

OrderedJson body_to_json(const Shape& shape, const Pose& pose);

}  // namespace touchstone
