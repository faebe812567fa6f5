// Reads and writes certificates of rays at bodies.
#include "harness/files/proofs/body_ray_certificates.h"

#include <array>
#include <string_view>
#include <utility>

#include "harness/files/concave/concave_json.h"
#include "harness/files/proofs/proof_json.h"
#include "harness/files/proofs/ray_json.h"

namespace touchstone::files {
namespace {

using oracle::BodyRayCertificate;
using RayStep = BodyRayCertificate::Step;

constexpr std::array<std::pair<std::string_view, RayStep::Kind>, 3> ray_steps = {
    {{"halve", RayStep::Kind::halve},
     {"own", RayStep::Kind::own_plane},
     {"triangle", RayStep::Kind::triangle}}};

RayStep read_ray_step(const JsonNode& node) {
  if (node.value().is_array()) return {RayStep::Kind::plane, read_integers<3>(node)};
  constexpr std::string_view expected = "halve, own, triangle or a direction";
  const std::string& text = node.text(expected);
  for (const auto& [name, kind] : ray_steps) {
    if (text == name) return {kind, {}};
  }
  node.fail(fmt::format("found {}; expected {}", node.found(), expected));
}

OrderedJson ray_step_to_json(const RayStep& step) {
  for (const auto& [name, kind] : ray_steps) {
    if (step.kind == kind) return name;
  }
  return integers_to_json(step.direction);
}

}  // namespace

StoredBodyRayCertificate read_body_ray(const JsonNode& line) {
  const RayFields fields = read_ray_fields(line);
  StoredBodyRayCertificate stored{fields.ray, {}};
  BodyRayCertificate& certificate = stored.certificate;
  certificate.is_first = fields.is_first;
  certificate.origin = fields.origin;
  certificate.direction = fields.direction;
  certificate.t_max = fields.t_max;
  certificate.answer = read_cast_answer(line.at("answer", "an answer"));
  certificate.lower = read_fraction(line.at("lower", "a time"));
  certificate.upper = read_fraction(line.at("upper", "a time"));
  certificate.part = read_index(line.at("part", "the number of a part"));
  certificate.generators = read_generators(line.at("generators", "an array"));
  certificate.surface =
      read_surface(line.at("surface", "an object with \"points\" and \"triangles\""));
  certificate.order =
      read_list(line.at("order", "an array of parts"), "an array of parts", read_index);
  certificate.cover =
      read_list(line.at("cover", "an array of steps"), "an array of steps", read_ray_step);
  return stored;
}

std::string body_line(const ConcaveBody& body, const Pose& pose) {
  OrderedJson out;
  out["body"] = concave_body_to_json(body, pose);
  return out.dump();
}

std::string to_json(const StoredBodyRayCertificate& stored) {
  const BodyRayCertificate& certificate = stored.certificate;
  OrderedJson out = ray_fields_to_json({stored.ray, certificate.is_first, certificate.origin,
                                        certificate.direction, certificate.t_max});
  out["answer"] = to_string(certificate.answer);
  out["lower"] = fraction_to_json(certificate.lower);
  out["upper"] = fraction_to_json(certificate.upper);
  out["part"] = certificate.part;
  out["generators"] = generators_to_json(certificate.generators);
  out["surface"] = surface_to_json(certificate.surface);
  out["order"] = certificate.order;
  out["cover"] = OrderedJson::array();
  for (const RayStep& step : certificate.cover) out["cover"].push_back(ray_step_to_json(step));
  return out.dump();
}

}  // namespace touchstone::files
