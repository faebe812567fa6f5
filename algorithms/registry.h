// The registry of all algorithms, ours and the peers', built or not. The list itself is in
// CMakeLists.txt beside this file, one line each. A line names a file, which defines a function
// that returns its entries, in the namespace touchstone::entries and named after its folder and
// itself:
//     std::vector<BroadPhaseEntry> broad_phase_naive() { return {{.info = {...}, .make = ...}}; }
// The harness includes this; algorithms do not.
#pragma once

#include <span>
#include <string_view>

#include "algorithms/broad_phase.h"
#include "algorithms/cast.h"
#include "algorithms/ccd.h"
#include "algorithms/concave_phase.h"
#include "algorithms/contact_manifold.h"
#include "algorithms/mid_phase.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/point_query.h"
#include "algorithms/ray_cast.h"
#include "algorithms/scene_ray_cast.h"

namespace touchstone {

// The entries, in the order of the list. Names are unique within a contract.
std::span<const BroadPhaseEntry> broad_phases();
std::span<const NarrowPhaseEntry> narrow_phases();
std::span<const ManifoldEntry> contact_manifolds();
std::span<const RayCastEntry> ray_casts();
std::span<const SceneRayCastEntry> scene_ray_casts();
std::span<const PointQueryEntry> point_queries();
std::span<const MidPhaseEntry> mid_phases();
std::span<const ConcaveEntry> concave_phases();
std::span<const CastEntry> casts();
std::span<const CcdEntry> ccds();

// Each returns null if no entry has that name.
const BroadPhaseEntry* find_broad_phase(std::string_view name);
const NarrowPhaseEntry* find_narrow_phase(std::string_view name);
const ManifoldEntry* find_contact_manifold(std::string_view name);
const RayCastEntry* find_ray_cast(std::string_view name);
const SceneRayCastEntry* find_scene_ray_cast(std::string_view name);
const PointQueryEntry* find_point_query(std::string_view name);
const MidPhaseEntry* find_mid_phase(std::string_view name);
const ConcaveEntry* find_concave_phase(std::string_view name);
const CastEntry* find_cast(std::string_view name);
const CcdEntry* find_ccd(std::string_view name);

inline bool is_built(const AlgorithmInfo& info) { return info.reason.empty(); }
bool offers(const NarrowPhaseEntry& entry, Task task);
bool offers(const NarrowPhaseEntry& entry, Precision scalar);
// True if the entry offers the task for these kinds, in either order.
bool offers(const NarrowPhaseEntry& entry, ShapeKind a, ShapeKind b, Task task);
bool offers(const ManifoldEntry& entry, Precision scalar);
bool offers(const RayCastEntry& entry, RayTask task);
bool offers(const RayCastEntry& entry, Precision scalar);
bool offers(const ConcaveEntry& entry, ConcaveTask task, Precision scalar);
// True if the entry takes such settings, and pairs of these kinds, in either order, one of which turns
// or none.
bool offers(const CastEntry& entry, const CastSettings& settings);
bool offers(const CastEntry& entry, ShapeKind a, ShapeKind b, bool turns);
bool offers(const ManifoldEntry& entry, ShapeKind a, ShapeKind b);  // kinds in either order
// The encoding of a pair of these kinds, in either order.
Encoding encoding_of(const NarrowPhaseEntry& entry, ShapeKind a, ShapeKind b, Task task,
                     Precision scalar);

}  // namespace touchstone
