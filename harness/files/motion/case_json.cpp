// Reads and writes cases as objects; bodies are in shape_json.
#include "harness/files/motion/case_json.h"

#include "harness/files/shape_json.h"

namespace touchstone::files {
namespace {

Motion read_motion(const JsonNode& body) {
  Motion motion;
  if (body.has("displacement")) motion.displacement = body.at("displacement", "").vector();
  if (body.has("rotation_vector")) motion.rotation_vector = body.at("rotation_vector", "").vector();
  return motion;
}

}  // namespace

std::string read_id(const JsonNode& line) {
  return line.has("id") ? line.at("id", "").text("a string") : fmt::format("{}", line.line());
}

void read_case(const JsonNode& line, Case& c) {
  line.as_object("a case: an object with \"a\" and \"b\"");
  c.id = read_id(line);
  read_body(line.at("a", "the first body"), c.shape_a, c.pose_a);
  read_body(line.at("b", "the second body"), c.shape_b, c.pose_b);
}

CastCase read_cast_case(const JsonNode& line) {
  CastCase c;
  read_case(line, c);
  c.motion_a = read_motion(line.at("a", "the first body"));
  c.motion_b = read_motion(line.at("b", "the second body"));
  return c;
}

OrderedJson to_ordered_json(const CastCase& c) {
  const auto body = [](const Shape& shape, const Pose& pose, const Motion& motion) {
    OrderedJson out = body_to_json(shape, pose);
    const auto add = [&](const char* key, const Vec3d& v) { out[key] = {v.x(), v.y(), v.z()}; };
    add("displacement", motion.displacement);
    add("rotation_vector", motion.rotation_vector);
    return out;
  };
  OrderedJson out;
  out["id"] = c.id;
  out["a"] = body(c.shape_a, c.pose_a, c.motion_a);
  out["b"] = body(c.shape_b, c.pose_b, c.motion_b);
  return out;
}

}  // namespace touchstone::files
