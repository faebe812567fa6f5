// Draws shapes and places pairs of them at exact distances.
#include "harness/bench/placed_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/tessellation.h"
#include "harness/scene/generators/pairs.h"

namespace touchstone::bench {
namespace {

// --- shapes -------------------------------------------------------------------------------------

Shape of_kind(ShapeKind kind) {
  Shape shape;
  shape.kind = kind;
  return shape;
}

Shape draw_sphere(base::Random& random) {
  Shape shape = of_kind(ShapeKind::sphere);
  shape.radius = random.uniform(0.25, 0.5);
  return shape;
}

Shape draw_capsule(base::Random& random) {
  Shape shape = of_kind(ShapeKind::capsule);
  shape.radius = random.uniform(0.15, 0.3);
  shape.half_length = random.uniform(0.15, 0.3);
  return shape;
}

Shape draw_box(base::Random& random) {
  Shape shape = of_kind(ShapeKind::box);
  for (double& half : shape.half_extents) half = random.uniform(0.25, 0.5);
  return shape;
}

template <ShapeKind kind>
Shape draw_round(base::Random& random) {
  Shape shape = of_kind(kind);
  shape.radius = random.uniform(0.25, 0.5);
  shape.half_length = random.uniform(0.25, 0.5);
  return shape;
}

Shape draw_ellipsoid(base::Random& random) {
  Shape shape = of_kind(ShapeKind::ellipsoid);
  for (double& radius : shape.radii) radius = random.uniform(0.25, 0.5);
  return shape;
}

template <std::size_t vertices>
Shape draw_hull(base::Random& random) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < vertices; ++i) points.push_back(0.5 * random.on_sphere());
  Shape shape = of_kind(ShapeKind::hull);
  shape.hull = make_hull(std::move(points));
  return shape;
}

template <int level>
Shape draw_icosphere(base::Random& random) {
  return geometry::as_polytope(draw_sphere(random), level);
}

Shape draw_halfspace(base::Random& random) {
  Shape shape = of_kind(ShapeKind::halfspace);
  shape.normal = random.on_sphere();
  shape.offset = random.uniform(-0.5, 0.5);
  return shape;
}

// The families in the order of their kinds.
constexpr std::array<ShapeFamily, 13> all_families = {{
    {"sphere", ShapeKind::sphere, draw_sphere},
    {"capsule", ShapeKind::capsule, draw_capsule},
    {"box", ShapeKind::box, draw_box},
    {"cylinder", ShapeKind::cylinder, draw_round<ShapeKind::cylinder>},
    {"cone", ShapeKind::cone, draw_round<ShapeKind::cone>},
    {"ellipsoid", ShapeKind::ellipsoid, draw_ellipsoid},
    {"hull-32", ShapeKind::hull, draw_hull<32>},
    {"hull-8", ShapeKind::hull, draw_hull<8>},
    {"hull-128", ShapeKind::hull, draw_hull<128>},
    {"hull-512", ShapeKind::hull, draw_hull<512>},
    {"icosphere-42", ShapeKind::hull, draw_icosphere<1>},
    {"icosphere-162", ShapeKind::hull, draw_icosphere<2>},
    {"halfspace", ShapeKind::halfspace, draw_halfspace},
}};

constexpr std::array<PairRegime, 5> all_pair_regimes = {{
    {"far", 10},
    {"gap-0.1", 0.1},
    {"gap-1e-3", 1e-3},
    {"depth-1e-3", -1e-3},
    {"deep", -0.2},
}};

}  // namespace

std::span<const ShapeFamily> shape_families() { return all_families; }
std::span<const PairRegime> pair_regimes() { return all_pair_regimes; }

const ShapeFamily* find_family(std::string_view name) {
  const auto at = std::ranges::find(all_families, name, &ShapeFamily::name);
  return at == all_families.end() ? nullptr : &*at;
}

std::string FamilyPair::name() const {
  if (a == b && a->kind == ShapeKind::hull) return std::string(a->name);
  return std::string(a->name) + "-" + std::string(b->name);
}

std::vector<FamilyPair> family_pairs() {
  std::vector<FamilyPair> pairs;
  const auto stands_for_its_kind = [](const ShapeFamily& family) {
    return family.kind != ShapeKind::hull || family.name == "hull-32";
  };
  for (const ShapeFamily& a : all_families) {
    for (const ShapeFamily& b : all_families) {
      const bool planes = a.kind == ShapeKind::halfspace;
      if (a.kind > b.kind || planes) continue;
      if (&a == &b || (stands_for_its_kind(a) && stands_for_its_kind(b))) pairs.push_back({&a, &b});
    }
  }
  return pairs;
}

PlacedPairs::PlacedPairs(const FamilyPair& families, const PairRegime& regime)
    : kind_a(families.a->kind), kind_b(families.b->kind) {
  constexpr std::uint32_t shapes_each = 64;
  constexpr std::uint64_t seed = 1;
  base::Random shape_random(seed, 0), random(seed, 1);
  std::vector<oracle::Solid> solids;
  for (const ShapeFamily* family : {families.a, families.b}) {
    for (std::uint32_t i = 0; i < shapes_each; ++i) {
      shapes.push_back(family->draw(shape_random));
      solids.emplace_back(shapes.back());
    }
  }
  oracle::Oracle oracle;
  while (first.size() < count) {
    const auto shape_a = static_cast<std::uint32_t>(random.below(shapes_each));
    const auto shape_b = static_cast<std::uint32_t>(shapes_each + random.below(shapes_each));
    const Pose a{random.rotation(), 2 * random.in_ball()};
    Pose b{random.rotation(), a.translation};
    b.translation += 2 * random.on_sphere();
    if (!scene::settle(oracle, solids[shape_a], a, solids[shape_b], b, regime.distance)) continue;
    first.push_back(static_cast<std::uint32_t>(poses.size()));
    second.push_back(first.back() + 1);
    poses.insert(poses.end(), {a, b});
    shape_of.insert(shape_of.end(), {shape_a, shape_b});
  }
}

PairBatch PlacedPairs::batch(std::size_t begin, std::size_t size) const {
  return {.kind_a = kind_a,
          .kind_b = kind_b,
          .pairs = {.first = std::span(first).subspan(begin, size),
                    .second = std::span(second).subspan(begin, size),
                    .shape_of = shape_of,
                    .poses = poses}};
}

const PlacedPairs& placed_pairs(const FamilyPair& families, const PairRegime& regime) {
  static std::map<std::pair<std::string, std::string_view>, std::unique_ptr<PlacedPairs>> made;
  auto& pairs = made[{families.name(), regime.name}];
  if (!pairs) pairs = std::make_unique<PlacedPairs>(families, regime);
  return *pairs;
}

}  // namespace touchstone::bench
