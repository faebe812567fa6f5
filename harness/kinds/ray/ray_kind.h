// What the files about rays at meshes share.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/ray_cast.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/exact_forms.h"
#include "harness/kinds/questions.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::kinds {

// Forms of rays: scaled, and turned and moved; nothing if that rounds the origin.
Ray scaled_ray(Ray ray, double scale);
std::optional<Ray> moved_ray(Ray ray, const FormNumbers& numbers, const Vec3d& shift);

// Files of rays.

// Writes a file of one ray for `touchstone query`.
void write_ray(const std::filesystem::path& file, const Ray& ray);

// Reads such a file. Throws InputError with file, line and what was expected.
std::vector<Ray> read_rays(const std::filesystem::path& file);

std::string label_of_ray(std::size_t ray);  // in messages
// The task that is asked of rays at meshes and at scenes.
RayTask asked_ray_task(const QuestionInput& input);

// Timed sets of rays at meshes.

std::vector<PlannedSet> ray_sets(files::TomlTable& table, const std::filesystem::path& home);

// Rays of a CSV file, which are cast at a mesh.

std::vector<QueryOption> ray_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_ray_questions(const QuestionInput& input);
// Prints what is refused and why; with the file of questions, if any, also what is of none of them.
bool verify_ray_proofs(const std::string& proofs, const std::filesystem::path& file);

}  // namespace touchstone::kinds
