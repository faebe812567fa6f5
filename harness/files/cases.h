// Cases: pairs of bodies as JSON, one object a line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

struct Case {
  std::string id;
  Shape shape_a, shape_b;
  Pose pose_a, pose_b;
};

// Reads a file of cases. Throws InputError naming file, line, key and what was expected: malformed
// JSON, an unknown shape, a missing or extra-long array, NaN or infinite numbers, a negative size,
// a zero normal or quaternion, an empty hull. Unknown keys are ignored. Capsules, cylinders and
// cones along x or y are turned into ones along z by permuting the columns of the rotation, which
// is exact.
std::vector<Case> read_cases(const std::filesystem::path& file);

// One line, without the line break, that read_cases turns into the same bits (as far as the case is
// in the format: rotations are written as matrices).
std::string to_json(const Case& c);

}  // namespace touchstone
