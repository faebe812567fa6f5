// Reads and writes certificates of rays and points.
#include "harness/files/ray_certificates.h"

#include <array>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

#include "harness/files/concave_cases.h"
#include "harness/files/proof_json.h"

namespace touchstone::files {
namespace {

using oracle::SceneRayCertificate;
using RayStep = SceneRayCertificate::Step;

constexpr Names<RayStep::Kind, 4> ray_steps = {{{"halve", RayStep::Kind::halve},
                                                {"body", RayStep::Kind::body},
                                                {"own", RayStep::Kind::own_plane},
                                                {"triangle", RayStep::Kind::triangle}}};

RayStep read_ray_step(const JsonNode& node) {
  if (node.value().is_array()) return {RayStep::Kind::plane, read_integers<3>(node)};
  return {read_name(node, ray_steps, "halve, body, own, triangle or a direction"), {}};
}

OrderedJson ray_step_to_json(const RayStep& step) {
  if (step.kind == RayStep::Kind::plane) return integers_to_json(step.direction);
  return name_of(step.kind, ray_steps);
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

namespace {

using oracle::PointCertificate;
using oracle::RayCertificate;

std::int32_t read_winding(const JsonNode& node) {
  const Json& value = node.value();
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  // Numbers that are not negative are unsigned, and may be too great for what is signed.
  const bool is_in_range = value.is_number_unsigned()
                               ? value.get<std::uint64_t>() <= std::uint64_t{most}
                               : value.is_number_integer() && value.get<std::int64_t>() >= -most;
  if (!is_in_range) {
    node.fail(fmt::format("found {}; expected how often the surface winds", node.found()));
  }
  return value.get<std::int32_t>();
}

// The greatest number stands for none.
std::uint32_t read_triangle_number(const JsonNode& node) {
  const std::uint32_t number = read_index(node);
  if (number == oracle::no_triangle) {
    node.fail(fmt::format("found {}; expected the number of a triangle", number));
  }
  return number;
}

using Claim = PointCertificate::Claim;
constexpr std::string_view expected_claims = "nearest, surface, inside or outside";
constexpr Names<Claim, 4> claims = {{{"nearest", Claim::nearest},
                                     {"surface", Claim::surface},
                                     {"inside", Claim::inside},
                                     {"outside", Claim::outside}}};

std::shared_ptr<const TriangleMesh> read_mesh_alone(const JsonNode& shape) {
  shape.as_object("a mesh");
  const JsonNode type = shape.at("type", "\"mesh\"");
  if (type.text("mesh") != "mesh") {
    type.fail(fmt::format("found {}; expected \"mesh\"", type.found()));
  }
  return read_mesh(shape);
}

StoredRayCertificate read_ray(const JsonNode& line) {
  const RayFields fields = read_ray_fields(line);
  StoredRayCertificate stored{fields.ray, {}};
  RayCertificate& certificate = stored.certificate;
  certificate.is_first = fields.is_first;
  certificate.origin = fields.origin;
  certificate.direction = fields.direction;
  certificate.t_max = fields.t_max;
  certificate.hit = read_boolean(line.at("hit", "true or false"));
  if (certificate.hit) {
    certificate.triangle = read_triangle_number(line.at("triangle", "the number of a triangle"));
    certificate.t = read_fraction(line.at("t", "a fraction"));
    return stored;
  }
  for (const char* key : {"triangle", "t"}) {
    if (line.has(key)) line.fail(fmt::format("\"{}\" of a miss; expected none", key));
  }
  return stored;
}

StoredPointCertificate read_at(const JsonNode& line) {
  StoredPointCertificate stored;
  stored.point = read_index(line.at("point", "the number of a point"));
  PointCertificate& certificate = stored.certificate;
  certificate.point = line.at("at", "an array of 3 numbers").vector();
  certificate.claim = read_name(line.at("claim", expected_claims), claims, expected_claims);
  if (certificate.claim == Claim::surface) return stored;
  if (certificate.claim != Claim::nearest) {
    certificate.winding = read_winding(line.at("winding", "how often the surface winds"));
    return stored;
  }
  if (!line.has("triangle") && !line.has("square")) return stored;
  certificate.triangle = read_triangle_number(line.at("triangle", "the number of a triangle"));
  certificate.square = read_fraction(line.at("square", "a fraction"));
  return stored;
}

}  // namespace

std::string mesh_line(const TriangleMesh& mesh) {
  OrderedJson out;
  out["mesh"] = mesh_to_json(mesh);
  return out.dump();
}

std::string to_json(const StoredRayCertificate& stored) {
  const RayCertificate& certificate = stored.certificate;
  OrderedJson out = ray_fields_to_json({stored.ray, certificate.is_first, certificate.origin,
                                        certificate.direction, certificate.t_max});
  out["hit"] = certificate.hit;
  if (certificate.hit) {
    out["triangle"] = certificate.triangle;
    out["t"] = fraction_to_json(certificate.t);
  }
  return out.dump();
}

std::string to_json(const StoredPointCertificate& stored) {
  const PointCertificate& certificate = stored.certificate;
  OrderedJson out;
  out["point"] = stored.point;
  out["at"] = {certificate.point.x(), certificate.point.y(), certificate.point.z()};
  out["claim"] = name_of(certificate.claim, claims);
  if (certificate.claim == Claim::inside || certificate.claim == Claim::outside) {
    out["winding"] = certificate.winding;
  } else if (certificate.triangle != oracle::no_triangle) {
    out["triangle"] = certificate.triangle;
    out["square"] = fraction_to_json(certificate.square);
  }
  return out.dump();
}

void read_ray_certificates(const std::filesystem::path& file, const RayTargets& targets) {
  enum class Target : std::uint8_t { none, mesh, scene } target = Target::none;
  for_each_json_line(file, "certificate", [&](const JsonNode& line) {
    line.as_object("a certificate, or an object with \"mesh\" or \"bodies\"");
    if (line.has("mesh")) {
      targets.mesh(*read_mesh_alone(line.at("mesh", "a mesh")));
      target = Target::mesh;
    } else if (line.has("bodies")) {
      targets.scene(read_scene_line(line));
      target = Target::scene;
    } else if (target == Target::mesh) {
      targets.at_mesh(read_ray(line), line.line());
    } else if (target == Target::scene) {
      targets.at_scene(read_scene_ray(line), line.line());
    } else {
      line.fail(
          "a certificate before any mesh or scene; expected an object with \"mesh\" or \"bodies\"");
    }
  });
}

void read_point_certificates(
    const std::filesystem::path& file, const std::function<void(const TriangleMesh&)>& mesh,
    const std::function<void(const StoredPointCertificate&, std::int64_t line)>& each) {
  bool has_mesh = false;
  for_each_json_line(file, "certificate", [&](const JsonNode& line) {
    line.as_object("a certificate, or an object with \"mesh\"");
    if (line.has("mesh")) {
      mesh(*read_mesh_alone(line.at("mesh", "a mesh")));
      has_mesh = true;
      return;
    }
    if (!has_mesh) line.fail("a certificate before any mesh; expected an object with \"mesh\"");
    each(read_at(line), line.line());
  });
}

}  // namespace touchstone::files
