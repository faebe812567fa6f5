// Pairs of convex bodies, one JSON object a line.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "harness/kinds/questions.h"

namespace touchstone::kinds {

inline constexpr std::array<std::string_view, 4> pair_task_names = {"intersect", "distance",
                                                                    "penetration", "signed"};

std::vector<QueryOption> pair_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_pair_questions(const QuestionInput& input);

}  // namespace touchstone::kinds
