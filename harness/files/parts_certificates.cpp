// Reads and writes certificates of bodies of many parts.
#include "harness/files/parts_certificates.h"

#include <array>
#include <string_view>
#include <utility>

#include "harness/files/concave_cases.h"
#include "harness/files/proof_json.h"

namespace touchstone::files {
namespace {

using oracle::PartsCertificate;
using Step = PartsCertificate::Step;
using PartsClaim = PartsCertificate::Claim;

constexpr Names<PartsClaim, 3> names_of_claims = {{{"intersect", PartsClaim::intersect},
                                                   {"distance", PartsClaim::distance},
                                                   {"contacts", PartsClaim::contacts}}};
constexpr Names<Answer, 3> names_of_answers = {{{"separated", Answer::separated},
                                                {"overlapping", Answer::overlapping},
                                                {"unknown", Answer::unknown}}};
constexpr Names<Step::Kind, 5> names_of_steps = {{{"a", Step::Kind::halve_a},
                                                  {"b", Step::Kind::halve_b},
                                                  {"own", Step::Kind::own_plane},
                                                  {"meet", Step::Kind::meet},
                                                  {"open", Step::Kind::open}}};

Step read_step(const JsonNode& node) {
  if (node.value().is_array()) return {Step::Kind::plane, read_integers<3>(node)};
  return {read_name(node, names_of_steps, "a, b, own, meet, open or a direction"), {}};
}

PartsCertificate::Met read_met(const JsonNode& node) {
  node.as_object("two parts with their common point");
  const auto parts = read_point(node.at("parts", "the numbers of two parts"));
  PartsCertificate::Met met{
      .parts = {parts.a, parts.b}, .a = {}, .b = {}, .closest = {}, .surface = {}};
  read_common_point(node, met);
  return met;
}

PartsCertificate::Inside read_inside(const JsonNode& node) {
  node.as_object("null, or an object with \"body\", \"part\" and \"surface\"");
  constexpr Names<bool, 2> bodies = {{{"a", true}, {"b", false}}};
  return {read_name(node.at("body", "a or b"), bodies, "a or b"),
          read_index(node.at("part", "the number of a part")),
          read_index(node.at("surface", "the number of a surface"))};
}

OrderedJson step_to_json(const Step& step) {
  if (step.kind == Step::Kind::plane) return integers_to_json(step.direction);
  return name_of(step.kind, names_of_steps);
}

OrderedJson met_to_json(const PartsCertificate::Met& met) {
  OrderedJson out;
  out["parts"] = {met.parts.a, met.parts.b};
  add_common_point(out, met);
  return out;
}

std::uint64_t read_count(const JsonNode& node) {
  if (!node.value().is_number_unsigned()) {
    node.fail(fmt::format("found {}; expected a number of pairs", node.found()));
  }
  return node.value().get<std::uint64_t>();
}

StoredPartsCertificate read_stored(const JsonNode& line) {
  line.as_object("a certificate: an object with \"id\", \"a\", \"b\", \"answer\" and its proof");
  StoredPartsCertificate stored{read_concave_case(line), {}};
  line.at("id", "a string");  // a proof names its case
  PartsCertificate& certificate = stored.certificate;
  certificate.claim =
      read_name(line.at("claim", "a claim"), names_of_claims, "intersect, distance or contacts");
  certificate.answer = read_name(line.at("answer", "an answer"), names_of_answers,
                                 "separated, overlapping or unknown");
  const JsonNode bounds = line.at("bounds", "null or two numbers");
  if (!bounds.value().is_null()) {
    const auto [lower, upper] = bounds.numbers<2>();
    certificate.bounds = {lower, upper};
  }
  certificate.undecided = read_count(line.at("undecided", "a number of pairs"));
  for (const auto& [key, order] :
       {std::pair{"order_a", &certificate.order_a}, {"order_b", &certificate.order_b}}) {
    *order = read_list(line.at(key, "an array of parts"), "an array of parts", read_index);
  }
  certificate.cover =
      read_list(line.at("cover", "an array of steps"), "an array of steps", read_step);
  certificate.met = read_list(line.at("met", "an array"), "an array of common points", read_met);
  const JsonNode inside = line.at("inside", "null or what is inside");
  if (!inside.value().is_null()) certificate.inside = read_inside(inside);
  return stored;
}

}  // namespace

std::string to_json(const StoredPartsCertificate& stored) {
  const PartsCertificate& certificate = stored.certificate;
  OrderedJson out;
  out["id"] = stored.of.id;
  out["a"] = concave_body_to_json(stored.of.a, stored.of.pose_a);
  out["b"] = concave_body_to_json(stored.of.b, stored.of.pose_b);
  out["claim"] = name_of(certificate.claim, names_of_claims);
  out["answer"] = name_of(certificate.answer, names_of_answers);
  out["bounds"] = nullptr;
  if (certificate.bounds) out["bounds"] = {certificate.bounds->lower, certificate.bounds->upper};
  out["undecided"] = certificate.undecided;
  out["order_a"] = certificate.order_a;
  out["order_b"] = certificate.order_b;
  out["cover"] = OrderedJson::array();
  for (const Step& step : certificate.cover) out["cover"].push_back(step_to_json(step));
  out["met"] = OrderedJson::array();
  for (const auto& met : certificate.met) out["met"].push_back(met_to_json(met));
  out["inside"] = nullptr;
  if (certificate.inside) {
    const auto& [a_is_inside, part, surface] = *certificate.inside;
    out["inside"] = {{"body", a_is_inside ? "a" : "b"}, {"part", part}, {"surface", surface}};
  }
  return out.dump();
}

void read_parts_certificates(
    const std::filesystem::path& file,
    const std::function<void(const StoredPartsCertificate& certificate, std::int64_t line)>& each) {
  for_each_json_line(file, "certificate",
                     [&](const JsonNode& line) { each(read_stored(line), line.line()); });
}

}  // namespace touchstone::files
