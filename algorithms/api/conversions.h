// What the interface's types are inside, and checks of what users give. The sources of this room include it. There
// the interface's names are in touchstone::v1, and touchstone::Shape is that of the core.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <touchstone/touchstone.hpp>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/registry.h"

namespace touchstone::v1 {

struct Shape::Data {
  std::uint64_t id;  // no other shape of the process has it
  touchstone::Shape shape;
};

// These throw. They are apart, so that the calls of one pair stay short.
[[noreturn]] void refuse_moved_shape();
[[noreturn]] void refuse_moved_solver();
[[noreturn]] void refuse_pose();

// Throws if the shape was moved from.
inline const Shape::Data& data_of(const Shape& shape) {
  if (shape.data() == nullptr) [[unlikely]]
    refuse_moved_shape();
  return *shape.data();
}

inline Vec3d inner(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Vec3 outer(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }

inline Status outer(touchstone::Status status) {
  switch (status) {
    case touchstone::Status::ok: return Status::ok;
    case touchstone::Status::not_converged: return Status::not_converged;
    case touchstone::Status::degenerate: return Status::degenerate;
    case touchstone::Status::capacity: return Status::capacity;
    default: return Status::unsupported;
  }
}

inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Both poses are twelve doubles: the matrix column by column, then the translation.
static_assert(sizeof(Pose) == 12 * sizeof(double) && sizeof(touchstone::Pose) == sizeof(Pose));
static_assert(offsetof(Pose, translation) == 9 * sizeof(double) && !Mat3d::IsRowMajor);
inline void write_inner(const Pose& pose, touchstone::Pose& inner) {
  std::memcpy(static_cast<void*>(&inner), &pose, sizeof pose);
}

// Returns false if one of its numbers is infinite or NaN.
inline bool is_finite(const Pose& pose) {
  return is_finite(pose.x_axis) && is_finite(pose.y_axis) && is_finite(pose.z_axis) &&
         is_finite(pose.translation);
}

inline void check_pose(const Pose& pose) {
  if (!is_finite(pose)) [[unlikely]]
    refuse_pose();
}

// The same for a pair that is asked for alone. A sum is infinite or NaN if a number in it is, or if it overflows, and then
// each number is looked at. Numbers are read one by one, by `volatile`, and written in twos: a processor waits where it reads
// together what was just written apart.
// `numbers` has room for two poses, which then are there.
inline std::span<const touchstone::Pose> write_inner_checked(const Pose& pose_a, const Pose& pose_b,
                                                             std::array<double, 24>& numbers) {
  using Two [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;
  Two twos{};
  double ones = 0;
  double* to = numbers.data();
  const auto alone = [](const double& number) {
    return static_cast<const volatile double&>(number);
  };
  for (const Pose* pose : {&pose_a, &pose_b}) {
    for (const Vec3* from : {&pose->x_axis, &pose->y_axis, &pose->z_axis, &pose->translation}) {
      const Two two = {alone(from->x), alone(from->y)};
      const double one = alone(from->z);
      twos += two;
      ones += one;
      *reinterpret_cast<Two*>(to) = two;
      to[2] = one;
      to += 3;
    }
  }
  const double sum = twos[0] + twos[1] + ones;
  if (!(sum - sum == 0)) [[unlikely]] {
    check_pose(pose_a);
    check_pose(pose_b);
  }
  return {reinterpret_cast<const touchstone::Pose*>(numbers.data()), 2};
}

std::string joined(const std::vector<std::string>& names);

// Returns the entry of that name, or throws with all names. `what` is such as "narrow phase".
template <class Entry>
const Entry& entry_named(std::string_view name, std::string_view what) {
  if (const Entry* entry = registry::find<Entry>(name)) return *entry;
  std::vector<std::string> names;
  for (const Entry& entry : registry::entries<Entry>()) names.push_back(entry.info.name);
  throw Error("found '" + std::string(name) + "'; expected a " + std::string(what) + ": " +
              joined(names));
}

}  // namespace touchstone::v1
