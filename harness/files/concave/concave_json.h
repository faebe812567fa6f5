// Bodies that need not be convex, in the format of cases: the shapes of shape_json.h, and
//     {"type": "mesh", "vertices": [[x,y,z]...], "triangles": [[i,j,k]...], "solid": true or false}
//     {"type": "compound", "parts": [{"shape": ..., "translation": ..., "rotation": ...}...]}
// where a part is placed like a body, and may be a compound. In cases a shape may also name the file of a mesh
// (mesh_files.h). Of a mesh among them each triangle is a part, a
// flat hull; if it is solid, what it winds around belongs to the body too.
#pragma once

#include <memory>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/pose.h"
#include "harness/files/concave/mesh_files.h"
#include "harness/files/json_line.h"
#include "harness/files/shape_json.h"

namespace touchstone::files {

// Throws InputError as described at read_concave_cases. Parts of nested compounds are numbered depth
// first. Without `files` no shape may name one: a proof is of what is in it.
ConcaveBody read_concave_body(const JsonNode& body, Pose& pose, MeshFiles* files = nullptr);

// Throws InputError if the surface of a solid is open; `said` is what makes it one.
void check_closed(const JsonNode& shape, const TriangleMesh& mesh, std::string_view said);

// The shape of a mesh.
std::shared_ptr<const TriangleMesh> read_mesh(const JsonNode& shape);
OrderedJson mesh_to_json(const TriangleMesh& mesh);

// A body of one convex part at its origin is written as that shape.
OrderedJson concave_body_to_json(const ConcaveBody& body, const Pose& pose);

}  // namespace touchstone::files
