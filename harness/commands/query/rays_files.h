// What `rays` reads and prints, for meshes and scenes.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/ray_cast.h"

namespace touchstone::commands {

struct RaysOptions {
  std::string target, rays, cast, out;  // target: a mesh or a scene
  std::string saved, certificates;      // files of proofs; none if empty
  std::optional<RayTask> asked;
  RayTask task = RayTask::closest;
  RayCastSettings settings;
  int frame = 0;
  double time_limit = 5;  // seconds a ray
};

// Throws InputError with file, line and what was expected.
std::vector<Ray> read_rays(const std::string& file);

// What failures of a ray are told with.
std::string name_of_ray(std::size_t ray);

// The number of an algorithm's hits and of each status.
struct RaysSummary {
  std::string name;
  std::size_t hits = 0, misses = 0;
  std::map<Status, std::size_t> statuses = {};

  void add(bool hit, Status status) {
    ++(hit ? hits : misses);
    ++statuses[status];
  }
};
void print_summaries(const std::vector<RaysSummary>& summaries);

}  // namespace touchstone::commands
