// Cases whose bodies need not be convex.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/pose.h"
#include "harness/files/cases.h"
#include "harness/files/concave/mesh_files.h"
#include "harness/files/json_line.h"

namespace touchstone::files {

struct ConcaveCase {
  std::string id;
  ConcaveBody a, b;
  Pose pose_a, pose_b;
  bool is_convex = true;  // neither body is a mesh or a compound
  std::int64_t line = 0;  // of the file; 0: it is from none
};

// Reads a file of cases as read_cases does, with meshes and compounds (concave_json.h). Throws
// InputError for what read_cases throws it for, and for a triangle without three numbers of
// vertices, a solid whose surface is open, and a mesh file that MeshFiles refuses; `meshes`, if any, gets those that
// were read.
std::vector<ConcaveCase> read_concave_cases(const std::filesystem::path& file,
                                            MeshFiles* meshes = nullptr);

// The case of one line. Without `files` no shape may name one.
ConcaveCase read_concave_case(const JsonNode& line, MeshFiles* files = nullptr);

// One line, without the line break, that read_concave_cases turns into the same bits. A compound's parts
// are written one by one, each within compounds of its own where the product of its poses was rounded.
std::string to_json(const ConcaveCase& c);

// The case of two convex bodies.
Case convex_case(const ConcaveCase& c);

}  // namespace touchstone::files
