// The registry of all algorithms, ours and the peers', built or not. The list itself is in
// CMakeLists.txt beside this file, one line each. A line names a file, which defines a function
// that returns its entries, in the namespace touchstone::entries and named after its folder and
// itself:
//     std::vector<BroadPhaseEntry> broad_phase_naive() { return {{.info = {...}, .make = ...}}; }
// The harness includes this; algorithms do not.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "algorithms/broad_phase.h"
#include "algorithms/cast.h"
#include "algorithms/ccd.h"
#include "algorithms/concave_phase.h"
#include "algorithms/configuration_query.h"
#include "algorithms/contact_manifold.h"
#include "algorithms/mid_phase.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/point_query.h"
#include "algorithms/ray_cast.h"
#include "algorithms/scene_ray_cast.h"

namespace touchstone {

// What a kind of query is called. A kind is a contract, and is named by the type of its entries.
struct KindWords {
  std::string_view word;   // in options, columns and campaigns
  std::string_view title;  // what its algorithms are: a heading
  // Other words that are accepted wherever a kind is given. None is a word of another kind.
  std::array<std::string_view, 2> other = {};
};

template <class Entry>
inline constexpr KindWords kind_words = {};  // has no meaning but for the types below
template <>
inline constexpr KindWords kind_words<BroadPhaseEntry> = {
    "box", "broad phases", {"broad", "boxes"}};
template <>
inline constexpr KindWords kind_words<NarrowPhaseEntry> = {
    "pair", "narrow phases", {"narrow", "pairs"}};
template <>
inline constexpr KindWords kind_words<ManifoldEntry> = {
    "manifold", "contact manifolds", {"manifolds"}};
template <>
inline constexpr KindWords kind_words<RayCastEntry> = {"ray", "ray casts of meshes", {"rays"}};
template <>
inline constexpr KindWords kind_words<SceneRayCastEntry> = {
    "scene-ray", "ray casts of scenes", {"scene-rays"}};
template <>
inline constexpr KindWords kind_words<PointQueryEntry> = {
    "point", "point queries of meshes", {"points"}};
template <>
inline constexpr KindWords kind_words<MidPhaseEntry> = {"mid-phase", "mid-phases", {"mid"}};
template <>
inline constexpr KindWords kind_words<ConcaveEntry> = {
    "mesh", "collision of meshes", {"concave", "meshes"}};
template <>
inline constexpr KindWords kind_words<CastEntry> = {
    "cast", "casts of moving bodies", {"shape-cast", "casts"}};
template <>
inline constexpr KindWords kind_words<CcdEntry> = {
    "feature", "continuous collision of features", {"ccd", "features"}};
template <>
inline constexpr KindWords kind_words<ConfigurationEntry> = {
    "configuration", "configurations of robots", {"configurations"}};

namespace registry {

// Calls visit.operator()<Entry>() for the type of entries of each kind.
template <class Visit>
void for_each_kind(Visit&& visit) {
  const auto each = [&]<class... Entry>() { (visit.template operator()<Entry>(), ...); };
  each.template operator()<BroadPhaseEntry, NarrowPhaseEntry, ManifoldEntry, RayCastEntry,
                           SceneRayCastEntry, PointQueryEntry, MidPhaseEntry, ConcaveEntry,
                           CastEntry, CcdEntry, ConfigurationEntry>();
}

// Returns the words of the kind with this word, or with this other word; nothing if there is none.
std::optional<KindWords> kind_named(std::string_view word);

// The entries of a kind, in the order of the list. Names are unique within a kind. Defined in the file
// that CMake writes from registry_list.cpp.in, for each kind, as are the next two.
template <class Entry>
std::span<const Entry> entries();

// False in the first program, which lists only what the standard comparison measures.
bool is_whole();

// Whether the time of what is added is an algorithm's. That of a program behind a pipe is not.
enum class Timed : bool { no, yes };
// Adds an entry behind those of the list. Its name is of no entry of its kind yet; one that is not timed is of no entry
// of any kind. Spans that `entries` returned before lack it. At most `most_added` of a kind; throws std::length_error
// beyond. Of a module's, whose name no entry of another file has, `file` is the file.
inline constexpr std::size_t most_added = 64;
template <class Entry>
void add(Entry entry, Timed timed, const std::string& file = {});
// The file of the module that has this algorithm; empty if none has.
std::string module_of(const AlgorithmInfo& info);

// Returns null if no entry has that name.
template <class Entry>
const Entry* find(std::string_view name) {
  const std::span<const Entry> all = entries<Entry>();
  const auto at = std::ranges::find_if(all, [&](const Entry& e) { return e.info.name == name; });
  return at == all.end() ? nullptr : &*at;
}

}  // namespace registry

inline bool is_built(const AlgorithmInfo& info) { return info.reason.empty(); }
// False for those that were added as such: they are graded, and in no table of times.
bool is_timed(const AlgorithmInfo& info);
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
