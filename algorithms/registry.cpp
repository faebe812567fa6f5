// The registry: look-ups by name, and what an entry offers.
#include "algorithms/registry.h"

#include <algorithm>
#include <utility>

#include "algorithms/within_margin.h"

namespace touchstone {

// Defined in the file that CMake writes from registry_list.cpp.in.
std::vector<BroadPhaseEntry> list_broad_phases();
std::vector<NarrowPhaseEntry> list_narrow_phases();
std::vector<ManifoldEntry> list_contact_manifolds();
std::vector<RayCastEntry> list_ray_casts();
std::vector<SceneRayCastEntry> list_scene_ray_casts();
std::vector<PointQueryEntry> list_point_queries();
std::vector<MidPhaseEntry> list_mid_phases();
std::vector<ConcaveEntry> list_concave_phases();
std::vector<CastEntry> list_casts();
std::vector<CcdEntry> list_ccds();

namespace {

// Returns the narrow phases, which keep to the margin.
std::vector<NarrowPhaseEntry> list_within_margin() {
  std::vector<NarrowPhaseEntry> entries = list_narrow_phases();
  for (NarrowPhaseEntry& entry : entries) {
    if (!entry.make) continue;
    entry.make = [make = entry.make](const NarrowPhaseSettings& settings) {
      std::unique_ptr<NarrowPhase> made = make(settings);
      if (settings.margin) made = std::make_unique<WithinMargin>(std::move(made), *settings.margin);
      return made;
    };
  }
  return entries;
}

// The list that `make` returns, which is made once.
template <class Entry, std::vector<Entry> (*make)()>
std::span<const Entry> list_of() {
  static const std::vector<Entry> list = make();
  return list;
}

template <class Entry>
const Entry* find(std::span<const Entry> entries, std::string_view name) {
  const auto at =
      std::ranges::find_if(entries, [&](const Entry& e) { return e.info.name == name; });
  return at == entries.end() ? nullptr : &*at;
}

template <class Value>
bool has(const std::vector<Value>& list, Value value) {
  return std::ranges::find(list, value) != list.end();
}

}  // namespace

std::span<const BroadPhaseEntry> broad_phases() {
  return list_of<BroadPhaseEntry, list_broad_phases>();
}
std::span<const NarrowPhaseEntry> narrow_phases() {
  return list_of<NarrowPhaseEntry, list_within_margin>();
}
std::span<const ManifoldEntry> contact_manifolds() {
  return list_of<ManifoldEntry, list_contact_manifolds>();
}
std::span<const RayCastEntry> ray_casts() { return list_of<RayCastEntry, list_ray_casts>(); }
std::span<const SceneRayCastEntry> scene_ray_casts() {
  return list_of<SceneRayCastEntry, list_scene_ray_casts>();
}
std::span<const PointQueryEntry> point_queries() {
  return list_of<PointQueryEntry, list_point_queries>();
}
std::span<const MidPhaseEntry> mid_phases() { return list_of<MidPhaseEntry, list_mid_phases>(); }
std::span<const ConcaveEntry> concave_phases() {
  return list_of<ConcaveEntry, list_concave_phases>();
}
std::span<const CastEntry> casts() { return list_of<CastEntry, list_casts>(); }
std::span<const CcdEntry> ccds() { return list_of<CcdEntry, list_ccds>(); }

const BroadPhaseEntry* find_broad_phase(std::string_view name) {
  return find(broad_phases(), name);
}
const NarrowPhaseEntry* find_narrow_phase(std::string_view name) {
  return find(narrow_phases(), name);
}
const ManifoldEntry* find_contact_manifold(std::string_view name) {
  return find(contact_manifolds(), name);
}
const RayCastEntry* find_ray_cast(std::string_view name) { return find(ray_casts(), name); }
const SceneRayCastEntry* find_scene_ray_cast(std::string_view name) {
  return find(scene_ray_casts(), name);
}
const PointQueryEntry* find_point_query(std::string_view name) {
  return find(point_queries(), name);
}
const MidPhaseEntry* find_mid_phase(std::string_view name) { return find(mid_phases(), name); }
const ConcaveEntry* find_concave_phase(std::string_view name) {
  return find(concave_phases(), name);
}
const CastEntry* find_cast(std::string_view name) { return find(casts(), name); }
const CcdEntry* find_ccd(std::string_view name) { return find(ccds(), name); }

bool offers(const NarrowPhaseEntry& entry, Task task) { return has(entry.tasks, task); }
bool offers(const NarrowPhaseEntry& entry, Precision scalar) { return has(entry.scalars, scalar); }

bool offers(const NarrowPhaseEntry& entry, ShapeKind a, ShapeKind b, Task task) {
  if (!offers(entry, task)) return false;
  return entry.supports == nullptr || entry.supports(std::min(a, b), std::max(a, b), task);
}

bool offers(const ManifoldEntry& entry, Precision scalar) { return has(entry.scalars, scalar); }

bool offers(const ManifoldEntry& entry, ShapeKind a, ShapeKind b) {
  return entry.supports == nullptr || entry.supports(std::min(a, b), std::max(a, b));
}

bool offers(const RayCastEntry& entry, RayTask task) { return has(entry.tasks, task); }
bool offers(const RayCastEntry& entry, Precision scalar) { return has(entry.scalars, scalar); }

bool offers(const ConcaveEntry& entry, ConcaveTask task, Precision scalar) {
  return has(entry.tasks, task) && has(entry.scalars, scalar);
}

bool offers(const CastEntry& entry, const CastSettings& settings) {
  return has(entry.scalars, settings.scalar) &&
         (settings.start == StartContact::counts || entry.approach);
}

bool offers(const CastEntry& entry, ShapeKind a, ShapeKind b, bool turns) {
  if (turns && !entry.rotation) return false;
  return entry.supports == nullptr || entry.supports(std::min(a, b), std::max(a, b), turns);
}

Encoding encoding_of(const NarrowPhaseEntry& entry, ShapeKind a, ShapeKind b, Task task,
                     Precision scalar) {
  if (entry.encoding == nullptr) return Encoding::as_given;
  return entry.encoding(std::min(a, b), std::max(a, b), task, scalar);
}

std::string_view to_string(Origin origin) {
  switch (origin) {
    case Origin::ours: return "ours";
    case Origin::peer: return "peer";
    case Origin::oracle: return "oracle";
  }
  return "?";
}

std::string_view to_string(PointTask task) {
  switch (task) {
    case PointTask::closest: return "closest";
    case PointTask::side: return "side";
  }
  return "?";
}

std::string_view to_string(PointSide side) {
  switch (side) {
    case PointSide::outside: return "outside";
    case PointSide::surface: return "surface";
    case PointSide::inside: return "inside";
    case PointSide::unknown: return "unknown";
  }
  return "?";
}

std::string_view to_string(RayTask task) {
  switch (task) {
    case RayTask::closest: return "closest";
    case RayTask::any: return "any";
  }
  return "?";
}

std::string_view to_string(ConcaveTask task) {
  switch (task) {
    case ConcaveTask::intersect: return "intersect";
    case ConcaveTask::distance: return "distance";
    case ConcaveTask::contacts: return "contacts";
  }
  return "?";
}

std::string_view to_string(FeaturePair pair) {
  return pair == FeaturePair::vertex_face ? "vertex-face" : "edge-edge";
}

std::string_view to_string(CcdAnswer answer) {
  switch (answer) {
    case CcdAnswer::hit: return "hit";
    case CcdAnswer::miss: return "miss";
    case CcdAnswer::unknown: return "unknown";
  }
  return "?";
}

}  // namespace touchstone
