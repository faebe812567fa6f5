// Cases: pairs of bodies as JSON, one object per line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/motion.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone::files {

struct Case {
  std::string id;
  Shape shape_a, shape_b;
  Pose pose_a, pose_b;
};

// A pair of bodies that move from time 0 to 1; they rest if nothing else is said.
struct CastCase : Case {
  Motion motion_a, motion_b;
};

// A pair of bodies that need not be convex.
struct ConcaveCase {
  std::string id;
  ConcaveBody a, b;
  Pose pose_a, pose_b;
  bool is_convex = true;  // neither body is a mesh or a compound
  std::int64_t line = 0;  // of the file; 0: it is from none
};

// Reads a file of cases. Throws InputError with file, line, key and the expected value for:
// malformed JSON, an unknown shape, an array of the wrong length, NaN or infinite numbers, a
// negative size, a zero normal or quaternion, an empty hull. Ignores unknown keys. Capsules,
// cylinders and cones along x or y become ones along z by a permutation of the rotation's columns,
// which is exact.
std::vector<Case> read_cases(const std::filesystem::path& file);

// Reads the same with each body's "displacement" (metres) and "rotation_vector" (radians), arrays of
// three numbers; either may be missing, which means zero.
std::vector<CastCase> read_cast_cases(const std::filesystem::path& file);

// One line, without the line break, that read_cases turns into the same bits. Rotations are written
// as matrices.
std::string to_json(const Case& c);
// The same for read_cast_cases.
std::string to_json(const CastCase& c);
// One line, without the line break, that read_concave_cases (concave_cases.h) turns into the same bits. A compound's parts
// are written one by one, each within compounds of its own where the product of its poses was rounded.
std::string to_json(const ConcaveCase& c);

}  // namespace touchstone::files
