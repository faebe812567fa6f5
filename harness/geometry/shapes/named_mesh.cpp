// Chooses the counts of a mesh shape so that its triangles are about as long as wide.
#include "harness/geometry/shapes/named_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "harness/base/error.h"
#include "harness/geometry/shapes/mesh_shapes.h"

namespace touchstone::geometry {
namespace {

constexpr std::array<std::string_view, 4> shapes = {"torus", "trefoil", "ellipsoid", "terrain"};

// The number behind the name of a shape and a dash; empty if the name is not of that form.
std::optional<double> count_of(std::string_view name, std::string_view shape) {
  if (!name.starts_with(shape) || !name.substr(shape.size()).starts_with('-')) return {};
  const std::string_view digits = name.substr(shape.size() + 1);
  std::int64_t count = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (error != std::errc() || end != digits.data() + digits.size()) return {};
  if (count < 32 || count > 10'000'000) {
    throw base::InputError(
        fmt::format("{}: found {} triangles; expected 32 to 10000000", name, count));
  }
  return static_cast<double>(count);
}

}  // namespace

Mesh named_mesh(const std::string& name, const std::filesystem::path& home) {
  for (const std::string_view shape : shapes) {
    const std::optional<double> count = count_of(name, shape);
    if (!count) continue;
    const auto side = [&](double triangles_of_one) {
      return std::max<std::size_t>(
          3, static_cast<std::size_t>(std::lround(std::sqrt(*count / triangles_of_one))));
    };
    if (shape == "torus") return torus(4 * side(8), side(8), 0.25);
    if (shape == "trefoil") return trefoil(20 * side(40), side(40), 0.25);
    if (shape == "ellipsoid") return ellipsoid_with_poles({1, 0.8, 0.6}, side(4), 2 * side(4));
    return terrain(side(2), 0.3, 1);
  }
  return read_surface(home / name);
}

}  // namespace touchstone::geometry
