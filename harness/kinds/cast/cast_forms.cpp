// Makes the forms.
#include "harness/kinds/cast/cast_kind.h"

#include <optional>
#include <utility>

#include "harness/families/moving_pairs.h"
#include "harness/geometry/tessellation.h"
#include "harness/process/solve_cast.h"

namespace touchstone::kinds {
namespace {

using files::CastCase;

CastCase swapped_case(CastCase c) {
  std::swap(c.shape_a, c.shape_b);
  std::swap(c.pose_a, c.pose_b);
  std::swap(c.motion_a, c.motion_b);
  return c;
}

CastCase scaled_case(CastCase c, double scale) {
  c.shape_a = geometry::scaled_shape(c.shape_a, scale);
  c.shape_b = geometry::scaled_shape(c.shape_b, scale);
  for (Pose* pose : {&c.pose_a, &c.pose_b}) pose->translation *= scale;
  for (Motion* motion : {&c.motion_a, &c.motion_b}) motion->displacement *= scale;
  return c;
}

std::optional<CastCase> moved_case(CastCase c, const FormNumbers& numbers) {
  for (const auto& [pose, motion] :
       {std::pair(&c.pose_a, &c.motion_a), std::pair(&c.pose_b, &c.motion_b)}) {
    const auto sum = exact_sum(numbers.turn(pose->translation), numbers.shift);
    if (!sum) return std::nullopt;
    pose->translation = *sum;
    pose->rotation = numbers.turn(pose->rotation);
    motion->displacement = numbers.turn(motion->displacement);
    motion->rotation_vector = numbers.turn(motion->rotation_vector);
  }
  return c;
}

// The motion from a part of the time to its end. The poses of bodies that turn are rounded there.
std::optional<CastCase> from_time(CastCase c, double time) {
  const bool turns = process::turns(c);
  for (const auto& [pose, motion] :
       {std::pair(&c.pose_a, &c.motion_a), std::pair(&c.pose_b, &c.motion_b)}) {
    if (turns) {
      *pose = families::pose_at(*pose, *motion, time);
      continue;
    }
    const auto sum = exact_sum(pose->translation, time * motion->displacement);
    if (!sum) return std::nullopt;
    pose->translation = *sum;
  }
  return c;
}

void multiply_motion(CastCase& c, double factor) {
  for (Motion* motion : {&c.motion_a, &c.motion_b}) {
    motion->displacement *= factor;
    motion->rotation_vector *= factor;
  }
}

}  // namespace

CastParts parts_in_form(const CastCase& c, const FormNumbers& numbers, CaseForm form) {
  switch (form) {
    case CaseForm::as_drawn: return {c};
    case CaseForm::swapped: return {swapped_case(c)};
    case CaseForm::scaled: return {scaled_case(c, numbers.scale)};
    case CaseForm::moved: {
      const auto moved = moved_case(c, numbers);
      return moved ? CastParts{*moved} : CastParts{};
    }
    case CaseForm::reversed: {
      auto end = from_time(c, 1);
      if (!end) return {};
      multiply_motion(*end, -1);
      return {*end};
    }
    case CaseForm::split: {
      auto second = from_time(c, 0.5);
      if (!second) return {};
      CastCase first = c;
      multiply_motion(first, 0.5);
      multiply_motion(*second, 0.5);
      return {first, *second};
    }
  }
  return {};
}

bool rounds(const CastCase& c, CaseForm form) {
  return process::turns(c) && (form == CaseForm::reversed || form == CaseForm::split);
}

}  // namespace touchstone::kinds
