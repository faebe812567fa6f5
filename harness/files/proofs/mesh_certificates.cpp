// Reads and writes certificates of rays and points at meshes.
#include "harness/files/proofs/mesh_certificates.h"

#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "harness/files/concave/concave_json.h"
#include "harness/files/proofs/proof_json.h"

namespace touchstone::files {
namespace {

using oracle::PointCertificate;
using oracle::RayCertificate;

double read_end(const JsonNode& node) {
  if (node.value() == "inf") return std::numeric_limits<double>::infinity();
  if (!node.value().is_number()) {
    node.fail(fmt::format("found {}; expected a number, or \"inf\"", node.found()));
  }
  return node.number();
}

bool read_boolean(const JsonNode& node) {
  if (!node.value().is_boolean()) {
    node.fail(fmt::format("found {}; expected true or false", node.found()));
  }
  return node.value().get<bool>();
}

std::int32_t read_winding(const JsonNode& node) {
  const Json& value = node.value();
  constexpr auto most = std::numeric_limits<std::int32_t>::max();
  if (!value.is_number_integer() || value < -std::int64_t{most} || value > std::int64_t{most}) {
    node.fail(fmt::format("found {}; expected how often the surface winds", node.found()));
  }
  return value.get<std::int32_t>();
}

bool is_first(const JsonNode& node) {
  const std::string& text = node.text("closest or any");
  if (text != "closest" && text != "any") {
    node.fail(fmt::format("found {}; expected closest or any", node.found()));
  }
  return text == "closest";
}

using Claim = PointCertificate::Claim;
constexpr std::string_view expected_claims = "nearest, surface, inside or outside";
constexpr std::array<std::pair<std::string_view, Claim>, 4> claims = {
    {{"nearest", Claim::nearest},
     {"surface", Claim::surface},
     {"inside", Claim::inside},
     {"outside", Claim::outside}}};

Claim read_claim(const JsonNode& node) {
  const std::string& text = node.text(expected_claims);
  for (const auto& [name, claim] : claims) {
    if (text == name) return claim;
  }
  node.fail(fmt::format("found {}; expected {}", node.found(), expected_claims));
}

std::string_view name_of(Claim claim) { return claims[static_cast<std::size_t>(claim)].first; }

std::uint64_t read_number(const JsonNode& node) { return read_index(node); }

StoredRayCertificate read_ray(const JsonNode& line) {
  StoredRayCertificate stored;
  stored.ray = read_number(line.at("ray", "the number of a ray"));
  RayCertificate& certificate = stored.certificate;
  certificate.is_first = is_first(line.at("task", "closest or any"));
  certificate.origin = line.at("origin", "an array of 3 numbers").vector();
  certificate.direction = line.at("direction", "an array of 3 numbers").vector();
  certificate.t_max = read_end(line.at("t_max", "a number, or \"inf\""));
  certificate.hit = read_boolean(line.at("hit", "true or false"));
  if (certificate.hit) {
    certificate.triangle = read_index(line.at("triangle", "the number of a triangle"));
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
  stored.point = read_number(line.at("point", "the number of a point"));
  PointCertificate& certificate = stored.certificate;
  certificate.point = line.at("at", "an array of 3 numbers").vector();
  certificate.claim = read_claim(line.at("claim", expected_claims));
  if (certificate.claim == Claim::surface) return stored;
  if (certificate.claim != Claim::nearest) {
    certificate.winding = read_winding(line.at("winding", "how often the surface winds"));
    return stored;
  }
  if (!line.has("triangle") && !line.has("square")) return stored;
  certificate.triangle = read_index(line.at("triangle", "the number of a triangle"));
  certificate.square = read_fraction(line.at("square", "a fraction"));
  return stored;
}

OrderedJson vector_to_json(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }

template <class Read, class Each>
void read_at_meshes(const std::filesystem::path& file,
                    const std::function<void(const TriangleMesh&)>& mesh, const Read& read,
                    const Each& each) {
  bool has_mesh = false;
  for_each_json_line(file, "certificate", [&](const JsonNode& line) {
    line.as_object("a certificate, or an object with \"mesh\"");
    if (line.has("mesh")) {
      mesh(*read_mesh(line.at("mesh", "a mesh")));
      has_mesh = true;
      return;
    }
    if (!has_mesh) line.fail("a certificate before any mesh; expected an object with \"mesh\"");
    each(read(line), line.line());
  });
}

}  // namespace

std::string mesh_line(const TriangleMesh& mesh) {
  OrderedJson out;
  out["mesh"] = mesh_to_json(mesh);
  return out.dump();
}

std::string to_json(const StoredRayCertificate& stored) {
  const RayCertificate& certificate = stored.certificate;
  OrderedJson out;
  out["ray"] = stored.ray;
  out["task"] = certificate.is_first ? "closest" : "any";
  out["origin"] = vector_to_json(certificate.origin);
  out["direction"] = vector_to_json(certificate.direction);
  if (std::isfinite(certificate.t_max)) {
    out["t_max"] = certificate.t_max;
  } else {
    out["t_max"] = "inf";
  }
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
  out["at"] = vector_to_json(certificate.point);
  out["claim"] = name_of(certificate.claim);
  if (certificate.claim == Claim::inside || certificate.claim == Claim::outside) {
    out["winding"] = certificate.winding;
  } else if (certificate.triangle != oracle::no_triangle) {
    out["triangle"] = certificate.triangle;
    out["square"] = fraction_to_json(certificate.square);
  }
  return out.dump();
}

void read_ray_certificates(
    const std::filesystem::path& file, const std::function<void(const TriangleMesh&)>& mesh,
    const std::function<void(const StoredRayCertificate&, std::int64_t line)>& each) {
  read_at_meshes(file, mesh, read_ray, each);
}

void read_point_certificates(
    const std::filesystem::path& file, const std::function<void(const TriangleMesh&)>& mesh,
    const std::function<void(const StoredPointCertificate&, std::int64_t line)>& each) {
  read_at_meshes(file, mesh, read_at, each);
}

}  // namespace touchstone::files
