// What the interface's types are inside, and checks of what users give. The sources of this room include it. There
// the interface's names are in touchstone::v1, and touchstone::Shape is that of the core.
#pragma once

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

// Throws if the shape was moved from.
inline const Shape::Data& data_of(const Shape& shape) {
  if (shape.data() == nullptr)
    throw Error("this shape was moved from; expected one that has a value");
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
inline bool is_finite(const touchstone::Pose& pose) {
  // Zero times a number is zero, unless that is infinite or NaN.
  const double sum = (0 * pose.rotation).sum() + (0 * pose.translation).sum();
  return sum == 0;
}
inline void check_pose(const Pose& pose) {
  touchstone::Pose given;
  write_inner(pose, given);
  if (!is_finite(given))
    throw Error("found a pose with a number that is infinite or NaN; expected finite ones");
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
