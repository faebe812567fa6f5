// Collects the families of all kinds.
#include "harness/kinds/kind.h"

#include <utility>
#include <vector>

#include "harness/kinds/family.h"
#include "harness/families/aimed_rays.h"
#include "harness/families/ccd_families.h"
#include "harness/families/ray_scenes.h"
#include "harness/families/tried_points.h"

namespace touchstone::kinds {
namespace {

struct FamilyLists {
  std::vector<CaseFamily> families, axes;
  std::uint32_t number = 0;  // of the next of its kind

  void add(CaseKind kind, std::string name, std::string group, int one_in = 1,
           const std::string& axis = "", const std::string& value = "") {
    (axis.empty() ? families : axes)
        .push_back({std::move(name), std::move(group), kind, number++, one_in, axis, value});
  }
  template <class Place>
  void add_places(CaseKind kind, const std::vector<Place>& places) {
    for (const Place& at : places) {
      add(kind, at.axis + "-" + at.value, "axes", 1, at.axis, at.value);
    }
  }
  template <class Drawn>
  void add_drawn(CaseKind kind, std::span<const Drawn> drawn) {
    number = 0;
    for (const Drawn& one : drawn) {
      add(kind, one.name, one.group, one.one_in, one.axis, one.value);
    }
  }
};

const FamilyLists& lists() {
  static const FamilyLists all = [] {
    FamilyLists made;
    made.add_drawn(CaseKind::concave, concave_families());
    made.number = 0;
    for (const families::RayAim aim : families::all_ray_aims) {
      made.add(CaseKind::rays, "rays-" + std::string(to_string(aim)), "rays");
    }
    made.add_places(CaseKind::rays, ray_axis());
    made.number = 0;
    // First with closed meshes, for which points have a side, then with any.
    for (const char* prefix : {"points-", "points-any-mesh-"}) {
      for (const families::PointPlace place : families::all_point_places) {
        made.add(CaseKind::points, prefix + std::string(to_string(place)), "points");
      }
    }
    made.add_places(CaseKind::points, point_axis());
    made.add_drawn(CaseKind::cast, cast_families());
    made.number = 0;
    for (const auto& family : families::ccd_families()) {
      made.add(CaseKind::ccd, family.name, std::string(to_string(family.pair)));
    }
    made.add_places(CaseKind::ccd, ccd_axes());
    made.number = 0;
    for (const families::RayScene scene : families::all_ray_scenes) {
      made.add(CaseKind::scene_rays, "scene-rays-" + std::string(to_string(scene)), "scene-rays");
    }
    made.add_places(CaseKind::scene_rays, scene_ray_axis());
    return made;
  }();
  return all;
}

}  // namespace

std::span<const CaseFamily> case_families() { return lists().families; }

std::span<const CaseFamily> axis_families() { return lists().axes; }

}  // namespace touchstone::kinds
