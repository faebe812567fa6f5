// Mesh files that cases name.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/core/mesh/concave_body.h"
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

}  // namespace touchstone::files
