// Reads and writes cases; bodies are in shape_json.
#include "harness/files/cases.h"

#include "harness/files/shape_json.h"

namespace touchstone::files {
namespace {

Case read_case(const JsonNode& node) {
  node.as_object("a case: an object with \"id\", \"a\" and \"b\"");
  Case c;
  c.id = node.at("id", "a string").text("a string");
  read_body(node.at("a", "the first body"), c.shape_a, c.pose_a);
  read_body(node.at("b", "the second body"), c.shape_b, c.pose_b);
  return c;
}

}  // namespace

std::vector<Case> read_cases(const std::filesystem::path& file) {
  std::vector<Case> cases;
  for_each_json_line(file, "case", [&](const JsonNode& line) { cases.push_back(read_case(line)); });
  return cases;
}

std::string to_json(const Case& c) {
  OrderedJson out;
  out["id"] = c.id;
  out["a"] = body_to_json(c.shape_a, c.pose_a);
  out["b"] = body_to_json(c.shape_b, c.pose_b);
  return out.dump();
}

}  // namespace touchstone::files
