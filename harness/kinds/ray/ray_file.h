// Files of rays.
#pragma once

#include <filesystem>

#include "algorithms/ray_cast.h"

namespace touchstone::kinds {

// Writes a file of one ray for `touchstone query`.
void write_ray(const std::filesystem::path& file, const Ray& ray);

}  // namespace touchstone::kinds
