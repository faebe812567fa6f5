// The recommended algorithms, as results/choosing.md has them.
#include "algorithms/api/choice.h"

#include <algorithm>

namespace touchstone::v1 {
namespace {

using Names = std::vector<std::string_view>;

bool is_revolved(ShapeKind kind) { return kind == ShapeKind::cylinder || kind == ShapeKind::cone; }

// The first of these that offers the question is taken. results/choosing.md has the times behind it.
Names recommended(Task task, ShapeKind a, ShapeKind b, bool many) {
  const bool boxes = a == ShapeKind::box && b == ShapeKind::box;
  const bool simple = b <= ShapeKind::box || b == ShapeKind::halfspace ||
                      (a == ShapeKind::sphere && is_revolved(b));
  if (simple && !(boxes && asks_distance(task) && !many)) return {"closed-form", "gjk"};
  if (many && !(b == ShapeKind::ellipsoid && asks_depth(task))) return {"gjk-lanes", "gjk"};
  if (b == ShapeKind::ellipsoid && a != ShapeKind::capsule) return {"ellipsoid", "smooth", "gjk"};
  if (is_revolved(b)) return {"smooth", "gjk"};
  return {"gjk"};
}

Names recommended_cast(ShapeKind a, ShapeKind b, bool turns) {
  if (turns) return {"rigid-advancement"};
  const auto is_polytope = [](ShapeKind kind) {
    return kind == ShapeKind::box || kind == ShapeKind::hull;
  };
  if (is_polytope(a) && is_polytope(b)) return {"mpr-ray-cast"};
  return {"closed-form", "gjk-ray-cast"};
}

// Adds the entry to the list, unless it is there. Returns its place.
template <class Entry>
std::uint8_t place(const Entry* entry, std::vector<const Entry*>& list) {
  const auto at = std::ranges::find(list, entry);
  if (at == list.end()) {
    list.push_back(entry);
    return static_cast<std::uint8_t>(list.size() - 1);
  }
  return static_cast<std::uint8_t>(at - list.begin());
}

// Returns the place of the first of these that offers what `offered` asks.
template <class Entry, class Offered>
std::uint8_t first(const Names& names, const Offered& offered, std::vector<const Entry*>& list) {
  for (const std::string_view name : names) {
    const Entry* const entry = registry::find<Entry>(name);
    if (entry != nullptr && entry->make && offered(*entry)) return place(entry, list);
  }
  return Choice::none;
}

}  // namespace

Choice chosen(const std::string& algorithm, const std::string& cast_algorithm) {
  if (!algorithm.empty()) entry_named<NarrowPhaseEntry>(algorithm, "narrow phase");
  if (!cast_algorithm.empty()) entry_named<CastEntry>(cast_algorithm, "cast");
  Choice choice;
  for (const ShapeKind a : all_shape_kinds) {
    for (const ShapeKind b : all_shape_kinds) {
      if (b < a) continue;
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      for (const Task task : all_tasks) {
        const auto offered = [&](const NarrowPhaseEntry& entry) {
          return offers(entry, Precision::float64) && offers(entry, a, b, task);
        };
        for (const bool many : {false, true}) {
          const Names names = algorithm.empty() ? recommended(task, a, b, many) : Names{algorithm};
          (many ? choice.many : choice.alone)[static_cast<std::size_t>(task)][i][j] =
              first(names, offered, choice.pair_entries);
        }
      }
      for (const bool turns : {false, true}) {
        const Names names =
            cast_algorithm.empty() ? recommended_cast(a, b, turns) : Names{cast_algorithm};
        choice.casts[turns ? 1 : 0][i][j] = first(
            names, [&](const CastEntry& entry) { return offers(entry, a, b, turns); },
            choice.cast_entries);
      }
    }
  }
  if (algorithm.empty()) {
    choice.where_open = place(registry::find<NarrowPhaseEntry>("certified"), choice.pair_entries);
  }
  return choice;
}

}  // namespace touchstone::v1
