// Lists what algorithms are asked.
#include "harness/check/kinds/contestant.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "harness/campaign/selection.h"

namespace touchstone::check {
namespace {

constexpr std::array<std::string_view, 3> concave_tasks = {"intersect", "distance", "contacts"};
constexpr std::array<std::string_view, 2> ray_tasks = {"closest", "any"};
constexpr std::array<std::string_view, 2> point_tasks = {"closest", "side"};
constexpr std::array<std::string_view, 2> cast_tasks = {"counts", "approach"};
constexpr std::array<std::string_view, 2> ccd_tasks = {"contact", "separation"};

std::span<const std::string_view> tasks_of(CaseKind kind) {
  switch (kind) {
    case CaseKind::concave: return concave_tasks;
    case CaseKind::rays:
    case CaseKind::scene_rays: return ray_tasks;
    case CaseKind::points: return point_tasks;
    case CaseKind::cast: return cast_tasks;
    case CaseKind::ccd: break;
  }
  return ccd_tasks;
}

bool offers(const ConcaveEntry* entry, Precision scalar, std::uint8_t task) {
  return touchstone::offers(*entry, static_cast<ConcaveTask>(task), scalar);
}
bool offers(const RayCastEntry* entry, Precision scalar, std::uint8_t task) {
  return touchstone::offers(*entry, static_cast<RayTask>(task)) &&
         touchstone::offers(*entry, scalar);
}
bool offers(const SceneRayCastEntry* entry, Precision scalar, std::uint8_t task) {
  return scalar == Precision::float64 &&
         std::ranges::find(entry->tasks, static_cast<RayTask>(task)) != entry->tasks.end();
}
bool offers(const PointQueryEntry* entry, Precision scalar, std::uint8_t task) {
  return scalar == entry->scalar &&
         std::ranges::find(entry->tasks, static_cast<PointTask>(task)) != entry->tasks.end();
}
bool offers(const CastEntry* entry, Precision scalar, std::uint8_t task) {
  CastSettings settings;
  settings.scalar = scalar;
  settings.start = static_cast<StartContact>(task);
  return touchstone::offers(*entry, settings);
}
bool offers(const CcdEntry* entry, Precision scalar, std::uint8_t task) {
  return scalar == Precision::float64 && (task == 0 || entry->separations);
}

template <class Entry>
void add(std::vector<Contestant>& all, std::span<const Entry> list, const char* what,
         const std::vector<std::string>& names, std::span<const Precision> scalars) {
  for (const Entry* entry : campaign::select(list, names, what)) {
    const bool is_named = std::ranges::find(names, entry->info.name) != names.end();
    if (entry->info.origin == Origin::oracle && !is_named) continue;
    for (const Precision scalar : scalars) {
      Contestant one{entry, scalar, 0};
      for (; one.task < tasks_of(one.kind()).size(); ++one.task) {
        if (offers(entry, scalar, one.task)) all.push_back(one);
      }
    }
  }
}

}  // namespace

std::string_view to_string(CaseKind kind) {
  constexpr std::array<std::string_view, all_case_kinds.size()> names = {
      "concave", "rays", "points", "cast", "ccd", "scene-rays"};
  return names[static_cast<std::size_t>(kind)];
}

const AlgorithmInfo& Contestant::info() const {
  return std::visit([](const auto* one) -> const AlgorithmInfo& { return one->info; }, entry);
}

std::string_view Contestant::task_name() const { return tasks_of(kind())[task]; }

bool Contestant::is_promised() const {
  if (info().origin != Origin::ours) return false;
  if (const auto* const* concave = std::get_if<const ConcaveEntry*>(&entry)) {
    return !(*concave)->approximate;
  }
  if (const auto* const* ray = std::get_if<const RayCastEntry*>(&entry)) {
    return (*ray)->exact_verdicts;
  }
  return true;
}

std::string Contestant::name() const {
  return fmt::format("{} {} {}", info().name, to_string(scalar), task_name());
}

std::vector<Contestant> contestants(CaseKind kind, const std::vector<std::string>& names,
                                    std::span<const Precision> scalars) {
  std::vector<Contestant> all;
  switch (kind) {
    case CaseKind::concave:
      add(all, registry::entries<ConcaveEntry>(), "concave phase", names, scalars);
      break;
    case CaseKind::rays:
      add(all, registry::entries<RayCastEntry>(), "ray cast", names, scalars);
      break;
    case CaseKind::points:
      add(all, registry::entries<PointQueryEntry>(), "point query", names, scalars);
      break;
    case CaseKind::cast: add(all, registry::entries<CastEntry>(), "cast", names, scalars); break;
    case CaseKind::ccd:
      add(all, registry::entries<CcdEntry>(), "continuous collision", names, scalars);
      break;
    case CaseKind::scene_rays:
      add(all, registry::entries<SceneRayCastEntry>(), "ray cast of scenes", names, scalars);
      break;
  }
  return all;
}

}  // namespace touchstone::check
