// Collects the families of all kinds.
#include "harness/check/kinds/family.h"

#include <vector>

#include "harness/check/kinds/blocks/drawn_cases.h"
#include "harness/families/aimed_rays.h"
#include "harness/families/ccd_families.h"
#include "harness/families/tried_points.h"

namespace touchstone::check {

std::span<const CaseFamily> case_families() {
  static const std::vector<CaseFamily> all = [] {
    std::vector<CaseFamily> list;
    const auto add = [&](CaseKind kind, std::string name, std::string group, int one_in = 1) {
      const bool is_first = list.empty() || list.back().kind != kind;
      list.push_back(
          {std::move(name), std::move(group), kind, is_first ? 0 : list.back().number + 1, one_in});
    };
    for (const auto& family : concave_families()) {
      add(CaseKind::concave, family.name, family.group, family.one_in);
    }
    for (const families::RayAim aim : families::all_ray_aims) {
      add(CaseKind::rays, "rays-" + std::string(to_string(aim)), "rays");
    }
    // First with closed meshes, for which points have a side, then with any.
    for (const char* prefix : {"points-", "points-any-mesh-"}) {
      for (const families::PointPlace place : families::all_point_places) {
        add(CaseKind::points, prefix + std::string(to_string(place)), "points");
      }
    }
    for (const auto& family : cast_families()) {
      add(CaseKind::cast, family.name, family.group, family.one_in);
    }
    for (const auto& family : families::ccd_families()) {
      add(CaseKind::ccd, family.name, std::string(to_string(family.pair)));
    }
    return list;
  }();
  return all;
}

}  // namespace touchstone::check
