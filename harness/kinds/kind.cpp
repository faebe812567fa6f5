// The list of kinds, and what all of them do alike.
#include "harness/kinds/kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/kinds/checker.h"
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

std::span<const Kind* const> kinds() {
  static const std::array<const Kind*, 7> all = {
      &mesh_kind(),    &ray_kind(),       &point_kind(),        &cast_kind(),
      &feature_kind(), &scene_ray_kind(), &configuration_kind()};
  return all;
}

std::span<const Kind* const> checked_kinds() {
  static const std::array<const Kind*, 9> all = {
      &pair_kind(),    &mesh_kind(),      &ray_kind(),           &point_kind(), &cast_kind(),
      &feature_kind(), &scene_ray_kind(), &configuration_kind(), &box_kind()};
  return all;
}

std::span<const Kind* const> asked_kinds() {
  static const std::array<const Kind*, 10> all = {
      &pair_kind(),  &box_kind(),  &mesh_kind(),    &ray_kind(),      &scene_ray_kind(),
      &point_kind(), &cast_kind(), &feature_kind(), &manifold_kind(), &configuration_kind()};
  return all;
}

namespace {

const Kind* find_in(std::span<const Kind* const> list, std::string_view name) {
  const auto words = registry::kind_named(name);
  if (!words) return nullptr;
  const auto at =
      std::ranges::find_if(list, [&](const Kind* kind) { return kind->name() == words->word; });
  return at == list.end() ? nullptr : *at;
}

}  // namespace

const Kind* find_kind(std::string_view name) { return find_in(kinds(), name); }
const Kind* find_asked_kind(std::string_view name) { return find_in(asked_kinds(), name); }

std::span<const Family> Kind::families() const {
  if (families_.empty()) {
    families_ = list_families();
    for (std::uint32_t number = 0; Family & family : families_) {
      family.kind = this;
      family.number = number++;
    }
  }
  return families_;
}

namespace {

std::vector<const Family*> chosen_families(bool of_axes) {
  std::vector<const Family*> chosen;
  for (const Kind* kind : checked_kinds()) {
    for (const Family& family : kind->families()) {
      if (family.axis.empty() != of_axes) chosen.push_back(&family);
    }
  }
  return chosen;
}

}  // namespace

std::vector<const Family*> case_families() { return chosen_families(false); }
std::vector<const Family*> axis_families() { return chosen_families(true); }

std::string_view Contestant::task_name() const { return kind->tasks()[task]; }

std::string Contestant::name() const {
  std::string text = fmt::format("{} {}", info->name, to_string(scalar));
  if (task != every_task) text += fmt::format(" {}", task_name());
  return text;
}

std::string_view to_string(CaseForm form) {
  constexpr std::array<std::string_view, all_case_forms.size()> names = {
      "as drawn", "swapped", "scaled", "moved", "reversed", "split"};
  return names[static_cast<std::size_t>(form)];
}

std::vector<AxisValue> decades(int first, int last) {
  std::vector<AxisValue> values;
  const int step = first < last ? 1 : -1;
  for (int e = first; e != last + step; e += step) {
    const std::string name = fmt::format("1e{}", e);
    values.push_back({name, std::stod(name)});
  }
  return values;
}

void add_axis(std::vector<Family>& list, const std::string& axis,
              std::span<const AxisValue> values) {
  for (const AxisValue& at : values) {
    list.push_back({.name = axis + "-" + at.name, .group = "axes", .axis = axis, .value = at.name});
  }
}

std::string_view to_string(Grade grade) {
  constexpr std::array<std::string_view, 10> names = {"not_asked", "unresolved", "right",   "near",
                                                      "missed",    "false",      "inexact", "bound",
                                                      "gave_up",   "failed"};
  return names[static_cast<std::size_t>(grade)];
}

void GradeCount::add(const Graded& graded, std::int64_t index) {
  if (graded.grade == Grade::not_asked) {
    ++not_asked;
    return;
  }
  ++cases;
  contacts += graded.is_contact ? 1 : 0;
  bool is_bad = false;
  switch (graded.grade) {
    case Grade::not_asked: break;
    case Grade::unresolved: ++unresolved; break;
    case Grade::right: ++right; break;
    case Grade::near: ++near; break;
    case Grade::bound: ++bound; break;
    case Grade::gave_up: ++gave_up; break;
    case Grade::missed: ++missed, is_bad = true; break;
    case Grade::false_hit: ++false_hits, is_bad = true; break;
    case Grade::inexact: ++inexact, is_bad = true; break;
    case Grade::failed: ++failed, is_bad = true; break;
  }
  if (is_bad && first_wrong < 0) first_wrong = index;
}

void GradeCount::add(const GradeCount& other) {
  for (const auto count :
       {&GradeCount::not_asked, &GradeCount::cases, &GradeCount::contacts, &GradeCount::unresolved,
        &GradeCount::right, &GradeCount::near, &GradeCount::missed, &GradeCount::false_hits,
        &GradeCount::inexact, &GradeCount::bound, &GradeCount::gave_up, &GradeCount::failed}) {
    this->*count += other.*count;
  }
  if (first_wrong < 0) first_wrong = other.first_wrong;
}

}  // namespace touchstone::kinds
