// Files of rays.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/ray_cast.h"
#include "harness/kinds/questions.h"

namespace touchstone::kinds {

// Writes a file of one ray for `touchstone query`.
void write_ray(const std::filesystem::path& file, const Ray& ray);

// Reads such a file. Throws InputError with file, line and what was expected.
std::vector<Ray> read_rays(const std::filesystem::path& file);

std::string label_of_ray(std::size_t ray);  // in messages
// The task that is asked of rays at meshes and at scenes.
RayTask asked_ray_task(const QuestionInput& input);

}  // namespace touchstone::kinds
