// Reads and writes certificates of casts.
#include "harness/files/proofs/cast_certificates.h"

#include "harness/files/motion/case_json.h"
#include "harness/files/proofs/proof_json.h"

namespace touchstone::files {
namespace {

using oracle::CastCertificate;

CastCertificate::Plane read_plane(const JsonNode& node) {
  node.as_object("a plane: an object with \"until\" and \"direction\"");
  return {read_fraction(node.at("until", "a time")),
          read_integers<3>(node.at("direction", "an array of 3 integers in strings"))};
}

}  // namespace

std::string to_json(const StoredCastCertificate& stored) {
  const CastCertificate& certificate = stored.certificate;
  OrderedJson out = to_ordered_json(stored.of);
  out["answer"] = to_string(certificate.answer);
  out["lower"] = fraction_to_json(certificate.lower);
  out["upper"] = fraction_to_json(certificate.upper);
  out["planes"] = OrderedJson::array();
  for (const auto& [until, direction] : certificate.planes) {
    out["planes"].push_back(
        {{"until", fraction_to_json(until)}, {"direction", integers_to_json(direction)}});
  }
  out["generators_a"] = generators_to_json(certificate.a);
  out["generators_b"] = generators_to_json(certificate.b);
  out["closest"] = terms_to_json(certificate.closest);
  out["surface"] = surface_to_json(certificate.surface);
  out["feature"] = OrderedJson::array();
  for (const auto& [a, b] : certificate.feature) out["feature"].push_back({a, b});
  out["polynomial"] = integers_to_json(certificate.polynomial);
  return out.dump();
}

void read_cast_certificates(
    const std::filesystem::path& file,
    const std::function<void(const StoredCastCertificate& certificate, std::int64_t line)>& each) {
  for_each_json_line(file, "certificate", [&](const JsonNode& line) {
    StoredCastCertificate stored{read_cast_case(line), {}};
    line.at("id", "a string");  // a proof names its case
    CastCertificate& certificate = stored.certificate;
    certificate.answer = read_cast_answer(line.at("answer", "an answer"));
    certificate.lower = read_fraction(line.at("lower", "a time"));
    certificate.upper = read_fraction(line.at("upper", "a time"));
    certificate.planes = read_list(line.at("planes", "an array"), "an array of planes", read_plane);
    certificate.a = read_generators(line.at("generators_a", "an array"));
    certificate.b = read_generators(line.at("generators_b", "an array"));
    certificate.closest = read_terms(line.at("closest", "an array"));
    certificate.surface =
        read_surface(line.at("surface", "an object with \"points\" and \"triangles\""));
    certificate.feature =
        read_list(line.at("feature", "an array"), "an array of pairs of indices", read_point);
    certificate.polynomial =
        read_integers<3>(line.at("polynomial", "an array of 3 integers in strings"));
    each(stored, line.line());
  });
}

}  // namespace touchstone::files
