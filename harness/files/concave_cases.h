// Cases whose bodies need not be convex. Bodies have the format of cases: the shapes of case_json.h, and
//     {"type": "mesh", "vertices": [[x,y,z]...], "triangles": [[i,j,k]...], "solid": true or false}
//     {"type": "compound", "parts": [{"shape": ..., "translation": ..., "rotation": ...}...]}
// where a part is placed like a body, and may be a compound. In cases a shape may also name the file of a mesh
// (MeshFiles). Of a mesh among them each triangle is a part, a flat hull; if it is solid, what it winds around
// belongs to the body too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/pose.h"
#include "harness/files/case_json.h"
#include "harness/files/cases.h"
#include "harness/files/json_line.h"

namespace touchstone::files {

// True for {"mesh":"FILE"}, a shape that is in a file.
bool is_mesh_file(const JsonNode& shape);
// True for a body that has these keys itself, as in scenes, in place of a shape. Throws InputError if it has both.
bool names_mesh(const JsonNode& body);

// Reads the meshes that the shapes of one file of cases name, each once:
//     {"mesh": "a.obj", "scale": 1 or [1,1,1], "as": "surface", "solid", "hull" or "compound"}
// FILE is relative to the folder of the cases; the scale is 1, and the mesh a surface, unless it is said.
class MeshFiles {
 public:
  struct Read {
    std::string file;
    std::shared_ptr<const ConcaveBody> body;
  };

  // Throws InputError for a file that is not there or no mesh, one without triangles that is not a hull, a solid that
  // is open, and a scale that is not positive or leaves the range of doubles.
  // `shape` may also be a body that names_mesh.
  const ConcaveBody& body(const JsonNode& shape);
  // What was read, each mesh at its scale, in order.
  const std::vector<Read>& all() const { return all_; }

 private:
  std::map<std::string, std::size_t> known_;  // by what the shape says
  std::vector<Read> all_;
};

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

// Reads a file of cases as read_cases does, with meshes and compounds. Throws
// InputError for what read_cases throws it for, and for a triangle without three numbers of
// vertices, a solid whose surface is open, and a mesh file that MeshFiles refuses; `meshes`, if any, gets those that
// were read.
std::vector<ConcaveCase> read_concave_cases(const std::filesystem::path& file,
                                            MeshFiles* meshes = nullptr);

// The case of one line. Without `files` no shape may name one.
ConcaveCase read_concave_case(const JsonNode& line, MeshFiles* files = nullptr);

// The case of two convex bodies.
Case convex_case(const ConcaveCase& c);

}  // namespace touchstone::files
