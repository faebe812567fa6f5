// What the files about contact manifolds share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/files/cases.h"
#include "harness/kinds/questions.h"

namespace touchstone::kinds {

// Pairs of bodies that lie face on face, as in a pile at rest.

// A family of such pairs.
struct SettledFamily {
  std::string_view name;  // "stack", "tilt-1e-6": lower case, words joined by '-'
  std::string_view what;  // one line of description
};

// Returns all families in a stable order.
std::span<const SettledFamily> settled_families();

// Makes the case of this index alone, with the id "family/index". The bodies overlap by 1e-6 to
// 1e-3 of their size. Safe to call from several threads.
files::Case settled_pair(const SettledFamily& family, std::uint64_t seed, std::uint64_t index);

// Pairs of bodies that touch, of a file or generated.

std::vector<QueryOption> manifold_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_manifold_questions(const QuestionInput& input);

}  // namespace touchstone::kinds
