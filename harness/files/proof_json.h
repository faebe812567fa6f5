// The parts of certificates as JSON: integers, fractions of two of them, generators, points of a difference and
// surfaces of them. certificates.h has their forms.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algorithms/oracle/certificates/cast_certificate.h"
#include "harness/files/json_line.h"

namespace touchstone::files {

// All throw InputError with the place of what is malformed.
bool read_boolean(const JsonNode& node);
std::uint32_t read_index(const JsonNode& node);
// An integer of at most base::most_digits digits.
oracle::Integer read_integer(const JsonNode& node);
oracle::TimeFraction read_fraction(const JsonNode& node);
CastAnswer read_cast_answer(const JsonNode& node);
oracle::DifferencePoint read_point(const JsonNode& node);
std::vector<oracle::Generator> read_generators(const JsonNode& node);
std::vector<oracle::Certificate::Term> read_terms(const JsonNode& node);
oracle::Certificate::Surface read_surface(const JsonNode& node);

OrderedJson fraction_to_json(const oracle::TimeFraction& fraction);
OrderedJson generators_to_json(const std::vector<oracle::Generator>& generators);
OrderedJson terms_to_json(const std::vector<oracle::Certificate::Term>& terms);
OrderedJson surface_to_json(const oracle::Certificate::Surface& surface);

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

// Reads an array of exactly `size` integers in strings.
template <std::size_t size>
auto read_integers(const JsonNode& node) {
  return read_items<size>(node, "integers in strings", read_integer);
}

template <std::size_t size>
OrderedJson integers_to_json(const std::array<oracle::Integer, size>& integers) {
  OrderedJson list = OrderedJson::array();
  for (const oracle::Integer& part : integers) list.push_back(part.str());
  return list;
}

// Words for values.
template <class Value, std::size_t size>
using Names = std::array<std::pair<std::string_view, Value>, size>;

template <class Value, std::size_t size>
Value read_name(const JsonNode& node, const Names<Value, size>& names, std::string_view expected) {
  const std::string& text = node.text(expected);
  for (const auto& [name, value] : names) {
    if (text == name) return value;
  }
  node.fail(fmt::format("found {}; expected {}", node.found(), expected));
}

template <class Value, std::size_t size>
std::string_view name_of(Value asked, const Names<Value, size>& names) {
  for (const auto& [name, value] : names) {
    if (value == asked) return name;
  }
  return "";
}

// What proves that two bodies have a common point, or are so far apart: the generators of both, and the closest
// point and the surface of their difference.
template <class Proof>
void read_common_point(const JsonNode& node, Proof& proof) {
  proof.a = read_generators(node.at("generators_a", "an array"));
  proof.b = read_generators(node.at("generators_b", "an array"));
  proof.closest = read_terms(node.at("closest", "an array"));
  proof.surface = read_surface(node.at("surface", "an object with \"points\" and \"triangles\""));
}

template <class Proof>
void add_common_point(OrderedJson& out, const Proof& proof) {
  out["generators_a"] = generators_to_json(proof.a);
  out["generators_b"] = generators_to_json(proof.b);
  out["closest"] = terms_to_json(proof.closest);
  out["surface"] = surface_to_json(proof.surface);
}

// What all certificates of rays begin with, as JSON.

struct RayFields {
  std::uint64_t ray;  // its number in the file of rays
  bool is_first;      // the task is closest, or else any
  Vec3d origin, direction;
  double t_max;
};

// Throws InputError with the place of what is malformed.
RayFields read_ray_fields(const JsonNode& line);
OrderedJson ray_fields_to_json(const RayFields& fields);

}  // namespace touchstone::files
