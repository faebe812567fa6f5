// Reads and writes certificates of rays at scenes.
#include "harness/files/proofs/scene_ray_certificates.h"

#include <array>
#include <string_view>
#include <utility>

#include "harness/files/concave/concave_json.h"
#include "harness/files/proofs/proof_json.h"
#include "harness/files/proofs/ray_json.h"

namespace touchstone::files {
namespace {

using oracle::SceneRayCertificate;
using RayStep = SceneRayCertificate::Step;

constexpr std::array<std::pair<std::string_view, RayStep::Kind>, 4> ray_steps = {
    {{"halve", RayStep::Kind::halve},
     {"body", RayStep::Kind::body},
     {"own", RayStep::Kind::own_plane},
     {"triangle", RayStep::Kind::triangle}}};

RayStep read_ray_step(const JsonNode& node) {
  if (node.value().is_array()) return {RayStep::Kind::plane, read_integers<3>(node)};
  constexpr std::string_view expected = "halve, body, own, triangle or a direction";
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

SceneRayCertificate::Cover read_cover(const JsonNode& node) {
  constexpr std::string_view expected = "an object with \"order\" and \"steps\"";
  node.as_object(expected);
  return {read_list(node.at("order", "an array of numbers"), "an array of numbers", read_index),
          read_list(node.at("steps", "an array of steps"), "an array of steps", read_ray_step)};
}

OrderedJson cover_to_json(const SceneRayCertificate::Cover& cover) {
  OrderedJson out;
  out["order"] = cover.order;
  out["steps"] = OrderedJson::array();
  for (const RayStep& step : cover.steps) out["steps"].push_back(ray_step_to_json(step));
  return out;
}

}  // namespace

StoredSceneRayCertificate read_scene_ray(const JsonNode& line) {
  const RayFields fields = read_ray_fields(line);
  StoredSceneRayCertificate stored{fields.ray, {}};
  SceneRayCertificate& certificate = stored.certificate;
  certificate.is_first = fields.is_first;
  certificate.is_ordered = read_boolean(line.at("ordered", "true or false"));
  certificate.origin = fields.origin;
  certificate.direction = fields.direction;
  certificate.t_max = fields.t_max;
  certificate.answer = read_cast_answer(line.at("answer", "an answer"));
  certificate.lower = read_fraction(line.at("lower", "a time"));
  certificate.upper = read_fraction(line.at("upper", "a time"));
  certificate.body = read_index(line.at("body", "the number of a body"));
  certificate.part = read_index(line.at("part", "the number of a part"));
  certificate.generators = read_generators(line.at("generators", "an array"));
  certificate.surface =
      read_surface(line.at("surface", "an object with \"points\" and \"triangles\""));
  certificate.cover = read_cover(line.at("cover", "an object with \"order\" and \"steps\""));
  certificate.of_bodies =
      read_list(line.at("of_bodies", "an array of covers"), "an array of covers", read_cover);
  return stored;
}

std::string scene_line(std::span<const PlacedConcave> bodies) {
  OrderedJson out;
  out["bodies"] = OrderedJson::array();
  for (const auto& [body, pose] : bodies) out["bodies"].push_back(concave_body_to_json(body, pose));
  return out.dump();
}

std::vector<PlacedConcave> read_scene_line(const JsonNode& line) {
  return read_list(line.at("bodies", "an array of bodies"), "an array of bodies",
                   [](const JsonNode& node) {
                     PlacedConcave placed;
                     placed.body = read_concave_body(node, placed.pose);
                     return placed;
                   });
}

std::string to_json(const StoredSceneRayCertificate& stored) {
  const SceneRayCertificate& certificate = stored.certificate;
  OrderedJson out = ray_fields_to_json({stored.ray, certificate.is_first, certificate.origin,
                                        certificate.direction, certificate.t_max});
  out["ordered"] = certificate.is_ordered;
  out["answer"] = to_string(certificate.answer);
  out["lower"] = fraction_to_json(certificate.lower);
  out["upper"] = fraction_to_json(certificate.upper);
  out["body"] = certificate.body;
  out["part"] = certificate.part;
  out["generators"] = generators_to_json(certificate.generators);
  out["surface"] = surface_to_json(certificate.surface);
  out["cover"] = cover_to_json(certificate.cover);
  out["of_bodies"] = OrderedJson::array();
  for (const auto& cover : certificate.of_bodies) out["of_bodies"].push_back(cover_to_json(cover));
  return out.dump();
}

}  // namespace touchstone::files
