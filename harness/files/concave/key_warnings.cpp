// Compares keys with those of cases.
#include "harness/files/concave/key_warnings.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <optional>

#include "harness/base/file_text.h"
#include "harness/base/nearest_name.h"

namespace touchstone::files {
namespace {

constexpr std::array<std::string_view, 25> known_keys = {"id",
                                                         "a",
                                                         "b",
                                                         "shape",
                                                         "translation",
                                                         "rotation",
                                                         "type",
                                                         "radius",
                                                         "quaternion_wxyz",
                                                         "displacement",
                                                         "half_length",
                                                         "axis",
                                                         "half_extents",
                                                         "rotation_vector",
                                                         "radii",
                                                         "vertices",
                                                         "normal",
                                                         "offset",
                                                         "triangles",
                                                         "solid",
                                                         "parts",
                                                         "mesh",
                                                         "scale",
                                                         "as",
                                                         "quaternion_exact"};

// The known key that was meant, if any.
std::optional<std::string_view> meant(const std::string& key) {
  if (key.size() < 3 || key.size() > 40) return {};
  std::string small = key;
  for (char& c : small)
    c = c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const std::string_view known : known_keys) {
    const std::size_t most = known.size() < 4 ? 0 : known.size() < 6 ? 1 : 2;
    if (base::edits(small, known) <= most) return known;
  }
  return {};
}

}  // namespace

void KeyWarnings::look(const JsonNode& line) { look_within(line, 0); }

void KeyWarnings::look_within(const JsonNode& node, int depth) {
  constexpr int deepest = 64;
  if (!node.value().is_object() || depth > deepest) return;
  for (const auto& [key, value] : node.value().items()) {
    if (std::ranges::find(known_keys, key) != known_keys.end() || !seen_.insert(key).second) {
      continue;
    }
    if (const auto known = meant(key)) {
      fmt::print(stderr, "{}:{}: warning: the key \"{}\" is ignored; perhaps \"{}\" was meant\n",
                 node.file(), node.line(), base::shortened(key), *known);
    }
  }
  for (const char* inner : {"a", "b", "shape"}) {
    if (node.has(inner)) look_within(node.at(inner, ""), depth + 1);
  }
  if (!node.has("parts")) return;
  const JsonNode parts = node.at("parts", "");
  if (!parts.value().is_array()) return;
  for (std::size_t i = 0; i < parts.size(); ++i) look_within(parts[i], depth + 1);
}

}  // namespace touchstone::files
