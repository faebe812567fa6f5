// Reads and writes cases; bodies are in shape_json.
#include "harness/files/cases.h"

#include <array>

#include "harness/files/shape_json.h"

namespace touchstone::files {
namespace {

void read_case(const JsonNode& node, Case& c) {
  node.as_object("a case: an object with \"id\", \"a\" and \"b\"");
  c.id = node.at("id", "a string").text("a string");
  read_body(node.at("a", "the first body"), c.shape_a, c.pose_a);
  read_body(node.at("b", "the second body"), c.shape_b, c.pose_b);
}

Motion read_motion(const JsonNode& body) {
  Motion motion;
  if (body.has("displacement")) motion.displacement = body.at("displacement", "").vector();
  if (body.has("rotation_vector")) motion.rotation_vector = body.at("rotation_vector", "").vector();
  return motion;
}

}  // namespace

std::vector<Case> read_cases(const std::filesystem::path& file) {
  std::vector<Case> cases;
  for_each_json_line(file, "case",
                     [&](const JsonNode& line) { read_case(line, cases.emplace_back()); });
  return cases;
}

std::vector<CastCase> read_cast_cases(const std::filesystem::path& file) {
  std::vector<CastCase> cases;
  for_each_json_line(file, "case", [&](const JsonNode& line) {
    CastCase& c = cases.emplace_back();
    read_case(line, c);
    c.motion_a = read_motion(line.at("a", "the first body"));
    c.motion_b = read_motion(line.at("b", "the second body"));
  });
  return cases;
}

std::string to_json(const Case& c) {
  OrderedJson out;
  out["id"] = c.id;
  out["a"] = body_to_json(c.shape_a, c.pose_a);
  out["b"] = body_to_json(c.shape_b, c.pose_b);
  return out.dump();
}

std::string to_json(const CastCase& c) {
  const auto moving = [](const Shape& shape, const Pose& pose, const Motion& motion) {
    const auto numbers = [](const Vec3d& v) { return std::array{v.x(), v.y(), v.z()}; };
    OrderedJson body = body_to_json(shape, pose);
    body["displacement"] = numbers(motion.displacement);
    body["rotation_vector"] = numbers(motion.rotation_vector);
    return body;
  };
  OrderedJson out;
  out["id"] = c.id;
  out["a"] = moving(c.shape_a, c.pose_a, c.motion_a);
  out["b"] = moving(c.shape_b, c.pose_b, c.motion_b);
  return out.dump();
}

}  // namespace touchstone::files
