// Algorithms of the kinds that are checked on families: concave phases, ray casts, point queries, casts,
// continuous collision and ray casts of scenes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "algorithms/registry.h"

namespace touchstone::check {

enum class CaseKind : std::uint8_t { concave, rays, points, cast, ccd, scene_rays };
inline constexpr std::array all_case_kinds = {CaseKind::concave, CaseKind::rays,
                                              CaseKind::points,  CaseKind::cast,
                                              CaseKind::ccd,     CaseKind::scene_rays};

std::string_view to_string(CaseKind kind);  // the option that names algorithms of the kind

// An algorithm, the precision of its input, and what it is asked.
struct Contestant {
  // In the order of CaseKind.
  std::variant<const ConcaveEntry*, const RayCastEntry*, const PointQueryEntry*, const CastEntry*,
               const CcdEntry*, const SceneRayCastEntry*>
      entry;
  Precision scalar = Precision::float64;
  std::uint8_t task = 0;  // place in the names of its kind's tasks

  CaseKind kind() const { return static_cast<CaseKind>(entry.index()); }
  const AlgorithmInfo& info() const;
  std::string_view task_name() const;
  // True if it is ours and promises that what it stands by is right.
  bool is_promised() const;
  std::string name() const;  // such as "wide-bvh double closest"
};

// Returns what the algorithms of these names and groups are asked, in those of the scalars that they
// offer. The oracle belongs to no group, unless it is named. Throws InputError for an unknown name.
std::vector<Contestant> contestants(CaseKind kind, const std::vector<std::string>& names,
                                    std::span<const Precision> scalars);

}  // namespace touchstone::check
