// Bodies in the format of cases: {"shape": {"type": ...}, "translation": ..., "rotation": ...}.
#pragma once

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "harness/files/json_line.h"

namespace touchstone::files {

// Throws InputError as described at read_cases. An axis other than z becomes z by a permutation of
// the rotation's columns. `others` are names of shapes that the caller takes, for the message about one that
// nobody knows.
void read_body(const JsonNode& body, Shape& shape, Pose& pose, std::string_view others = "");

// The translation and the rotation of a body; those that are missing are zero and the identity.
Pose read_pose(const JsonNode& body);

// The axis of a capsule, cylinder or cone: 0, 1 or 2; z if the key is missing.
int read_axis(const JsonNode& shape);

OrderedJson body_to_json(const Shape& shape, const Pose& pose);

}  // namespace touchstone::files
