// Generator `pairs`: pairs of bodies at exact distances, for benchmarks of narrow phases.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "algorithms/core/bounds.h"
#include "harness/base/reproducible_math.h"
#include "harness/scene/generators/generators.h"
#include "harness/scene/generators/settle.h"
#include "harness/scene/generators/sway.h"

namespace touchstone::scene {
namespace {

// Returns a point of the shape that is farthest along n (unit, local).
Vec3d support_point(const Shape& shape, const Vec3d& n) {
  const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
  const double across = std::sqrt(n.x() * n.x() + n.y() * n.y());
  const auto disc = [&](double z) -> Vec3d {
    if (!(across > 0)) return {0, 0, z};
    return {shape.radius * n.x() / across, shape.radius * n.y() / across, z};
  };
  switch (shape.kind) {
    case ShapeKind::sphere: return shape.radius * n;
    case ShapeKind::capsule: return shape.radius * n + Vec3d(0, 0, sign(n.z()) * shape.half_length);
    case ShapeKind::cylinder: return disc(sign(n.z()) * shape.half_length);
    case ShapeKind::cone: {
      const double tip = n.z() * shape.half_length;
      const double base = shape.radius * across - n.z() * shape.half_length;
      return tip > base ? Vec3d(0, 0, shape.half_length) : disc(-shape.half_length);
    }
    case ShapeKind::box:
      return {sign(n.x()) * shape.half_extents.x(), sign(n.y()) * shape.half_extents.y(),
              sign(n.z()) * shape.half_extents.z()};
    case ShapeKind::ellipsoid: {
      const Vec3d& r = shape.radii;
      const Vec3d scaled(r.x() * n.x(), r.y() * n.y(), r.z() * n.z());
      const double norm = base::length(scaled);
      return {r.x() * (scaled.x() / norm), r.y() * (scaled.y() / norm),
              r.z() * (scaled.z() / norm)};
    }
    case ShapeKind::hull: {
      const auto along = [&](const Vec3d& v) { return base::inner(v, n); };
      const std::vector<Vec3d>& vertices = shape.hull->vertices;
      return *std::ranges::max_element(vertices, {}, along);
    }
    case ShapeKind::halfspace: break;  // no generator makes one
  }
  return Vec3d::Zero();
}

Vec3d world_support(const Scene& scene, const Body& body, const Vec3d& n) {
  const Mat3d& r = body.pose.rotation;
  return base::times(r, support_point(scene.shapes[body.shape], base::transposed_times(r, n)));
}

constexpr std::string_view placement_names[] = {"facing", "settled", "meeting"};
enum class Placement : std::uint8_t { facing, settled, meeting };

std::vector<double> read_gaps(GeneratorInput& input) {
  files::TomlTable& table = input.table;
  std::vector<double> gaps;
  if (const toml::node* node = table.node("gaps")) {
    const toml::array* array = node->as_array();
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
      const std::optional<double> gap =
          (*array)[i].is_number() ? (*array)[i].value<double>() : std::nullopt;
      if (gap && std::abs(*gap) <= 1e6) gaps.push_back(*gap);
    }
    if (array == nullptr || array->empty() || gaps.size() != array->size()) {
      table.fail("gaps", "expected an array of signed distances in metres, between -1e6 and 1e6");
    }
  }
  if (input.gap) return {*input.gap};
  if (gaps.empty()) gaps.push_back(0.1);
  return gaps;
}

}  // namespace

// Body 2 i is placed against body 2 i + 1 with the gap gaps[i modulo their number]. Along a random
// direction n, the support points of the two bodies that face each other are placed on a line along
// n with that gap. Nothing lies between the planes through them, so a positive gap is the exact
// distance; a depth is that along n, at most the bodies' depth there.
//
// `settled`: body 2 i + 1 then moves along the shortest connection until the exact distance or
// depth is the gap. If it is already, vertices still face vertices.
//
// `meeting`: body 2 i + 1 moves straight towards the other from a random direction until the exact
// distance or depth is the gap. The nearest features are those of bodies that meet by chance.
//
// Pairs stand on a grid, clear of each other. With `sway` they move (sway.h).
Generated make_pairs(GeneratorInput& input) {
  if (input.count % 2 != 0) {
    throw base::InputError(
        input.table.file(), 0,
        fmt::format("a count of {} was asked for; expected an even one, as the bodies "
                    "come in pairs",
                    input.count));
  }
  const std::vector<double> gaps = read_gaps(input);
  const auto placement =
      static_cast<Placement>(input.table.choice("placement", placement_names, 0));
  const Sway sway = read_sway(input);
  Generated made;
  Scene& scene = made.scene;
  scene = make_bodies(input, {}, true, input.count);
  double reach = 0;
  for (const Shape& shape : scene.shapes) {
    reach = std::max(reach, loose_reach(shape, Mat3d::Identity()));
  }
  const double widest = *std::ranges::max_element(gaps);
  const double cell = 2.5 * (2 * reach + std::max(widest, 0.0));
  const auto pairs = static_cast<std::uint32_t>(scene.bodies.size() / 2);
  std::uint32_t side = 1;
  while (std::uint64_t{side} * side * side < pairs) ++side;
  base::Random places = input.random(GeneratorInput::place_stream);
  base::Random motions = input.random(GeneratorInput::velocity_stream);
  oracle::Oracle oracle;
  for (std::uint32_t i = 0; i < pairs; ++i) {
    Body& a = scene.bodies[2 * i];
    Body& b = scene.bodies[2 * i + 1];
    const double gap = gaps[i % gaps.size()];
    a.pose.translation = cell * Vec3d(i % side, i / side % side, i / side / side);
    Vec3d n;
    const auto face = [&] {
      n = places.on_sphere();
      b.pose.translation =
          a.pose.translation + (world_support(scene, a, n) + gap * n - world_support(scene, b, -n));
    };
    face();
    if (placement != Placement::facing) {
      const oracle::Solid solid_a(scene.shapes[a.shape]), solid_b(scene.shapes[b.shape]);
      constexpr int most_tries = 100;
      int tries = 1;
      const auto is_placed = [&] {
        if (placement == Placement::settled) {
          return settle(oracle, solid_a, a.pose, solid_b, b.pose, gap);
        }
        b.pose.translation = a.pose.translation + (3 * reach + std::max(gap, 0.0)) * n;
        return meet(oracle, solid_a, a.pose, solid_b, b.pose, -n, gap);
      };
      while (!is_placed()) {
        if (++tries > most_tries) {
          throw base::InputError(
              input.table.file(), 0,
              fmt::format("no place found for bodies {} and {} at the distance {}: "
                          "expected one that these shapes can have",
                          2 * i, 2 * i + 1, gap));
        }
        face();
      }
      if (sway.share > 0) {
        const Vec3d normal = oracle.measure({solid_a, a.pose}, {solid_b, b.pose}).normal;
        if (base::length(normal) > 0) n = normal / base::length(normal);
      }
    }
    a.moving = b.moving = false;
    set_swaying(sway, n, gap, reach, motions, a, b);
    scene.pairs.push_back({2 * i, 2 * i + 1});
  }
  made.side = cell * side;
  return made;
}

}  // namespace touchstone::scene
