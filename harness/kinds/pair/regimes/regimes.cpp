// The table of all regimes, and the making of a case from its index.
#include "harness/kinds/pair/regimes/regimes.h"

#include <fmt/format.h>

#include <cstdlib>
#include <initializer_list>
#include <utility>
#include <vector>

#include "harness/kinds/kind.h"
#include "harness/kinds/pair/axes/axes.h"
#include "harness/kinds/pair/regimes/regime_draws.h"

namespace touchstone::kinds {
namespace {

using Amounts = std::initializer_list<const char*>;

std::vector<Regime> all_regimes() {
  std::vector<Regime> list;
  using Draw = RegimeCase (*)(RegimeDraw&);
  const auto add = [&](std::string name, const char* group, std::string what, bool extreme,
                       double parameter, Draw draw) {
    list.push_back({std::move(name), group, std::move(what), extreme, parameter, draw});
  };
  const auto series = [&](const char* group, Amounts amounts, const char* what, bool extreme,
                          double sign, Draw draw) {
    for (const char* amount : amounts) {
      add(fmt::format("{}-{}", group, amount), group, fmt::format(fmt::runtime(what), amount),
          extreme, sign * std::strtod(amount, nullptr), draw);
    }
  };
  const Amounts gaps = {"1e0", "1e-1", "1e-3", "1e-6", "1e-9", "1e-12", "1e-14", "1e-15", "1e-16"};
  series("gap", gaps, "chosen features at a gap of {} of the pair's size", false, 1, draw_contact);
  series("depth", gaps, "chosen features at a depth of {} of the pair's size", false, -1,
         draw_contact);

  add("touching-baked", "touching", "one pose, hulls that meet on a grid in local coordinates",
      false, 0, draw_touching_baked);
  add("touching-origin", "touching", "hulls that meet at both local origins, in one place", false,
      0, draw_touching_origin);
  add("touching-grid", "touching", "boxes and hulls on a grid that share a face, edge or vertex",
      false, 0, draw_touching_grid);
  add("touching-pythagorean", "touching", "spheres and capsules at whole distances", false, 0,
      draw_touching_pythagorean);
  add("touching-less-an-ulp", "touching", "the same with a radius less by an ulp: apart", false, 1,
      draw_touching_pythagorean);
  add("touching-plus-an-ulp", "touching", "the same with a radius more by an ulp: overlapping",
      false, -1, draw_touching_pythagorean);
  add("touching-curved", "touching", "cylinders, cones and ellipsoids that touch along an axis",
      false, 0, draw_touching_curved);

  add("coincident-identical", "coincident", "one shape in one pose, twice", false, 0,
      draw_identical);
  add("coincident-pose", "coincident", "two shapes in one pose", false, 0, draw_same_pose);
  add("coincident-centre", "coincident", "two shapes with one local origin", false, 0,
      draw_same_centre);
  add("contained", "coincident", "a small body well inside a large one", false, 0, draw_contained);
  add("contained-touching", "coincident", "inside a box and against its faces from within", false,
      0, draw_contained_touching);
  add("coplanar", "coincident", "boxes side by side with faces in one plane", false, 0,
      draw_coplanar);

  add("degenerate-flat", "degenerate", "flat hulls", false, 0, draw_flat_hull);
  add("degenerate-segment", "degenerate", "hulls that are segments", false, 0, draw_segment);
  add("degenerate-point", "degenerate", "hulls that are points", false, 0, draw_point);
  add("degenerate-zero", "degenerate", "shapes with sizes that are zero", false, 0, draw_zero_size);
  add("degenerate-redundant", "degenerate",
      "hulls with repeated, coplanar, collinear and inner points", false, 0, draw_redundant_hull);
  add("degenerate-sliver", "degenerate", "hulls pressed to 1e-3 to 1e-12 of their size", true, 0,
      draw_sliver);
  add("degenerate-scaled", "degenerate", "the degenerate shapes at sizes of 1e-9 to 1e9 metres",
      true, 0, draw_scaled_degenerate);

  series("aspect", {"1e2", "1e4", "1e6", "1e8"}, "needles and plates of 1 to {}", true, 1,
         draw_aspect);
  series("scale", {"1e-9", "1e-6", "1e-3", "1e3", "1e6", "1e9"}, "bodies of {} metres", true, 1,
         draw_scale);
  series("far", {"1e2", "1e4", "1e6", "1e8"}, "bodies of a metre, {} metres from the origin", true,
         1, draw_far);
  series("ratio", {"1e3", "1e6", "1e9", "1e12"}, "a body {} times as large as the other", true, 1,
         draw_ratio);

  add("random-polytopes", "random", "boxes and hulls in random poses", false, 0,
      draw_random_polytopes);
  add("random-mixed", "random", "shapes of every kind in random poses", false, 0,
      draw_random_mixed);
  return list;
}

// FNV-1a: the random stream of a regime stays the same when others are added.
std::uint64_t hash_of(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

}  // namespace

Family family_of(const Regime& regime) {
  Family family{.name = regime.name, .group = regime.group, .kind = &pair_kind()};
  if (regime.axis != nullptr) {
    family.axis = regime.axis->name;
    family.value = value_of(regime).name;
  }
  family.drawn = &regime;
  return family;
}

std::span<const Regime> regimes() {
  static const std::vector<Regime> list = all_regimes();
  return list;
}

const Regime* find_regime(std::string_view name) {
  for (const Regime& regime : regimes()) {
    if (regime.name == name) return &regime;
  }
  return nullptr;
}

files::Case make(const Regime& regime, std::uint64_t seed, std::uint64_t index) {
  RegimeDraw draw{regime, seed, index, base::Random(seed, base::mix(hash_of(regime.name)) + index)};
  RegimeCase made = regime.draw(draw);
  made.pair.id = fmt::format("{}/{}/{}/{}", regime.name, kinds_of(made.pair), made.detail, index);
  return std::move(made.pair);
}

}  // namespace touchstone::kinds
