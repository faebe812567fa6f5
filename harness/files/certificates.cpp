// Reads and writes certificates of bodies at rest and of casts; bodies are in case_json.
#include "harness/files/certificates.h"

#include <string_view>

#include "harness/files/case_json.h"
#include "harness/files/proof_json.h"

namespace touchstone::files {
namespace {

using oracle::Certificate;
using oracle::SignedRoot;

// --- reading ---

Answer read_answer(const JsonNode& node) {
  constexpr Names<Answer, 4> names = {{{"separated", Answer::separated},
                                       {"touching", Answer::touching},
                                       {"overlapping", Answer::overlapping},
                                       {"unknown", Answer::unknown}}};
  return read_name(node, names, "separated, touching, overlapping or unknown");
}

SignedRoot read_root(const JsonNode& node) {
  node.as_object("an object with \"sign\", \"numerator\" and \"denominator\"");
  const JsonNode sign = node.at("sign", "-1, 0 or 1");
  const Json& value = sign.value();
  if (!value.is_number_integer() || (value != -1 && value != 0 && value != 1)) {
    sign.fail(fmt::format("found {}; expected -1, 0 or 1", sign.found()));
  }
  return {value.get<int>(), read_integer(node.at("numerator", "an integer in a string")),
          read_integer(node.at("denominator", "an integer in a string"))};
}

void read_exact_body(const JsonNode& body, Shape& shape, Pose& pose,
                     std::optional<std::array<double, 4>>& quaternion) {
  read_body(body, shape, pose);
  if (!body.has("quaternion_exact")) return;
  for (const char* other : {"rotation", "quaternion_wxyz"}) {
    if (body.has(other)) {
      body.fail(fmt::format("both \"quaternion_exact\" and \"{}\"; expected one of them", other));
    }
  }
  const JsonNode parts = body.at("quaternion_exact", "");
  quaternion = parts.numbers<4>();
  if (*quaternion == std::array<double, 4>{}) parts.fail("the zero quaternion");
  if (pose.rotation != Mat3d::Identity()) {
    body.fail("another axis than z with \"quaternion_exact\"; expected \"rotation\"");
  }
}

StoredCertificate read_certificate(const JsonNode& node) {
  node.as_object("a certificate: an object with \"id\", \"a\", \"b\", \"answer\" and its proof");
  StoredCertificate stored;
  stored.id = node.at("id", "a string").text("a string");
  stored.encoding = node.at("encoding", "a string").text("a string");
  read_exact_body(node.at("a", "the first body"), stored.shape_a, stored.pose_a,
                  stored.quaternion_a);
  read_exact_body(node.at("b", "the second body"), stored.shape_b, stored.pose_b,
                  stored.quaternion_b);
  Certificate& certificate = stored.certificate;
  certificate.answer = read_answer(node.at("answer", "an answer"));
  certificate.lower = read_root(node.at("lower", "a signed root"));
  certificate.upper = read_root(node.at("upper", "a signed root"));
  certificate.direction =
      read_integers<3>(node.at("direction", "an array of 3 integers in strings"));
  read_common_point(node, certificate);
  return stored;
}

// --- writing ---

OrderedJson root_to_json(const SignedRoot& root) {
  return {{"sign", root.sign},
          {"numerator", root.numerator.str()},
          {"denominator", root.denominator.str()}};
}

OrderedJson exact_body_to_json(const Shape& shape, const Pose& pose,
                               const std::optional<std::array<double, 4>>& quaternion) {
  OrderedJson body = body_to_json(shape, pose);
  if (quaternion) {
    body.erase("rotation");
    body["quaternion_exact"] = *quaternion;
  }
  return body;
}

}  // namespace

std::string to_json(const StoredCertificate& stored) {
  const Certificate& certificate = stored.certificate;
  OrderedJson out;
  out["id"] = stored.id;
  out["encoding"] = stored.encoding;
  out["a"] = exact_body_to_json(stored.shape_a, stored.pose_a, stored.quaternion_a);
  out["b"] = exact_body_to_json(stored.shape_b, stored.pose_b, stored.quaternion_b);
  out["answer"] = to_string(certificate.answer);
  out["lower"] = root_to_json(certificate.lower);
  out["upper"] = root_to_json(certificate.upper);
  out["direction"] = integers_to_json(certificate.direction);
  add_common_point(out, certificate);
  return out.dump();
}

void read_certificates(
    const std::filesystem::path& file,
    const std::function<void(const StoredCertificate& certificate, std::int64_t line)>& each) {
  for_each_json_line(file, "certificate",
                     [&](const JsonNode& line) { each(read_certificate(line), line.line()); });
}

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
  add_common_point(out, certificate);
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
    read_common_point(line, certificate);
    certificate.feature =
        read_list(line.at("feature", "an array"), "an array of pairs of indices", read_point);
    certificate.polynomial =
        read_integers<3>(line.at("polynomial", "an array of 3 integers in strings"));
    each(stored, line.line());
  });
}

}  // namespace touchstone::files
