// What all certificates of rays begin with, as JSON.
#pragma once

#include <cstdint>

#include "harness/files/json_line.h"

namespace touchstone::files {

struct RayFields {
  std::uint64_t ray;  // its number in the file of rays
  bool is_first;      // the task is closest, or else any
  Vec3d origin, direction;
  double t_max;
};

// Throws InputError with the place of what is malformed.
RayFields read_ray_fields(const JsonNode& line);
OrderedJson ray_fields_to_json(const RayFields& fields);

}  // namespace touchstone::files
