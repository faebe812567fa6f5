// Rays of a CSV file, which are cast at the bodies of a scene.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/kinds/questions.h"

namespace touchstone::kinds {

std::vector<QueryOption> scene_ray_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_scene_ray_questions(const QuestionInput& input);

}  // namespace touchstone::kinds
