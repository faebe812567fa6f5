// Reads and writes cases with meshes and compounds.
#include "harness/files/concave/concave_cases.h"

#include "harness/files/concave/concave_json.h"
#include "harness/files/concave/key_warnings.h"
#include "harness/files/motion/case_json.h"

namespace touchstone::files {
namespace {

bool names_convex(const JsonNode& body, const ConcaveBody& read) {
  if (names_mesh(body)) return !read.mesh && read.parts.size() == 1;
  const JsonNode shape = body.at("shape", "");
  if (is_mesh_file(shape)) return !read.mesh && read.parts.size() == 1;
  const std::string& type = shape.at("type", "a shape's name").text("a shape's name");
  return type != "mesh" && type != "compound";
}

}  // namespace

ConcaveCase read_concave_case(const JsonNode& line, MeshFiles* files) {
  line.as_object("a case: an object with \"a\" and \"b\"");
  ConcaveCase c;
  c.line = line.line();
  c.id = read_id(line);
  const JsonNode a = line.at("a", "the first body"), b = line.at("b", "the second body");
  c.a = read_concave_body(a, c.pose_a, files);
  c.b = read_concave_body(b, c.pose_b, files);
  c.is_convex = names_convex(a, c.a) && names_convex(b, c.b);
  return c;
}

std::vector<ConcaveCase> read_concave_cases(const std::filesystem::path& file, MeshFiles* meshes) {
  std::vector<ConcaveCase> cases;
  MeshFiles own;
  MeshFiles* const files = meshes != nullptr ? meshes : &own;
  KeyWarnings warnings;
  for_each_json_line(file, "case", [&](const JsonNode& line) {
    cases.push_back(read_concave_case(line, files));
    warnings.look(line);
  });
  return cases;
}

std::string to_json(const ConcaveCase& c) {
  OrderedJson out;
  out["id"] = c.id;
  out["a"] = concave_body_to_json(c.a, c.pose_a);
  out["b"] = concave_body_to_json(c.b, c.pose_b);
  return out.dump();
}

Case convex_case(const ConcaveCase& c) {
  return {c.id, c.a.parts[0].shape, c.b.parts[0].shape, c.pose_a, c.pose_b};
}

}  // namespace touchstone::files
