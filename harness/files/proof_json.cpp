// Reads and writes the parts of certificates.
#include "harness/files/proof_json.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>

#include "harness/base/input_file.h"

namespace touchstone::files {

using oracle::Certificate;
using oracle::Generator;
using oracle::Integer;

namespace {

// The bits of a hexadecimal number from its first to its last that is set.
int significant_bits(std::string_view text) {
  std::string digits;
  text = text.substr(text.find('x') + 1);
  std::ranges::copy_if(text.substr(0, text.find('p')), std::back_inserter(digits),
                       [](char c) { return c != '.'; });
  const std::size_t first = digits.find_first_not_of('0'), last = digits.find_last_not_of('0');
  if (first == std::string::npos) return 0;
  const auto value = [&](std::size_t at) {
    return static_cast<unsigned>(std::stoi(digits.substr(at, 1), nullptr, 16));
  };
  const int count = static_cast<int>(last - first) + 1;
  return 4 * count - (4 - std::bit_width(value(first))) - std::countr_zero(value(last));
}

long double read_hexadecimal(const JsonNode& node) {
  constexpr std::string_view expected = "a hexadecimal number in a string, such as \"0x1.8p-1\"";
  const std::string& text = node.text(expected);
  char* end = nullptr;
  errno = 0;
  const long double x = std::strtold(text.c_str(), &end);
  const bool hexadecimal = text.starts_with("0x") || text.starts_with("-0x");
  if (!hexadecimal || end != text.c_str() + text.size() || errno != 0 || !std::isfinite(x) ||
      significant_bits(text) > std::numeric_limits<long double>::digits) {
    node.fail(fmt::format("found {}; expected {}", node.found(), expected));
  }
  return x;
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

Certificate::Term read_term(const JsonNode& node) {
  if (!node.value().is_array() || node.size() != 3) {
    node.fail(fmt::format("found {}; expected two indices and a weight", node.found()));
  }
  return {{read_index(node[0]), read_index(node[1])}, read_integer(node[2])};
}

std::string to_hexadecimal(long double x) {
  std::array<char, 64> text;
  const int size = std::snprintf(text.data(), text.size(), "%La", x);
  return {text.data(), static_cast<std::size_t>(size)};
}

}  // namespace

bool read_boolean(const JsonNode& node) {
  if (!node.value().is_boolean()) {
    node.fail(fmt::format("found {}; expected true or false", node.found()));
  }
  return node.value().get<bool>();
}

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
  if (digits.size() > base::most_digits) {
    node.fail(fmt::format("found an integer of {} digits; expected at most {}", digits.size(),
                          base::most_digits));
  }
  return Integer(text);
}

oracle::TimeFraction read_fraction(const JsonNode& node) {
  const auto [numerator, denominator] = read_integers<2>(node);
  return {numerator, denominator};
}

CastAnswer read_cast_answer(const JsonNode& node) {
  constexpr Names<CastAnswer, 3> names = {
      {{"hit", CastAnswer::hit}, {"miss", CastAnswer::miss}, {"unknown", CastAnswer::unknown}}};
  return read_name(node, names, "hit, miss or unknown");
}

oracle::DifferencePoint read_point(const JsonNode& node) {
  const auto [a, b] = read_items<2>(node, "indices", read_index);
  return {a, b};
}

std::vector<Generator> read_generators(const JsonNode& node) {
  return read_list(node, "an array of generators", read_generator);
}

std::vector<Certificate::Term> read_terms(const JsonNode& node) {
  return read_list(node, "an array of weighted points", read_term);
}

Certificate::Surface read_surface(const JsonNode& node) {
  node.as_object("an object with \"points\" and \"triangles\"");
  return {read_list(node.at("points", "an array"), "an array of pairs of indices", read_point),
          read_list(node.at("triangles", "an array"), "an array of triples of indices",
                    [](const JsonNode& triangle) {
                      return read_items<3>(triangle, "indices", read_index);
                    })};
}

OrderedJson fraction_to_json(const oracle::TimeFraction& fraction) {
  return {fraction.numerator.str(), fraction.denominator.str()};
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

OrderedJson terms_to_json(const std::vector<Certificate::Term>& terms) {
  OrderedJson list = OrderedJson::array();
  for (const Certificate::Term& term : terms) {
    list.push_back({term.point.a, term.point.b, term.weight.str()});
  }
  return list;
}

OrderedJson surface_to_json(const Certificate::Surface& surface) {
  OrderedJson out;
  out["points"] = OrderedJson::array();
  for (const auto& [a, b] : surface.points) out["points"].push_back({a, b});
  out["triangles"] = surface.triangles;
  return out;
}

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
