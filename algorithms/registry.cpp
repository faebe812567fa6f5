// The registry: look-ups by name, and what an entry offers.
#include "algorithms/registry.h"

#include <algorithm>

namespace touchstone {

// Defined in the file that CMake writes from registry_list.cpp.in.
std::vector<BroadPhaseEntry> list_broad_phases();
std::vector<NarrowPhaseEntry> list_narrow_phases();
std::vector<ManifoldEntry> list_contact_manifolds();
std::vector<RayCastEntry> list_ray_casts();
std::vector<PointQueryEntry> list_point_queries();

namespace {

template <class Entry>
const Entry* find(std::span<const Entry> entries, std::string_view name) {
  const auto at =
      std::ranges::find_if(entries, [&](const Entry& e) { return e.info.name == name; });
  return at == entries.end() ? nullptr : &*at;
}

}  // namespace

std::span<const BroadPhaseEntry> broad_phases() {
  static const std::vector<BroadPhaseEntry> list = list_broad_phases();
  return list;
}

std::span<const NarrowPhaseEntry> narrow_phases() {
  static const std::vector<NarrowPhaseEntry> list = list_narrow_phases();
  return list;
}

std::span<const ManifoldEntry> contact_manifolds() {
  static const std::vector<ManifoldEntry> list = list_contact_manifolds();
  return list;
}

std::span<const RayCastEntry> ray_casts() {
  static const std::vector<RayCastEntry> list = list_ray_casts();
  return list;
}

std::span<const PointQueryEntry> point_queries() {
  static const std::vector<PointQueryEntry> list = list_point_queries();
  return list;
}

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
const PointQueryEntry* find_point_query(std::string_view name) {
  return find(point_queries(), name);
}

bool offers(const NarrowPhaseEntry& entry, Task task) {
  return std::ranges::find(entry.tasks, task) != entry.tasks.end();
}

bool offers(const NarrowPhaseEntry& entry, Precision scalar) {
  return std::ranges::find(entry.scalars, scalar) != entry.scalars.end();
}

bool offers(const NarrowPhaseEntry& entry, ShapeKind a, ShapeKind b, Task task) {
  if (!offers(entry, task)) return false;
  return entry.supports == nullptr || entry.supports(std::min(a, b), std::max(a, b), task);
}

bool offers(const ManifoldEntry& entry, Precision scalar) {
  return std::ranges::find(entry.scalars, scalar) != entry.scalars.end();
}

bool offers(const RayCastEntry& entry, RayTask task) {
  return std::ranges::find(entry.tasks, task) != entry.tasks.end();
}

bool offers(const RayCastEntry& entry, Precision scalar) {
  return std::ranges::find(entry.scalars, scalar) != entry.scalars.end();
}

bool offers(const ManifoldEntry& entry, ShapeKind a, ShapeKind b) {
  return entry.supports == nullptr || entry.supports(std::min(a, b), std::max(a, b));
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

}  // namespace touchstone
