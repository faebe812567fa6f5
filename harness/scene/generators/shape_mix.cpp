// Reads the ingredients of a mix of shapes and draws random shapes from them.
#include "harness/scene/generators/shape_mix.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "algorithms/hull/convex_hull.h"

namespace touchstone::scene {
namespace {

constexpr std::int64_t default_hull_points = 12;

struct NormalLaw {
  double mean, deviation;  // metres
};

struct Ingredient {
  double weight = 1;
  bool fixed = false;
  TurnedShape shape;                // if fixed
  ShapeKind kind = ShapeKind::box;  // if not fixed
  std::int64_t hull_points = default_hull_points;
  std::optional<NormalLaw> radii;  // of an ellipsoid; replaces `size` and `aspect`
};

// The least length relative to the mean that is drawn, since a normal distribution is unbounded.
constexpr double least_part = 0.05;

NormalLaw read_normal(files::TomlTable& table, const std::string& key) {
  files::TomlTable law = table.inside(key, table.where() + ": " + key);
  const NormalLaw result{law.number("mean", files::positive),
                         law.number("deviation", files::not_negative)};
  law.finish();
  return result;
}

// Names of the bounded kinds: all but the half-space, the last in the list.
std::span<const std::string_view> bounded_names() {
  return shape_names().first(shape_names().size() - 1);
}

// Returns true if a table gives sizes or a mesh, and so a fixed shape.
bool is_fixed(files::TomlTable& table) {
  if (table.contains("type") && is_concave_name(table.text("type"))) return true;
  constexpr std::string_view sizes[] = {"mesh",  "radius",   "half_length", "half_extents",
                                        "radii", "vertices", "normal",      "offset"};
  return std::any_of(std::begin(sizes), std::end(sizes),
                     [&](std::string_view key) { return table.contains(key); });
}

Ingredient read_ingredient(files::TomlTable table, ShapeReader& reader) {
  Ingredient ingredient;
  ingredient.weight = table.number("weight", files::positive, 1.0);
  ingredient.fixed = is_fixed(table);
  if (!ingredient.fixed) {
    ingredient.kind = all_shape_kinds[table.choice("type", bounded_names())];
  }
  if (ingredient.fixed) {
    ingredient.shape = reader.read(table);
    if (ingredient.shape.shape.kind == ShapeKind::halfspace) {
      table.fail("type", "a half-space among shapes that are scattered; expected a bounded shape");
    }
  } else if (ingredient.kind == ShapeKind::hull) {
    ingredient.hull_points = table.integer("points", 4, 10'000, default_hull_points);
  } else if (ingredient.kind == ShapeKind::ellipsoid && table.contains("radii_normal")) {
    ingredient.radii = read_normal(table, "radii_normal");
  }
  table.finish();
  return ingredient;
}

std::vector<Ingredient> read_ingredients(files::TomlTable& table, ShapeReader& reader) {
  const toml::node* node = table.node("shapes");
  if (node == nullptr) return {Ingredient{}};
  const toml::array* array = node->as_array();
  if (array == nullptr || array->empty()) {
    table.fail("shapes", "expected an array of at least one name or table of a shape");
  }
  std::vector<Ingredient> ingredients;
  for (const toml::node& element : *array) {
    if (element.is_string()) {
      Ingredient ingredient;
      ingredient.kind = all_shape_kinds[table.choice_of(element, "shapes", bounded_names())];
      ingredients.push_back(ingredient);
    } else {
      ingredients.push_back(read_ingredient(
          table.from(element, fmt::format("shape {}", ingredients.size() + 1)), reader));
    }
  }
  return ingredients;
}

// Makes a shape whose longest side or diameter is `size`.
Shape random_shape(const Ingredient& ingredient, double size, double aspect, base::Random& random) {
  Shape shape;
  shape.kind = ingredient.kind;
  const double half = size / 2;
  const double first = random.uniform(aspect, 1), second = random.uniform(aspect, 1);
  switch (shape.kind) {
    case ShapeKind::sphere: shape.radius = half; break;
    case ShapeKind::capsule:
      shape.radius = half * first / 2;
      shape.half_length = half - shape.radius;
      break;
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      shape.radius = half * first;
      shape.half_length = half;
      break;
    case ShapeKind::box: shape.half_extents = half * Vec3d(1, first, second); break;
    case ShapeKind::ellipsoid:
      shape.radii = half * Vec3d(1, first, second);
      if (ingredient.radii) {
        const auto [mean, deviation] = *ingredient.radii;
        for (double& radius : shape.radii) {
          radius = std::max(least_part * mean, mean + deviation * random.normal());
        }
      }
      break;
    case ShapeKind::hull: {
      std::vector<Vec3d> points;
      for (std::int64_t i = 0; i < ingredient.hull_points; ++i) {
        const Vec3d p = random.on_sphere();
        points.emplace_back(half * p.x(), half * first * p.y(), half * second * p.z());
      }
      shape.hull = make_hull(std::move(points));
      break;
    }
    case ShapeKind::halfspace: break;  // does not occur
  }
  return shape;
}

}  // namespace

std::vector<TurnedShape> make_shape_mix(files::TomlTable& table, ShapeReader& reader,
                                        std::int64_t count, const ShapeMixDefaults& defaults,
                                        base::Random& random) {
  const std::vector<Ingredient> ingredients = read_ingredients(table, reader);
  const auto [least, greatest] = table.range("size", files::positive, defaults.size);
  const double aspect = table.number("aspect", {.low = 1e-6, .high = 1}, defaults.aspect);
  const std::int64_t distinct = table.integer("distinct", 1, 100'000'000, 1000);
  double total = 0;
  for (const Ingredient& ingredient : ingredients) total += ingredient.weight;

  std::vector<TurnedShape> shapes;
  while (static_cast<std::int64_t>(shapes.size()) < std::min(distinct, count)) {
    double draw = random.uniform(0, total);
    std::size_t pick = 0;
    while (pick + 1 < ingredients.size() && draw >= ingredients[pick].weight) {
      draw -= ingredients[pick++].weight;
    }
    const double size = defaults.law == SizeLaw::even ? random.uniform(least, greatest)
                                                      : random.magnitude(least, greatest);
    const Ingredient& ingredient = ingredients[pick];
    if (ingredient.fixed) {
      shapes.push_back(ingredient.shape);
    } else {
      shapes.push_back({random_shape(ingredient, size, aspect, random)});
    }
  }
  return shapes;
}

}  // namespace touchstone::scene
