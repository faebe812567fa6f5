// Rays in certificates.
#include "harness/files/proofs/ray_json.h"

#include <cmath>
#include <limits>

#include "harness/files/proofs/proof_json.h"

namespace touchstone::files {
namespace {

double read_end(const JsonNode& node) {
  if (node.value() == "inf") return std::numeric_limits<double>::infinity();
  if (!node.value().is_number()) {
    node.fail(fmt::format("found {}; expected a number, or \"inf\"", node.found()));
  }
  return node.number();
}

bool is_first(const JsonNode& node) {
  const std::string& text = node.text("closest or any");
  if (text != "closest" && text != "any") {
    node.fail(fmt::format("found {}; expected closest or any", node.found()));
  }
  return text == "closest";
}

OrderedJson vector_to_json(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

RayFields read_ray_fields(const JsonNode& line) {
  return {read_index(line.at("ray", "the number of a ray")),
          is_first(line.at("task", "closest or any")),
          line.at("origin", "an array of 3 numbers").vector(),
          line.at("direction", "an array of 3 numbers").vector(),
          read_end(line.at("t_max", "a number, or \"inf\""))};
}

OrderedJson ray_fields_to_json(const RayFields& fields) {
  OrderedJson out;
  out["ray"] = fields.ray;
  out["task"] = fields.is_first ? "closest" : "any";
  out["origin"] = vector_to_json(fields.origin);
  out["direction"] = vector_to_json(fields.direction);
  if (std::isfinite(fields.t_max)) {
    out["t_max"] = fields.t_max;
  } else {
    out["t_max"] = "inf";
  }
  return out;
}

}  // namespace touchstone::files
