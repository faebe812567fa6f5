// Reads and writes certificates; bodies are in shape_json.
#include "harness/files/certificates.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <vector>

#include "harness/files/shape_json.h"

namespace touchstone::files {
namespace {

using oracle::Certificate;
using oracle::Generator;
using oracle::Integer;
using oracle::SignedRoot;

// --- reading ---

std::uint32_t read_index(const JsonNode& node) {
  const Json& value = node.value();
  if (!value.is_number_unsigned() ||
      value.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
    node.fail(fmt::format("found {}; expected an index", node.found()));
  }
  return value.get<std::uint32_t>();
}

Integer read_integer(const JsonNode& node) {
  constexpr std::string_view expected = "an integer in a string, such as \"-12\"";
  const std::string& text = node.text(expected);
  const std::string_view digits = std::string_view(text).substr(text.starts_with('-') ? 1 : 0);
  const bool zero_first = digits.starts_with('0') && text != "0";
  if (digits.empty() || zero_first ||
      digits.find_first_not_of("0123456789") != std::string_view::npos) {
    node.fail(fmt::format("found {}; expected {}", node.found(), expected));
  }
  return Integer(text);
}

long double read_hexadecimal(const JsonNode& node) {
  constexpr std::string_view expected = "a hexadecimal number in a string, such as \"0x1.8p-1\"";
  const std::string& text = node.text(expected);
  char* end = nullptr;
  errno = 0;
  const long double x = std::strtold(text.c_str(), &end);
  const bool hexadecimal = text.starts_with("0x") || text.starts_with("-0x");
  if (!hexadecimal || end != text.c_str() + text.size() || errno != 0 || !std::isfinite(x)) {
    node.fail(fmt::format("found {}; expected {}", node.found(), expected));
  }
  return x;
}

// Reads an array of exactly `size` items.
template <std::size_t size, class Read>
auto read_items(const JsonNode& node, std::string_view what, const Read& read) {
  if (!node.value().is_array() || node.size() != size) {
    node.fail(fmt::format("found {}; expected an array of {} {}", node.found(), size, what));
  }
  std::array<decltype(read(node)), size> items;
  for (std::size_t i = 0; i < size; ++i) items[i] = read(node[i]);
  return items;
}

// Reads an array of any number of items.
template <class Read>
auto read_list(const JsonNode& node, std::string_view what, const Read& read) {
  node.as_array(what);
  std::vector<decltype(read(node))> list;
  list.reserve(node.size());
  for (std::size_t i = 0; i < node.size(); ++i) list.push_back(read(node[i]));
  return list;
}

Answer read_answer(const JsonNode& node) {
  constexpr std::string_view expected = "separated, touching, overlapping or unknown";
  const std::string& text = node.text(expected);
  for (const Answer answer :
       {Answer::separated, Answer::touching, Answer::overlapping, Answer::unknown}) {
    if (text == to_string(answer)) return answer;
  }
  node.fail(fmt::format("found {}; expected {}", node.found(), expected));
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

Generator read_generator(const JsonNode& node) {
  if (node.value().is_array()) {
    return {-1, read_items<3>(node, "hexadecimal numbers in strings", read_hexadecimal)};
  }
  const std::uint32_t vertex = read_index(node);
  if (vertex > static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max())) {
    node.fail(fmt::format("found {}; expected the number of a vertex", vertex));
  }
  return {static_cast<std::int32_t>(vertex), {}};
}

oracle::DifferencePoint read_point(const JsonNode& node) {
  const auto [a, b] = read_items<2>(node, "indices", read_index);
  return {a, b};
}

Certificate::Term read_term(const JsonNode& node) {
  if (!node.value().is_array() || node.size() != 3) {
    node.fail(fmt::format("found {}; expected two indices and a weight", node.found()));
  }
  return {{read_index(node[0]), read_index(node[1])}, read_integer(node[2])};
}

Certificate::Surface read_surface(const JsonNode& node) {
  node.as_object("an object with \"points\" and \"triangles\"");
  return {read_list(node.at("points", "an array"), "an array of pairs of indices", read_point),
          read_list(node.at("triangles", "an array"), "an array of triples of indices",
                    [](const JsonNode& triangle) {
                      return read_items<3>(triangle, "indices", read_index);
                    })};
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
  certificate.direction = read_items<3>(node.at("direction", "an array of 3 integers in strings"),
                                        "integers in strings", read_integer);
  certificate.a =
      read_list(node.at("generators_a", "an array"), "an array of generators", read_generator);
  certificate.b =
      read_list(node.at("generators_b", "an array"), "an array of generators", read_generator);
  certificate.closest =
      read_list(node.at("closest", "an array"), "an array of weighted points", read_term);
  certificate.surface =
      read_surface(node.at("surface", "an object with \"points\" and \"triangles\""));
  return stored;
}

// --- writing ---

std::string to_hexadecimal(long double x) {
  std::array<char, 64> text;
  const int size = std::snprintf(text.data(), text.size(), "%La", x);
  return {text.data(), static_cast<std::size_t>(size)};
}

OrderedJson root_to_json(const SignedRoot& root) {
  return {{"sign", root.sign},
          {"numerator", root.numerator.str()},
          {"denominator", root.denominator.str()}};
}

OrderedJson generators_to_json(const std::vector<Generator>& generators) {
  OrderedJson list = OrderedJson::array();
  for (const Generator& generator : generators) {
    if (generator.vertex >= 0) {
      list.push_back(generator.vertex);
      continue;
    }
    OrderedJson point;
    for (const long double x : generator.point) point.push_back(to_hexadecimal(x));
    list.push_back(point);
  }
  return list;
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
  for (const Integer& part : certificate.direction) out["direction"].push_back(part.str());
  out["generators_a"] = generators_to_json(certificate.a);
  out["generators_b"] = generators_to_json(certificate.b);
  out["closest"] = OrderedJson::array();
  for (const Certificate::Term& term : certificate.closest) {
    out["closest"].push_back({term.point.a, term.point.b, term.weight.str()});
  }
  OrderedJson& surface = out["surface"];
  surface["points"] = OrderedJson::array();
  for (const auto& [a, b] : certificate.surface.points) surface["points"].push_back({a, b});
  surface["triangles"] = certificate.surface.triangles;
  return out.dump();
}

void read_certificates(
    const std::filesystem::path& file,
    const std::function<void(const StoredCertificate& certificate, std::int64_t line)>& each) {
  for_each_json_line(file, "certificate",
                     [&](const JsonNode& line) { each(read_certificate(line), line.line()); });
}

}  // namespace touchstone::files
